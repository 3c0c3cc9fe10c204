#include "source_tree.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>

namespace muster::test {
namespace {

namespace fs = std::filesystem;

constexpr std::array cpp_extensions{".hpp", ".cpp", ".h", ".c"};
constexpr std::array other_extensions{".cmake", ".xml", ".urdf", ".sh", ".yml"};
constexpr std::array hidden_folders{".ci", ".github", ".devcontainer"};

template <std::size_t N>
bool is_one_of(const std::string& word, const std::array<const char*, N>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool begins_like_a_script(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  char first[2] = {};
  in.read(first, 2);
  return in && first[0] == '#' && first[1] == '!';
}

bool has_comments(const fs::path& file) {
  const std::string name = file.filename().string();
  const std::string extension = file.extension().string();
  return is_cpp(name) || is_one_of(extension, other_extensions) || name == "CMakeLists.txt" || name == "Dockerfile" ||
         (extension.empty() && begins_like_a_script(file));
}

bool is_left_out(const fs::path& folder) {
  const std::string name = folder.filename().string();
  if (name.starts_with('.')) return !is_one_of(name, hidden_folders);
  return name == "build" || name == "out";
}

template <class Wanted>
void read_below(const fs::path& root, const fs::path& folder, Wanted wanted, std::vector<TextFile>& files) {
  if (!fs::is_directory(folder)) return;
  for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::recursive_directory_iterator(); ++entry) {
    if (entry->is_directory() && is_left_out(entry->path()))
      entry.disable_recursion_pending();
    else if (entry->is_regular_file() && wanted(entry->path()))
      files.push_back({entry->path().lexically_relative(root).generic_string(), read(entry->path())});
  }
}

std::vector<TextFile> by_path(std::vector<TextFile> files) {
  std::sort(files.begin(), files.end(), [](const TextFile& a, const TextFile& b) { return a.path < b.path; });
  return files;
}

}  // namespace

std::string folder_of(std::string_view path) {
  const auto slash = path.rfind('/');
  return std::string(path.substr(0, slash == path.npos ? 0 : slash));
}

bool lies_in(std::string_view path, std::string_view folder) {
  return path.starts_with(folder) && (path.size() == folder.size() || path[folder.size()] == '/');
}

bool is_cpp(std::string_view path) {
  return std::any_of(cpp_extensions.begin(), cpp_extensions.end(), [&](const char* e) { return path.ends_with(e); });
}

std::vector<TextFile> cpp_files(const fs::path& root, const std::vector<std::string>& folders) {
  std::vector<TextFile> files;
  for (const std::string& folder : folders) {
    read_below(
        root, root / folder, [](const fs::path& file) { return is_cpp(file.filename().string()); }, files);
  }
  return by_path(std::move(files));
}

std::vector<TextFile> commented_files(const fs::path& root) {
  std::vector<TextFile> files;
  read_below(root, root, has_comments, files);
  return by_path(std::move(files));
}

}  // namespace muster::test
