// Reads whole files under a size limit, and parses numbers strictly.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace muster::description {

// The bytes of a regular file of at most `limit` bytes; throws std::runtime_error that begins with the path.
std::string read_file(const std::string& path, std::size_t limit);

// A finite decimal number and nothing else: no locale, no hexadecimal, no sign but '-' or one '+'.
std::optional<double> parse_number(std::string_view text);

// Numbers separated by blanks; null if any word is no number.
std::optional<std::vector<double>> parse_numbers(std::string_view text);

// In four digits, the same in every locale; or in the fewest that give the same number back.
std::string print_number(double value);
std::string print_exactly(double value);

// The nearest of `names` as "; did you mean 'x'?", or "" if none is near.
std::string nearest(std::string_view name, const std::vector<std::string>& names);

}  // namespace muster::description
