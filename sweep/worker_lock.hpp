// Whether a worker lives: it holds a lock on a file of its own, which the operating system takes from it when it ends,
// however it ends. A number of a process could be another's by now; a lock cannot, also on a file system of several
// machines.
#pragma once

#include <filesystem>

namespace muster::sweep {

class WorkerLock {
 public:
  // Makes the file and locks it. One in a process: its locks are not held against itself. Throws Error.
  explicit WorkerLock(std::filesystem::path file);
  ~WorkerLock();  // the file is gone after it
  WorkerLock(const WorkerLock&) = delete;
  WorkerLock& operator=(const WorkerLock&) = delete;

  // Of another process. Throws Error where that cannot be found out.
  static bool is_held(const std::filesystem::path& file);

 private:
  std::filesystem::path file_;
  int fd_ = -1;
};

}  // namespace muster::sweep
