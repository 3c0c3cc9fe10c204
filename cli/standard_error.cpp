// Standard error that takes what it can: a terminal that has gone, a full disk or a closed descriptor ends no run.
#include <unistd.h>

#include <cstdio>

#include "verbs.hpp"

namespace muster::cli {
namespace {

ssize_t write_what_goes(void*, const char* bytes, std::size_t count) {
  for (std::size_t done = 0; done < count;) {
    const ssize_t written = ::write(STDERR_FILENO, bytes + done, count - done);
    if (written <= 0) break;
    done += static_cast<std::size_t>(written);
  }
  return static_cast<ssize_t>(count);
}

}  // namespace

void keep_standard_error() {
  cookie_io_functions_t functions{};
  functions.write = write_what_goes;
  std::FILE* stream = ::fopencookie(nullptr, "w", functions);
  if (!stream) return;
  std::setvbuf(stream, nullptr, _IONBF, 0);
  stderr = stream;
}

}  // namespace muster::cli
