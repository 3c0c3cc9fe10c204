// Tables of text (CSV), measured or logged: a header with units such as `t[s],tx,rx,rssi[dBm]`, then rows of numbers
// and names. UTF-8; ',' between cells; a line a row; an empty cell is a missing value; quotes around a cell make it a
// name, and a quote inside is doubled. The file is read once and split once; a column is parsed on request.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text_file.hpp"

namespace muster {

struct TextColumn {
  std::string name;
  std::string unit;  // empty: none

  // As in the header: `rssi[dBm]`.
  std::string label() const { return unit.empty() ? name : name + '[' + unit + ']'; }
};

// A column of names: row r holds levels[level[r]]; levels are in the order of their first rows.
struct Factor {
  std::vector<std::uint32_t> level;
  std::vector<std::string> levels;
};

// Values that a column may hold beyond finite numbers or names.
struct Allow {
  bool empty = false;     // an empty cell, NaN among numbers: a missing value
  bool infinite = false;  // inf and -inf: a laser's "no return"
};

class TextTable {
 public:
  // Throws Error with line and column of the fault: an invalid header, or a row with another number of cells.
  static TextTable read(const std::filesystem::path& path);

  const std::string& file() const { return file_.file; }
  // The same table, with another name of its file in messages.
  TextTable named(std::string file) const {
    TextTable result = *this;
    result.file_.file = std::move(file);
    return result;
  }
  // The same table with one column read otherwise: a clock in seconds in place of one in nanoseconds.
  TextTable with_column(std::size_t column, TextColumn label, std::vector<double> values) const;
  // The same columns with these rows alone, in this order. Its places count the lines that are left.
  TextTable with_rows(const std::vector<std::size_t>& rows) const;
  bool is_replaced(std::size_t column) const { return read_otherwise_.count(column) > 0; }
  const std::vector<TextColumn>& columns() const { return columns_; }
  std::size_t rows() const { return row_starts_.size() - 2; }

  std::optional<std::size_t> find(std::string_view name) const;
  // The column of that name and unit; otherwise an error that names the nearest column.
  std::size_t require(std::string_view name, std::string_view unit) const;
  // Throws Error with the whole header where two or more of the columns are not there: it is another table then.
  void require_most(const std::vector<TextColumn>& needed) const;
  // True if the column has a unit, or starts with a number (a quoted cell is a name).
  bool is_numeric(std::size_t column) const;

  std::vector<double> reals(std::size_t column, Allow allow = {}) const;
  Factor texts(std::size_t column, Allow allow = {}) const;

  // A cell without its quotes, and its place.
  std::string text(std::size_t row, std::size_t column) const { return cell_text(raw(row + 1, column)); }
  Place place(std::size_t row, std::size_t column) const { return raw_place(row + 1, column); }
  Place header_place(std::size_t column) const { return raw_place(0, column); }

 private:
  void split();
  std::size_t split_row(std::size_t start);
  std::size_t cell_end(std::size_t cell) const;
  void read_header();
  TextColumn read_label(std::size_t column) const;
  std::string nameless(std::size_t column) const;
  std::string header_with_units(std::size_t column, std::string_view unit) const;
  [[noreturn]] void fail_ragged(std::size_t found) const;

  // Line 0 is the header.
  std::string_view raw(std::size_t line, std::size_t column) const;
  Place raw_place(std::size_t line, std::size_t column) const;
  [[noreturn]] void fail_cell(std::size_t row, std::size_t column, const std::string& what) const;
  static std::string cell_text(std::string_view raw);
  static std::string why_not_number(std::string_view raw, Allow allow);

  TextFile file_;
  std::vector<TextColumn> columns_;
  std::size_t width_ = 0;                   // cells a line
  std::vector<std::uint64_t> row_starts_;   // byte offset of each line, and of the one after the last
  std::vector<std::uint16_t> cell_starts_;  // width_ a line, relative to its start
  std::map<std::size_t, std::vector<double>> read_otherwise_;  // values of columns given by with_column()
};

}  // namespace muster
