// Reads a whole text file, once and under a limit, for the parsers of XML and of tables.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "error.hpp"

namespace muster {

struct TextFile {
  std::string file;  // the path as given
  std::string text;  // valid UTF-8 without byte order mark

  // Line and column, counted in characters, of the byte at the offset.
  Place place(std::size_t offset) const;
};

// Refuses anything but a regular file within the limit, before reading a byte; then anything but UTF-8.
TextFile read_text_file(const std::filesystem::path& path, std::uint64_t most_bytes);

// For an error: the operating system's text for an errno.
std::string system_message(int error_number);

}  // namespace muster
