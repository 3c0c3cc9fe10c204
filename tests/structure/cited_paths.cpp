#include "cited_paths.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace muster::test {
namespace {

namespace fs = std::filesystem;

constexpr std::array extensions{".hpp", ".cpp", ".md", ".xml", ".csv", ".py", ".cmake", ".urdf", ".svg", ".json"};
// Of other trees, made by a build or a script, or an example.
constexpr std::array elsewhere{"/", "../shared", "build/", "out/", "docs/long/", "path/to/"};
constexpr std::string_view of_placeholders = "*<>{}$=|?\\";
constexpr std::array names_in_capitals{"README", "CHANGELOG", "CONTRIBUTING", "LICENSE"};

// Reads a text once, with the number of the line that it is at.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  bool at_end() const { return at_ >= text_.size(); }
  char here() const { return text_[at_]; }
  char before() const { return at_ == 0 ? '\n' : text_[at_ - 1]; }
  bool sees(std::string_view word) const { return text_.substr(at_).starts_with(word); }
  void step(std::size_t count = 1) {
    for (; count > 0 && !at_end(); --count) line_ += text_[at_++] == '\n';
  }

  void skip_past(std::string_view end) {
    while (!at_end() && !sees(end)) step();
    step(end.size());
  }

  // Past the quote that closes the one that it is at.
  void skip_quoted(bool has_escapes) {
    const char quote = here();
    step();
    while (!at_end() && here() != quote) step(has_escapes && here() == '\\' ? 2 : 1);
    step();
  }

  // Past R"delimiter( ... )delimiter".
  void skip_raw() {
    step(2);
    std::string end = ")";
    for (; !at_end() && here() != '('; step()) end += here();
    skip_past(end + '"');
  }

