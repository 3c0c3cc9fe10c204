// Messages of a check, one below the other.
#pragma once

#include <string>
#include <vector>

namespace muster::test {

inline std::string lines(const std::vector<std::string>& messages) {
  std::string result = std::to_string(messages.size()) + ":";
  for (const std::string& message : messages) result += "\n" + message;
  return result;
}

}  // namespace muster::test
