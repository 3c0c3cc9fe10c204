// Writes a table that TextTable reads back, row by row, under a temporary name until it is complete.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "text_table.hpp"

namespace muster {

// What becomes of the temporary file of a table that was not closed, if anything was flushed to it.
enum class Unfinished { removed, kept };

// Every failure to write is an Error with Exit::io.
class TextTableWriter {
 public:
  TextTableWriter(const std::filesystem::path& path, const std::vector<TextColumn>& columns,
                  Unfinished unfinished = Unfinished::removed);
  ~TextTableWriter();
  TextTableWriter(const TextTableWriter&) = delete;
  TextTableWriter& operator=(const TextTableWriter&) = delete;

  // The next cell of the row: NaN is written as an empty cell, a name in quotes where it would be misread.
  void real(double value);
  void text(std::string_view value);
  void empty();
  void end_row();
  // What was written so far is in the file of the temporary name, in whole rows if it comes after end_row().
  void flush();

  // Flushes the file to disk and renames it to its final name, unless `check` throws on the temporary file.
  void close(const std::function<void(const std::filesystem::path&)>& check = {});

 private:
  void separate();
  [[noreturn]] void fail_system() const;

  std::filesystem::path path_;
  std::filesystem::path part_;  // the temporary name
  Unfinished unfinished_;
  bool is_empty_ = true;  // the temporary file
  int fd_ = -1;
  std::size_t width_;
  std::size_t cells_ = 0;  // of this row so far
  std::string buffer_;
};

}  // namespace muster
