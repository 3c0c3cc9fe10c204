#include "rooms.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>

#include "include_graph.hpp"
#include "source_tree.hpp"

namespace muster::test {
namespace {

namespace fs = std::filesystem;

constexpr std::array words_of_a_domain{"tx",    "rx",     "radio", "radios", "link", "links",
                                       "robot", "robots", "dbm",   "rssi",   "yaw"};

bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)); }
bool is_lower(char c) { return std::islower(static_cast<unsigned char>(c)); }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)); }
bool is_in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

std::string small(std::string_view word) {
  std::string result(word);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

// True where a part ends before word[at]: linkOf, RSSIFloor.
bool breaks_before(std::string_view word, std::size_t at) {
  if (!is_upper(word[at])) return false;
  return is_lower(word[at - 1]) || (is_upper(word[at - 1]) && at + 1 < word.size() && is_lower(word[at + 1]));
}

void add_parts(std::string_view letters, std::vector<std::string>& parts) {
  if (letters.empty()) return;
  const std::string whole = small(letters);
  if (whole == "dbm") return parts.push_back(whole);  // its capital begins no word
  std::size_t begin = 0;
  for (std::size_t at = 1; at <= letters.size(); ++at) {
    if (at < letters.size() && !breaks_before(letters, at)) continue;
    parts.push_back(small(letters.substr(begin, at - begin)));
    begin = at;
  }
}

bool is_of_a_domain(const std::string& part) {
  return std::find(words_of_a_domain.begin(), words_of_a_domain.end(), part) != words_of_a_domain.end();
}

void find_words(const TextFile& file, std::vector<std::string>& found) {
  int line = 1;
  for (std::size_t at = 0; at < file.text.size(); ++at) {
    if (file.text[at] == '\n') ++line;
    if (!is_in_word(file.text[at])) continue;
    std::size_t end = at;
    while (end < file.text.size() && is_in_word(file.text[end])) ++end;
    const std::string word = file.text.substr(at, end - at);
    at = end - 1;
    const auto parts = parts_of(word);
    if (std::any_of(parts.begin(), parts.end(), is_of_a_domain))
      found.push_back(file.path + ":" + std::to_string(line) + ": " + word);
  }
}

}  // namespace

std::vector<std::string> crowded_folders(const fs::path& root, const std::string& folder, std::size_t largest) {
  std::map<std::string, std::set<std::string>> units;
  for (const TextFile& file : cpp_files(root, {folder})) units[folder_of(file.path)].insert(unit_of(file.path));
  std::vector<std::string> crowded;
  for (const auto& [name, inside] : units) {
    if (inside.size() > largest)
      crowded.push_back(name + ": " + std::to_string(inside.size()) + " units; at most " + std::to_string(largest));
  }
  return crowded;
}

std::vector<std::string> files_in(const fs::path& root, const std::string& folder) {
  std::vector<std::string> files;
  if (!fs::is_directory(root / folder)) return files;
  for (const auto& entry : fs::directory_iterator(root / folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && name != "README.md" && name != "CMakeLists.txt") files.push_back(name);
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> parts_of(std::string_view identifier) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at < identifier.size();) {
    std::size_t end = at;
    while (end < identifier.size() && is_letter(identifier[end])) ++end;
    add_parts(identifier.substr(at, end - at), parts);
    at = end + 1;
  }
  return parts;
}

std::vector<std::string> domain_words(const fs::path& root, const std::string& folder) {
  std::vector<std::string> found;
  for (const TextFile& file : cpp_files(root, {folder})) find_words(file, found);
  return found;
}

}  // namespace muster::test
