// A private folder among the system's temporary ones, removed at the end.
#pragma once

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include "error.hpp"

namespace muster {

class TemporaryFolder {
 public:
  // Throws Error.
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "muster_XXXXXX").string();
    if (!::mkdtemp(name.data())) throw Error(Exit::io, name + ": cannot be made: " + std::strerror(errno));
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace muster
