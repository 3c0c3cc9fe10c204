// Reads a table in a foreign format: cells between ',', ';' or tabs, names with spaces, several words for a missing
// value. Guesses are kept for the report.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/error.hpp"

namespace muster::diagnosis {

class ForeignTable {
 public:
  // Throws Error: no header, rows of different lengths, an unterminated quote.
  static ForeignTable read(const std::filesystem::path& file);

  const std::string& file() const { return file_; }
  std::size_t rows() const { return cells_.size() / columns_.size(); }
  const std::vector<std::string>& columns() const { return columns_; }
  const std::vector<std::string>& guesses() const { return guesses_; }
  // Throws Error with the nearest name; `for_whom` is the place of the reference.
  std::size_t require(const std::string& column, const Place& for_whom) const;

  const std::string& text(std::size_t row, std::size_t column) const { return cells_[row * columns_.size() + column]; }
  // Empty for a cell that is empty, nan, NaN, NA or null. `advice` ends the error message for a cell that is no
  // number.
  std::optional<double> number(std::size_t row, std::size_t column, const std::string& advice = "") const;
  Place place(std::size_t row) const { return {file_, lines_[row], 0}; }

 private:
  std::vector<std::string> split(std::string_view line, int number) const;
  void read_header(std::string_view line);

  std::string file_;
  char separator_ = ',';
  std::vector<std::string> columns_, cells_, guesses_;
  std::vector<int> lines_;
};

}  // namespace muster::diagnosis
