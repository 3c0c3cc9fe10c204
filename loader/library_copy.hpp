// A private copy of a library's file. The process maps the copy, so overwriting the file (cp, rsync, a build) cannot
// pull the code from under a running world. Loading again always gives the file's present contents. dlopen() by the
// file's own name would return the old library as long as a handle keeps it open.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace muster {

class LibraryCopy {
 public:
  // Throws Refusal if the file cannot be read as a library: a directory, a device, unreadable, over 1 GiB.
  explicit LibraryCopy(const std::filesystem::path& file);
  ~LibraryCopy();
  LibraryCopy(const LibraryCopy&) = delete;
  LibraryCopy& operator=(const LibraryCopy&) = delete;

  std::string_view bytes() const { return {data_, size_}; }

  // The copy's name for dlopen(), valid during this object's life: /proc/PID/fd/N rather than /proc/self/fd/N, so that
  // debuggers and profilers, which look from outside, find the code too.
  std::string name() const;

  // Reserves the name for ever: for a library that is still mapped although it was closed. dlopen() identifies it by
  // this name, and would return it for another library under the same one.
  void abandon() { file_ = -1; }

 private:
  int file_ = -1;
  const char* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace muster
