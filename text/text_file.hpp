// A whole text file in memory, read once and under a limit: what the readers of XML and of tables start from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "error.hpp"

namespace muster {

struct TextFile {
  std::string file;  // its path, as given
  std::string text;  // valid UTF-8 without byte order mark

  // Line and column, counted in characters, of the byte at the offset.
  Place place(std::size_t offset) const;
};

// Refuses, without reading a byte, what is no regular file or is larger than the limit; then what is not UTF-8.
TextFile read_text_file(const std::filesystem::path& path, std::uint64_t most_bytes);

// For an error: what the operating system says of an errno.
std::string system_message(int error_number);

}  // namespace muster
