#include "folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "text/error.hpp"

namespace muster::cli {

FolderLock::FolderLock(const std::filesystem::path& folder, const char* option) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);  // whoever writes into it says what is wrong
  descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(descriptor_);
  throw Error(Exit::io, std::string(option) + ": " + folder.string() +
                            " is written by another run at this time; expected another folder");
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace muster::cli
