#include "names.hpp"

#include <algorithm>
#include <cstddef>

#include "text/synonyms.hpp"

namespace muster {
namespace {

constexpr std::size_t most_quoted_bytes = 60;
constexpr std::size_t most_listed = 30;
constexpr std::size_t short_list = 20;  // that a reader sees beyond

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Damerau-Levenshtein distance in its optimal string alignment form; three rows of the table are enough.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before, last);
    std::swap(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool exchanged = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (exchanged) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

std::string quote(std::string_view text) {
  constexpr char digits[] = "0123456789abcdef";
  std::size_t length = std::min(text.size(), most_quoted_bytes);
  while (length < text.size() && length > 0 && (text[length] & 0xC0) == 0x80) --length;  // never inside a character
  std::string result = "\"";
  for (const char c : text.substr(0, length)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7F) {
      result += c;
    } else {
      result += {'\\', 'x', digits[byte >> 4], digits[byte & 15]};
    }
  }
  return result + (length < text.size() ? "...\"" : "\"");
}

bool is_name(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  });
}

std::string nearest(std::string_view wrong, const std::vector<std::string>& valid) {
  std::string best;
  std::size_t best_distance = wrong.size() + 1;
  // Paths of one set are no nearer for the words that all of them begin with.
  const std::size_t separator = wrong.rfind('/');
  const std::size_t kind = separator == wrong.npos || separator + 1 == wrong.size() ? 0 : separator + 1;
  for (const std::string& name : valid) {
    const bool is_of_kind = name.size() > kind && name.compare(0, kind, wrong.substr(0, kind)) == 0;
    const std::size_t same = is_of_kind && name.find('/', kind) == name.npos ? kind : 0;
    const std::size_t longer = std::max(wrong.size(), name.size()) - same;
    const std::size_t shorter = std::min(wrong.size(), name.size()) - same;
    const std::size_t cut_off = (longer + 1) / 3;
    if (longer - shorter > cut_off) continue;
    const std::size_t d = distance(wrong, name);
    if (d > cut_off || d >= best_distance) continue;
    best = name;
    best_distance = d;
  }
  return best;
}

std::string listed(const std::vector<std::string>& names) {
  std::string result;
  for (std::size_t i = 0; i < std::min(names.size(), most_listed); ++i) result += (i > 0 ? ", " : "") + names[i];
  if (names.size() > most_listed) result += ", ... (" + std::to_string(names.size()) + " in all)";
  return result;
}

std::string expected_one_of(const std::vector<std::string>& valid) {
  if (valid.empty()) return "none is expected here";
  return (valid.size() == 1 ? "expected " : "expected one of ") + listed(valid);
}

namespace {

// The shortest name that goes on where the wrong one ends: "robot/*/odom" of "robot/*/odometry"; empty if there is
// none.
std::string completion(std::string_view wrong, const std::vector<std::string>& valid) {
  constexpr std::size_t telling = 3;  // letters; a shorter beginning is that of too many names
  const std::size_t separator = wrong.find_last_of("/.");
  if (wrong.size() - (separator == wrong.npos ? 0 : separator + 1) < telling) return "";
  std::string found;
  for (const std::string& name : valid) {
    const std::string_view more = name.starts_with(wrong) ? std::string_view(name).substr(wrong.size()) : "";
    const bool is_one_word = !more.empty() && more.find_first_of("/.@") == more.npos;
    if (is_one_word && (found.empty() || name.size() < found.size())) found = name;
  }
  return found;
}

bool is_separator(char c) { return c == '/' || c == '.' || c == ':' || c == '@'; }

std::vector<std::string_view> parts_of(std::string_view path) {
  std::vector<std::string_view> result;
  for (std::size_t from = 0, to = 0; to <= path.size(); ++to) {
    if (to < path.size() && !is_separator(path[to])) continue;
    if (to > from) result.push_back(path.substr(from, to - from));
    from = to + 1;
  }
  return result;
}

// Of a path such as "/robot1/scan": the name that means what one of its parts means elsewhere, the last before others,
// or the shortest that has its last part; "" where there is none.
std::string by_part(std::string_view wrong, const std::vector<std::string>& valid) {
  constexpr std::size_t telling = 2;  // letters
  const auto parts = parts_of(wrong);
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    std::string meant = part->size() < telling ? "" : synonym(*part, valid);
    if (!meant.empty()) return meant;
    // A frame of ROS: "/robot1/base_link".
    if (parts.size() > 1 && part->size() >= telling && std::find(valid.begin(), valid.end(), *part) != valid.end())
      return std::string(*part);
  }
  std::string found;
  for (const std::string& name : valid) {
    const auto own = parts_of(name);
    const bool has_it = !parts.empty() && parts.back().size() >= telling && own.size() > 1 &&
                        std::find(own.begin(), own.end(), parts.back()) != own.end();
    if (has_it && (found.empty() || name.size() < found.size())) found = name;
  }
  return found;
}

// The name that a longer one ends in, as "goal_tolerance" does in "tolerance"; "" where there is none.
std::string last_word(std::string_view wrong, const std::vector<std::string>& valid) {
  constexpr std::size_t telling = 4;  // letters
  for (const std::string& name : valid) {
    if (name.size() >= telling && wrong.size() > name.size() + 1 && wrong.ends_with(name) &&
        wrong[wrong.size() - name.size() - 1] == '_')
      return name;
  }
  return "";
}

}  // namespace

std::string did_you_mean(std::string_view wrong, const std::vector<std::string>& valid) {
  std::string found = synonym(wrong, valid);
  if (found.empty()) found = completion(wrong, valid);
  if (found.empty()) found = nearest(wrong, valid);
  constexpr std::size_t telling = 4;  // letters; a shorter end is that of too many names
  for (const std::string& name : valid) {
    const bool ends_in_it = wrong.size() >= telling && name.size() > wrong.size() + 1 && name.ends_with(wrong);
    if (found.empty() && ends_in_it &&
        std::string_view("/.").find(name[name.size() - wrong.size() - 1]) != std::string_view::npos)
      found = name;
  }
  if (found.empty()) found = last_word(wrong, valid);
  if (found.empty()) found = by_part(wrong, valid);
  return found.empty() ? "" : "; did you mean " + quote(found) + "?";
}

std::string suggest(std::string_view wrong, const std::vector<std::string>& valid) {
  const std::string question = did_you_mean(wrong, valid);
  if (valid.size() <= short_list || question.empty()) return expected_one_of(valid) + question;
  return question.substr(2) + ' ' + expected_one_of(valid);
}

}  // namespace muster
