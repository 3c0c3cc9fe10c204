#include "worker_lock.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "text/error.hpp"
#include "text/text_file.hpp"

namespace muster::sweep {
namespace {

struct flock whole_file() {
  struct flock result {};
  result.l_type = F_WRLCK;
  result.l_whence = SEEK_SET;
  return result;
}

[[noreturn]] void fail(const std::filesystem::path& file) {
  throw Error(Exit::io, Place{file.string()}, "cannot be locked: " + system_message(errno));
}

}  // namespace

// A lock of POSIX: the process's alone, not its children's, which plugins are tried out in.
WorkerLock::WorkerLock(std::filesystem::path file) : file_(std::move(file)) {
  std::filesystem::create_directories(file_.parent_path());
  fd_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  struct flock lock = whole_file();
  if (fd_ < 0 || ::fcntl(fd_, F_SETLK, &lock) != 0) fail(file_);
}

WorkerLock::~WorkerLock() {
  ::unlink(file_.c_str());
  ::close(fd_);
}

bool WorkerLock::is_held(const std::filesystem::path& file) {
  const int fd = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
  if (fd < 0 && errno == ENOENT) return false;
  struct flock lock = whole_file();
  if (fd < 0 || ::fcntl(fd, F_GETLK, &lock) != 0) fail(file);
  ::close(fd);
  return lock.l_type != F_UNLCK;
}

}  // namespace muster::sweep
