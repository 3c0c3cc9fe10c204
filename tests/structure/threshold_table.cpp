#include "threshold_table.hpp"

#include <algorithm>

#include "source_tree.hpp"

namespace muster::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> split(std::string_view text, std::string_view separator) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const auto end = std::min(text.find(separator, at), text.size());
    parts.emplace_back(text.substr(at, end - at));
    at = end + separator.size();
  }
  return parts;
}

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" `");
  if (first == text.npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" `") - first + 1));
}

Threshold threshold_of(const std::string& declaration, const std::string& comment) {
  const auto equals = declaration.find('=');
  const std::string left = trimmed(std::string_view(declaration).substr(0, equals));
  auto columns = split(comment, ";");
  columns.resize(4);
  return {left.substr(left.rfind(' ') + 1),
          trimmed(std::string_view(declaration).substr(equals + 1, declaration.find(';') - equals - 1)),
          trimmed(columns[0]),
          trimmed(columns[1]),
          trimmed(columns[2]),
          trimmed(columns[3])};
}

}  // namespace

std::string in_words(const Threshold& t) {
  return t.name + " = " + t.value + "; " + t.unit + "; " + t.meaning + "; " + t.origin + "; " + t.test;
}

std::vector<fs::path> threshold_headers(const fs::path& root) {
  std::vector<fs::path> headers;
  for (const auto& entry : fs::directory_iterator(root / "diagnosis")) {
    if (const fs::path header = entry.path() / "thresholds.hpp"; fs::exists(header)) headers.push_back(header);
  }
  std::sort(headers.begin(), headers.end());
  return headers;
}

std::vector<Threshold> thresholds_in_header(std::string_view text) {
  std::vector<Threshold> result;
  std::string comment, declaration;
  for (const std::string& line : split(text, "\n")) {
    if (!declaration.empty() || line.starts_with("inline constexpr ")) {
      declaration += (declaration.empty() ? "" : " ") + trimmed(line);
      if (declaration.find(';') == declaration.npos) continue;
      result.push_back(threshold_of(declaration, comment));
      declaration.clear();
      comment.clear();
    } else if (line.starts_with("// ")) {
      comment += (comment.empty() ? "" : " ") + line.substr(3);
    } else {
      comment.clear();
    }
  }
  return result;
}

std::vector<Threshold> thresholds_on_page(std::string_view text) {
  std::vector<Threshold> result;
  for (const std::string& line : split(text, "\n")) {
    if (!line.starts_with("| `")) continue;
    auto cells = split(line, "|");
    cells.resize(7);
    result.push_back({trimmed(cells[1]), trimmed(cells[2]), trimmed(cells[3]), trimmed(cells[4]), trimmed(cells[5]),
                      trimmed(cells[6])});
  }
  return result;
}

std::vector<std::string> test_names(const fs::path& root) {
  std::vector<std::string> names;
  for (const TextFile& file : cpp_files(root, {"tests"})) {
    for (const std::string& line : split(file.text, "\n")) {
      if (!line.starts_with("TEST(") && !line.starts_with("TEST_P(") && !line.starts_with("TEST_F(")) continue;
      const auto open = line.find('('), comma = line.find(", "), close = line.find(')');
      if (comma != line.npos && close != line.npos && comma < close)
        names.push_back(line.substr(open + 1, comma - open - 1) + '.' + line.substr(comma + 2, close - comma - 2));
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace muster::test
