// Numbers in messages.
#pragma once

#include <charconv>
#include <string>

namespace muster {

// With three digits after the point, whatever the locale says.
inline std::string printed(double value) {
  char digits[400];  // as many as the largest double has
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, 3);
  return std::string(digits, end.ptr);
}

}  // namespace muster
