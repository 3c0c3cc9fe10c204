#include "columns.hpp"

#include <charconv>
#include <set>
#include <stdexcept>

namespace muster {
namespace {

constexpr std::size_t most_columns = 1u << 16;

bool is_word(std::string_view text) {
  if (text.empty()) return false;
  for (const char c : text) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    if (!letter && !(c >= '0' && c <= '9')) return false;
  }
  return true;
}

[[noreturn]] void refuse(std::string_view word, const std::string& why) {
  throw std::invalid_argument("column \"" + std::string(word) + "\" " + why);
}

// Units in other brackets, "sum(m)" or "sum{m}", and behind a slash or a hyphen: "sum/m".
std::string with_unit(std::string_view word) {
  const auto mark = word.find_first_of("({</-");
  if (mark == 0 || mark == word.npos) return "";
  const auto end = word.find_first_of(")}>", mark);
  const std::string_view unit = word.substr(mark + 1, end == word.npos ? end : end - mark - 1);
  if (unit.empty() || !is_word(word.substr(0, mark))) return "";
  return ": " + std::string(word.substr(0, mark)) + '[' + std::string(unit) + ']';
}

// Columns that are parted by something else than blanks.
[[noreturn]] void refuse_separators(std::string_view text) {
  std::string meant;
  bool is_between = false;
  for (const char c : text) {
    const bool parts = std::string_view(" ,;\t\n").find(c) != std::string_view::npos;
    if (!parts && is_between && !meant.empty()) meant += ' ';
    if (!parts) meant += c;
    is_between = parts;
  }
  throw std::invalid_argument("columns \"" + std::string(text) +
                              "\" are parted by other signs than blanks; expected \"" + meant + '"');
}

// Parses one word of the text; returns the number of columns that it describes.
std::size_t parse_word(std::string_view word, Column& column) {
  const auto marks = word.find_first_of(":[{*?~+");
  column.name = word.substr(0, marks);
  if (!is_word(column.name))
    refuse(word, "has no name of letters, digits and _; expected name, or name[unit]" + with_unit(word));
  std::size_t count = 1;
  std::string_view rest = marks == word.npos ? std::string_view{} : word.substr(marks);
  while (!rest.empty()) {
    const char mark = rest.front();
    std::size_t used = 1;
    if (mark == ':') {
      used = std::min(rest.find_first_of("[{*?~+", 1), rest.size());
      column.reference = rest.substr(1, used - 1);
      if (!is_word(column.reference)) refuse(word, "refers to no set");
    } else if (mark == '[') {
      const auto close = rest.find(']');
      if (close == rest.npos) refuse(word, "has no closing ]");
      column.unit = rest.substr(1, close - 1);
      used = close + 1;
    } else if (mark == '{' && rest.substr(0, 2) == "{}") {
      column.bytes = true;
      used = 2;
    } else if (mark == '*') {
      const auto [end, error] = std::from_chars(rest.data() + 1, rest.data() + rest.size(), count);
      if (error != std::errc{} || count == 0 || count > most_columns)
        refuse(word, "has no count from 1 to 65536 after *");
      used = static_cast<std::size_t>(end - rest.data());
    } else if (mark == '?') {
      column.nullable = true;
    } else if (mark == '~') {
      column.infinite = true;
    } else if (mark == '+' && !column.reference.empty()) {
      column.joins = true;
    } else {
      refuse(word, "is not of the form name:set[unit]{}*count?~" + with_unit(word));
    }
    rest.remove_prefix(used);
  }
  return count;
}

}  // namespace

Columns::Columns(std::string_view text) : text_(text) {
  std::set<std::string> names;
  while (true) {
    const auto start = text.find_first_not_of(' ');
    if (start == text.npos) break;
    text.remove_prefix(start);
    const auto word = text.substr(0, text.find(' '));
    if (word.find_first_of(",;\t\n") != word.npos) refuse_separators(text);
    text.remove_prefix(word.size());
    Column column;
    const auto count = parse_word(word, column);
    any_bytes_ |= column.bytes;
    any_references_ |= !column.reference.empty();
    plain_ &= !column.nullable && !column.infinite;
    for (std::size_t i = 0; i < count; ++i) {
      list_.push_back(column);
      if (count > 1) list_.back().name += std::to_string(i);
      if (!names.insert(list_.back().name).second) refuse(word, "stands twice");
    }
    if (list_.size() > most_columns) refuse(word, "makes more than 65536 columns");
  }
}

int Columns::find(std::string_view name) const {
  for (std::size_t i = 0; i < list_.size(); ++i) {
    if (list_[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace muster
