// A private copy of a library's file. The process maps the copy, so that overwriting the file (cp, rsync, a build)
// cannot pull the code from under a running world, and loading it again always gives what the file now holds: dlopen()
// by the file's own name would hand out the old library as long as anything keeps it open.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace muster {

class LibraryCopy {
 public:
  // Throws Refusal if the file is not there to be read: a directory, a device, unreadable, over 1 GiB.
  explicit LibraryCopy(const std::filesystem::path& file);
  ~LibraryCopy();
  LibraryCopy(const LibraryCopy&) = delete;
  LibraryCopy& operator=(const LibraryCopy&) = delete;

  std::string_view bytes() const { return {data_, size_}; }

  // The copy's name for dlopen(), good while this object lives: /proc/PID/fd/N rather than /proc/self/fd/N, so that
  // debuggers and profilers, which look from outside, find the code too.
  std::string name() const;

  // Keeps the name taken for ever: for a library that something holds on to although it was closed. dlopen() knows it
  // by this name, and would hand it out for another library under the same one.
  void abandon() { file_ = -1; }

 private:
  int file_ = -1;
  const char* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace muster
