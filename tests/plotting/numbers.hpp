#pragma once

#include <charconv>
#include <string_view>
#include <vector>

namespace muster::plotting {

// All numbers in a text, such as those of a path.
inline std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at < end) {
    double number = 0;
    const auto [after, error] = std::from_chars(at, end, number);
    if (error == std::errc()) numbers.push_back(number);
    at = error == std::errc() ? after : at + 1;
  }
  return numbers;
}

}  // namespace muster::plotting
