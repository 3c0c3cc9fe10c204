#include "whole_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>

#include "error.hpp"
#include "text_file.hpp"

namespace muster {
namespace {

std::string part_of(const std::filesystem::path& file) { return file.string() + ".part"; }

}  // namespace

int open_part(const std::filesystem::path& file) {
  const std::string part = part_of(file);
  constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW;
  const int descriptor = ::open(part.c_str(), flags, 0666);
  if (descriptor >= 0 || errno != ELOOP || ::unlink(part.c_str()) != 0) return descriptor;
  return ::open(part.c_str(), flags | O_EXCL, 0666);
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
  const int descriptor = open_part(file);
  bool fine = descriptor >= 0 && write_all(descriptor, bytes) && ::fsync(descriptor) == 0;
  int reason = fine ? 0 : errno;
  if (descriptor >= 0 && ::close(descriptor) != 0 && fine) fine = false, reason = errno;
  if (fine && std::rename(part_of(file).c_str(), file.c_str()) != 0) fine = false, reason = errno;
  if (fine) return;
  if (descriptor >= 0) ::unlink(part_of(file).c_str());
  throw Error(Exit::io, Place{file.string()}, "cannot be written: " + system_message(reason));
}

}  // namespace muster
