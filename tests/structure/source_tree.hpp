// The text files of a source tree.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace muster::test {

struct TextFile {
  std::string path{};  // from the root, with slashes
  std::string text{};
};

std::string folder_of(std::string_view path);

// True of a path that is `folder` or lies below it.
bool lies_in(std::string_view path, std::string_view folder);

bool is_cpp(std::string_view path);

// The C and C++ sources of some top-level folders, by path. A folder that is not there has none.
std::vector<TextFile> cpp_files(const std::filesystem::path& root, const std::vector<std::string>& folders);

// All files in which people write comments: sources, CMake files, scripts, worlds and robots. Build folders are left
// out.
std::vector<TextFile> commented_files(const std::filesystem::path& root);

}  // namespace muster::test
