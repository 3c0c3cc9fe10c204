// Places of rows in a plugin's table, for messages.
#pragma once

#include <cstddef>
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
  static std::size_t line(std::size_t row) { return row + 2; }
  const std::string& file() const { return file_; }

 private:
  std::string file_;
};

}  // namespace muster
