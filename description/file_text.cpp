#include "description/file_text.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace muster::description {

namespace {

struct Descriptor {
  int value;
  ~Descriptor() {
    if (value >= 0) ::close(value);
  }
};

// Levenshtein's distance.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

// The words of a name such as "wheel_left_link", sorted.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words(1);
  for (const char c : name) {
    if (c == '_' || c == '-')
      words.emplace_back();
    else
      words.back() += c;
  }
  std::sort(words.begin(), words.end());
  return words;
}

}  // namespace

std::string read_file(const std::string& path, std::size_t limit) {
  // O_NONBLOCK: opening a pipe without a writer must not block.
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (file.value < 0) throw std::runtime_error(path + ": " + std::strerror(errno));
  struct stat status {};
  if (::fstat(file.value, &status) != 0) throw std::runtime_error(path + ": " + std::strerror(errno));
  if (!S_ISREG(status.st_mode)) throw std::runtime_error(path + ": is not a regular file");
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > limit) {
    throw std::runtime_error(path + ": has " + std::to_string(size) + " bytes; expected at most " +
                             std::to_string(limit));
  }
  std::string text(size, '\0');
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count = ::read(file.value, text.data() + done, size - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw std::runtime_error(path + ": " + std::strerror(errno));
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  text.resize(done);
  return text;
}

std::optional<double> parse_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::vector<double>> parse_numbers(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  std::vector<double> values;
  for (;;) {
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return values;
    const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
    const auto value = parse_number(text.substr(begin, end - begin));
    if (!value) return std::nullopt;
    values.push_back(*value);
    text.remove_prefix(end);
  }
}

std::string print_number(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 4).ptr;
  return {text, end};
}

std::string print_exactly(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

std::string nearest(std::string_view name, const std::vector<std::string>& names) {
  const auto words = words_of(name);
  for (const std::string& candidate : names) {  // the same words in another order
    if (words.size() > 1 && candidate != name && words_of(candidate) == words)
      return "; did you mean '" + candidate + "'?";
  }
  const std::string* best = nullptr;
  std::size_t least = std::max<std::size_t>(2, name.size() / 3) + 1;  // beyond that number of edits it is another word
  for (const std::string& candidate : names) {
    const std::size_t d = distance(name, candidate);
    if (d < least) least = d, best = &candidate;
  }
  return best ? "; did you mean '" + *best + "'?" : "";
}

}  // namespace muster::description
