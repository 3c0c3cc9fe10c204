#include "text_table_writer.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <utility>

#include "names.hpp"
#include "number.hpp"
#include "whole_file.hpp"

namespace muster {
namespace {

constexpr std::size_t buffer_bytes = 1 << 20;

// Also true for a name that reads as a number: TextTable reads quoted cells as names.
bool needs_quotes(std::string_view text) {
  return text.find_first_of(",\"") != text.npos || text.starts_with(' ') || text.ends_with(' ') ||
         text.starts_with('\t') || text.ends_with('\t') || parse_real(text).has_value();
}

}  // namespace

TextTableWriter::TextTableWriter(const std::filesystem::path& path, const std::vector<TextColumn>& columns,
                                 Unfinished unfinished)
    : path_(path), part_(path.string() + ".part"), unfinished_(unfinished), width_(columns.size()) {
  fd_ = open_part(part_, IfHeld::fails);
  if (fd_ < 0) fail_system();
  for (const TextColumn& column : columns) text(column.label());
  end_row();
}

TextTableWriter::~TextTableWriter() {
  if (fd_ < 0) return;
  if (unfinished_ == Unfinished::removed || is_empty_) ::unlink(part_.c_str());
  close_part(fd_);
}

void TextTableWriter::real(double value) {
  if (std::isnan(value)) return empty();
  separate();
  buffer_ += print_real(value);
}

void TextTableWriter::text(std::string_view value) {
  separate();
  const auto is_control = [](unsigned char c) { return c < 0x20 && c != '\t'; };
  if (std::any_of(value.begin(), value.end(), is_control)) {
    throw Error(Exit::io, Place{path_.string()},
                "cannot be written: the name " + quote(value) + " has a control character");
  }
  if (!needs_quotes(value)) {
    buffer_ += value;
    return;
  }
  buffer_ += '"';
  for (const char c : value) buffer_.append(c == '"' ? 2 : 1, c);
  buffer_ += '"';
}

void TextTableWriter::empty() { separate(); }

void TextTableWriter::separate() {
  if (cells_++ > 0) buffer_ += ',';
}

void TextTableWriter::end_row() {
  if (cells_ != width_) {
    throw Error(Exit::internal, Place{path_.string()},
                "a row with " + std::to_string(cells_) + " cells was written; expected " + std::to_string(width_));
  }
  cells_ = 0;
  buffer_ += '\n';
  if (buffer_.size() >= buffer_bytes) flush();
}

void TextTableWriter::flush() {
  if (!buffer_.empty()) is_empty_ = false;
  if (!write_all(fd_, buffer_)) fail_system();
  buffer_.clear();
}

void TextTableWriter::close(const std::function<void(const std::filesystem::path&)>& check) {
  flush();
  if (::fsync(fd_) != 0) fail_system();
  if (check) check(part_);
  const bool is_named = ::rename(part_.c_str(), path_.c_str()) == 0;
  const int reason = errno;
  if (!is_named) ::unlink(part_.c_str());
  close_part(std::exchange(fd_, -1));
  errno = reason;
  if (!is_named) fail_system();
}

void TextTableWriter::fail_system() const {
  throw Error(
      Exit::io, Place{path_.string()},
      why_unwritten(errno) +
          (fd_ >= 0 && unfinished_ == Unfinished::kept ? "; what was written until then is in " + part_.string() : ""));
}

}  // namespace muster
