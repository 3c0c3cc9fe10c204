// Places of rows in a plugin's table, for messages.
#pragma once

#include <cstddef>
#include <fstream>
#include <muster/plugin.hpp>
#include <string>

namespace muster {

class TableRows {
 public:
  // `param` is the parameter that names the table's file. For constructors of plugins.
  TableRows(const Setup& s, const char* param) : file_(s.text(param)) {
    const std::string world = s.text("world/file");
    const std::size_t folder = file_.rfind('/', 0) == 0 ? std::string::npos : world.rfind('/');
    if (folder != std::string::npos) file_.insert(0, world, 0, folder + 1);
  }

  // "FILE:LINE:1: " of the row, counted from 0: a row is a line, and the header is the first.
  std::string at(std::size_t row) const { return file_ + ':' + std::to_string(line(row)) + ":1: "; }

  // "FILE:LINE:COLUMN: " of its cell of the column of this name, such as "x"; the row's where there is none.
  std::string at(std::size_t row, const std::string& column) const {
    std::ifstream file(file_);
    std::string header, cells;
    std::getline(file, header);
    for (std::size_t i = 0; i <= row; ++i) std::getline(file, cells);
    if (header.compare(0, 3, "\xEF\xBB\xBF") == 0) header.erase(0, 3);
    std::size_t from = 0, to = 0;
    for (; from <= header.size() && to <= cells.size(); from = cell(header, from), to = cell(cells, to)) {
      const std::string name = header.substr(from, header.find_first_of("[,\r", from) - from);
      if (name == column) return file_ + ':' + std::to_string(line(row)) + ':' + std::to_string(to + 1) + ": ";
    }
    return at(row);
  }
  static std::size_t line(std::size_t row) { return row + 2; }
  const std::string& file() const { return file_; }

 private:
  // Where the cell begins that follows the one at `from`; beyond the text where that is the last.
  static std::size_t cell(const std::string& text, std::size_t from) {
    bool is_quoted = false;
    for (; from < text.size() && (is_quoted || text[from] != ','); ++from) is_quoted ^= text[from] == '"';
    return from + 1;
  }

  std::string file_;
};

}  // namespace muster
