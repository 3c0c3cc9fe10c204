// Files that a test writes: in a folder of its own, gone in the end.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "text/temporary_folder.hpp"

namespace muster::test {

inline std::string contents(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

class Folder {
 public:
  const std::filesystem::path& path() const { return made_.path(); }
  std::filesystem::path operator/(const std::string& name) const { return path() / name; }
  std::string at(const std::string& name) const { return (path() / name).string(); }

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    auto file = path() / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream out(file, std::ios::binary);
    out << bytes;
    if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
    return file;
  }
  std::string read(const std::string& name) const { return contents(path() / name); }

  // A message without this folder before the names of its files.
  std::string inside(std::string text) const {
    const std::string prefix = path().string() + '/';
    for (auto at = text.find(prefix); at != text.npos; at = text.find(prefix)) text.erase(at, prefix.size());
    return text;
  }

 private:
  TemporaryFolder made_;
};

}  // namespace muster::test
