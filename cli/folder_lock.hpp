// A folder that one run at a time writes to.
#pragma once

#include <filesystem>

namespace muster::cli {

class FolderLock {
 public:
  // Makes the folder. Throws Error with Exit::io where another process holds it; a file system without locks has none.
  FolderLock(const std::filesystem::path& folder, const char* option);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace muster::cli
