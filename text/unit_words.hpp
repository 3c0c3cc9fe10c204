// Numbers that are written with a unit, which no number has here: "1min", "50 cm", "90deg", "00:01:30".
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace muster {

// The number in `unit` that a text such as "1min" is; none where it is no number with a unit of the same kind.
std::optional<double> in_unit(std::string_view unit, std::string_view text);

// "; 1min are 60 s" behind a refusal of such a text, "; 20 dBm is written 20" where it is the unit itself; empty where
// there is nothing to say.
std::string other_unit_hint(std::string_view unit, std::string_view text);

}  // namespace muster
