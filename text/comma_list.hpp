// Lists with commas where each word is one of its own: --free A,B for --free A --free B.
#pragma once

#include <algorithm>
#include <string>

namespace muster {

// "--free A --free B" of "A,B"; "" where there is no comma, or one between digits, as in "A=1,7".
inline std::string once_each(const std::string& option, const std::string& list) {
  const auto is_digit = [&](std::size_t at) { return at < list.size() && list[at] >= '0' && list[at] <= '9'; };
  for (std::size_t at = list.find(','); at != list.npos; at = list.find(',', at + 1))
    if (at > 0 && is_digit(at - 1) && is_digit(at + 1)) return "";
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
