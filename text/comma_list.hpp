// Lists with commas where each word is one of its own: --free A,B for --free A --free B.
#pragma once

#include <algorithm>
#include <string>

namespace muster {

// "--free A --free B" of "A,B"; "" where there is no comma.
inline std::string once_each(const std::string& option, const std::string& list) {
  if (list.find(',') == list.npos) return "";
  std::string result;
  for (std::size_t from = 0, to = 0; from <= list.size(); from = to + 1) {
    to = std::min(list.find(',', from), list.size());
    const std::string word = list.substr(from, to - from);
    if (!word.empty()) result += (result.empty() ? "" : " ") + option + ' ' + word;
  }
  return result;
}

}  // namespace muster
