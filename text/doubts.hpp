// Numbers that are legal and look like another unit: degrees, milliwatts, centimetres, a sign that is lost.
#pragma once

#include <string>
#include <string_view>

namespace muster {

// "90 rad is more than a full turn; are these degrees?"; empty where there is nothing to doubt.
std::string angle_doubt(double radians);

// What to warn of a value of a quantity of this name and unit; empty where there is nothing to doubt.
std::string unit_doubt(std::string_view name, std::string_view unit, double value);

// What to warn of a condition that holds a column of this unit against a value.
enum class Compared { below, above, equal };
std::string level_doubt(std::string_view unit, Compared compared, double value);

// Of a value that is out of bounds: the question that stands behind the message, such as "; 2.4 GHz are 2.4e9 Hz".
std::string unit_hint(std::string_view unit, double value, double least, double most);

// Of a text that is no number: "; 100 mW are 20 dBm". Empty where the text is nothing like it.
std::string power_hint(std::string_view unit, std::string_view text);

}  // namespace muster
