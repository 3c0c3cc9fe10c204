// Text for files at the limits and beyond.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace muster::test {

inline std::string repeat(std::string_view text, int times) {
  std::string result;
  result.reserve(text.size() * static_cast<std::size_t>(times));
  while (times-- > 0) result += text;
  return result;
}

// One tag with so many attributes.
inline std::string attributes(int count) {
  std::string result = "<w";
  for (int i = 0; i < count; ++i) result += " a" + std::to_string(i) + "='1'";
  return result + "/>";
}

}  // namespace muster::test
