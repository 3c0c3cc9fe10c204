#include "whole_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>

#include "error.hpp"
#include "text_file.hpp"

namespace muster {
namespace {

// False where whoever wrote the file has meanwhile given it its name, or taken it away.
bool is_called(int descriptor, const std::filesystem::path& name) {
  struct stat ours;
  struct stat there;
  return ::fstat(descriptor, &ours) == 0 && ::lstat(name.c_str(), &there) == 0 && ours.st_dev == there.st_dev &&
         ours.st_ino == there.st_ino;
}

// False with errno set where another holds it.
bool take(int descriptor, IfHeld if_held) {
  const int how = if_held == IfHeld::fails ? LOCK_EX | LOCK_NB : LOCK_EX;
  while (::flock(descriptor, how) != 0) {
    if (errno == EINTR) continue;
    return errno != EWOULDBLOCK;  // a file system without locks has none to hold
  }
  return true;
}

}  // namespace

int open_part(const std::filesystem::path& part, IfHeld if_held) {
  for (;;) {
    const int descriptor = ::open(part.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor < 0 && errno == ELOOP && ::unlink(part.c_str()) == 0) continue;
    if (descriptor < 0) return -1;
    const bool is_taken = take(descriptor, if_held), is_ours = is_taken && is_called(descriptor, part);
    if (is_ours && ::ftruncate(descriptor, 0) == 0) return descriptor;
    const int reason = errno;
    ::close(descriptor);
    if (is_taken && !is_ours) continue;
    errno = reason;
    return -1;
  }
}

void close_part(int descriptor) {
  ::flock(descriptor, LOCK_UN);  // a child process may have the descriptor, too
  ::close(descriptor);
}

std::string why_unwritten(int error_number) {
  if (error_number == EWOULDBLOCK) return "is written by another run at this time; expected another file";
  return "cannot be written: " + system_message(error_number);
}

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ::ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

void write_whole(const std::filesystem::path& file, std::string_view bytes) {
  const std::string part = file.string() + ".part";
  const int descriptor = open_part(part, IfHeld::waits);
  const bool is_whole = descriptor >= 0 && write_all(descriptor, bytes) && ::fsync(descriptor) == 0 &&
                        std::rename(part.c_str(), file.c_str()) == 0;
  const int reason = errno;
  if (!is_whole && descriptor >= 0) ::unlink(part.c_str());
  if (descriptor >= 0) close_part(descriptor);
  if (!is_whole) throw Error(Exit::io, Place{file.string()}, why_unwritten(reason));
}

}  // namespace muster