  // From behind the mark that it is at, up to `end` and past it, line by line.
  void read_comment(std::string_view mark, std::string_view end, std::vector<Comment>& comments) {
    step(mark.size());
    comments.push_back({line_});
    for (; !at_end() && !sees(end); step()) {
      if (here() == '\n')
        comments.push_back({line_ + 1});
      else
        comments.back().text += here();
    }
    step(end.size());
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

bool is_in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

std::vector<Comment> cpp_comments(std::string_view text) {
  std::vector<Comment> comments;
  Reader reader(text);
  while (!reader.at_end()) {
    if (reader.sees("//"))
      reader.read_comment("//", "\n", comments);
    else if (reader.sees("/*"))
      reader.read_comment("/*", "*/", comments);
    else if (reader.sees("R\"") && !is_in_word(reader.before()))
      reader.skip_raw();
    else if (reader.here() == '"' || (reader.here() == '\'' && !is_in_word(reader.before())))  // 1'000 is a number
      reader.skip_quoted(true);
    else
      reader.step();
  }
  return comments;
}

// Scripts and CMake files; `quotes` are what strings stand in, `escaping` those in which a backslash escapes.
std::vector<Comment> hash_comments(std::string_view text, std::string_view quotes, std::string_view escaping) {
  std::vector<Comment> comments;
  Reader reader(text);
  while (!reader.at_end()) {
    if (reader.here() == '#' && std::isspace(static_cast<unsigned char>(reader.before())))
      reader.read_comment("#", "\n", comments);
    else if (reader.here() == '\\')
      reader.step(2);
    else if (quotes.find(reader.here()) != quotes.npos)
      reader.skip_quoted(escaping.find(reader.here()) != escaping.npos);
    else
      reader.step();
  }
  return comments;
}

std::vector<Comment> xml_comments(std::string_view text) {
  std::vector<Comment> comments;
  Reader reader(text);
  while (!reader.at_end()) {
    if (reader.sees("<!--"))
      reader.read_comment("<!--", "-->", comments);
    else
      reader.step();
  }
  return comments;
}

bool is_in_capitals(std::string_view stem) {
  const auto is_capital = [](char c) { return std::isupper(static_cast<unsigned char>(c)) || c == '_'; };
  return stem.size() > 1 && std::all_of(stem.begin(), stem.end(), is_capital) &&
         std::find(names_in_capitals.begin(), names_in_capitals.end(), stem) == names_in_capitals.end();
}

// True where a part of the path is to be filled in: docs/decisions/NNN-title.md, tests/plugins/FAMILY/.
bool has_placeholder(std::string_view path) {
  if (path.find_first_of(of_placeholders) != path.npos || path.find("...") != path.npos) return true;
  for (std::size_t at = 0; at < path.size();) {
    const auto end = std::min(path.find_first_of("/.-", at), path.size());
    if (is_in_capitals(path.substr(at, end - at))) return true;
    at = end + 1;
  }
  return false;
}

bool is_path(std::string_view word, const std::vector<std::string>& top_folders) {
  // A page is cited by its name alone, too, and names of pages are in capitals.
  if (word.find('/') == word.npos) return word.ends_with(".md") && word.find_first_of(of_placeholders) == word.npos;
  if (has_placeholder(word)) return false;
  if (std::any_of(elsewhere.begin(), elsewhere.end(), [&](const char* e) { return word.starts_with(e); })) return false;
  return std::any_of(extensions.begin(), extensions.end(), [&](const char* e) { return word.ends_with(e); }) ||
         std::any_of(top_folders.begin(), top_folders.end(),
                     [&](const std::string& folder) { return lies_in(word, folder); });
}

// Folders from which a comment in `file` may count a path.
std::vector<std::string> places_of(const fs::path& root, const std::string& file) {
  std::vector<std::string> folders{"plugins", "plugin_api", "docs", ""};
  for (std::string folder = folder_of(file); !folder.empty(); folder = folder_of(folder)) folders.push_back(folder);
  if (!fs::is_directory(root / "docs")) return folders;
  for (const auto& entry : fs::directory_iterator(root / "docs")) {
    if (entry.is_directory()) folders.push_back("docs/" + entry.path().filename().string());
  }
  return folders;
}

bool is_there(const fs::path& root, const std::string& file, const std::string& path) {
  const auto folders = places_of(root, file);
  return std::any_of(folders.begin(), folders.end(), [&](const std::string& folder) {
    std::error_code none;
    return fs::exists(root / folder / path, none);
  });
}

std::vector<std::string> top_folders_of(const fs::path& root) {
  std::vector<std::string> folders;
  for (const auto& entry : fs::directory_iterator(root)) {
    if (entry.is_directory()) folders.push_back(entry.path().filename().string());
  }
  return folders;
}

}  // namespace

std::vector<Comment> comments_of(const TextFile& file) {
  const std::string_view path = file.path;
  if (is_cpp(path)) return cpp_comments(file.text);
  if (path.ends_with(".xml") || path.ends_with(".urdf")) return xml_comments(file.text);
  if (path.ends_with("CMakeLists.txt") || path.ends_with(".cmake")) return hash_comments(file.text, "\"", "\"");
  return hash_comments(file.text, "\"'", "\"");
}

std::vector<std::string> paths_in(std::string_view comment, const std::vector<std::string>& top_folders) {
  constexpr std::string_view separators = " \t\r\"'`,;:()[]#";
  std::vector<std::string> paths;
  for (std::size_t at = 0; at < comment.size();) {
    const auto end = std::min(comment.find_first_of(separators, at), comment.size());
    std::string_view word = comment.substr(at, end - at);
    at = end + 1;
    while (!word.empty() && (word.back() == '.' || word.back() == '!')) word.remove_suffix(1);
    if (is_path(word, top_folders)) paths.emplace_back(word);
  }
  return paths;
}

std::vector<std::string> lost_citations(const fs::path& root) {
  const auto top_folders = top_folders_of(root);
  std::vector<std::string> lost;
  for (const TextFile& file : commented_files(root)) {
    for (const Comment& comment : comments_of(file)) {
      for (const std::string& path : paths_in(comment.text, top_folders)) {
        if (!is_there(root, file.path, path))
          lost.push_back(file.path + ":" + std::to_string(comment.line) + ": " + path);
      }
    }
  }
  return lost;
}

}  // namespace muster::test
