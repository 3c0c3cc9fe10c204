// Reads a table in a foreign format: cells between ',', ';', tabs or blanks, names with spaces, comment lines, several
// words for a missing value. Guesses are kept for the report.
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/error.hpp"

namespace muster::diagnosis {

// What a map states of a table's shape.
struct TableShape {
  bool has_header = true;
  int header_line = 0;                     // 0: the first line that is no comment
  std::vector<std::string> comments{"#"};  // beginnings of lines that are left out
  std::string end;                         // beginning of the line that ends the table; empty: the file's end
  std::optional<char> separator;           // ' ': any number of blanks; none: guessed
  bool decimal_comma = false;
};

class ForeignTable {
 public:
  // Throws Error: no header, rows of different lengths, an unterminated quote.
  static ForeignTable read(const std::filesystem::path& file, const TableShape& shape = {});

  const std::string& file() const { return file_; }
  std::size_t rows() const { return cells_.size() / columns_.size(); }
  const std::vector<std::string>& columns() const { return columns_; }
  const std::vector<std::string>& guesses() const { return guesses_; }
  bool has(const std::string& column) const;
  // A column by its name, or as column3 by its number. Throws Error with the nearest name; `for_whom` is the place of
  // the reference.
  std::size_t require(const std::string& column, const Place& for_whom) const;

  std::string_view text(std::size_t row, std::size_t column) const { return cells_[row * columns_.size() + column]; }
  // Empty for a cell that is empty, nan, NA, n/a, null or none. `advice` ends the error message for a cell that is no
  // number.
  std::optional<double> number(std::size_t row, std::size_t column, const std::string& advice = "") const;
  bool is_line_of_units() const;
  bool is_nothing(std::size_t row, std::size_t column) const;
  Place place(std::size_t row) const { return {file_, lines_[row], 0}; }

 private:
  struct Line {
    std::string_view text;
    int number;
  };
  std::vector<Line> lines_of_table();
  bool is_comment(std::string_view line) const;
  std::size_t take_header(const std::vector<Line>& lines);
  void name_columns(std::vector<std::string_view> names);
  void guess_separator(std::string_view line);
  std::vector<std::string_view> split(const Line& line);
  std::string_view quoted(std::string_view line, std::size_t quote_at, std::size_t& end, int number);
  void add_row(const Line& line);

  std::string file_;
  TableShape shape_;
  char separator_ = ',';
  std::shared_ptr<const std::string> source_;          // that cells are views of
  std::shared_ptr<std::deque<std::string>> unquoted_;  // cells with doubled quotes
  std::optional<Line> last_comment_;                   // before the first row
  std::vector<std::string> columns_, guesses_;
  std::vector<std::string_view> cells_;
  std::vector<int> lines_;
};

}  // namespace muster::diagnosis
