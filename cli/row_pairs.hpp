// Which rows of a table are the same thing in two runs: by name, never by number. Rows of links and messages, which
// have only numbers, are named by whom they refer to, such as "base rover".
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "kernel/simulation.hpp"

namespace muster {

// What the row is called; several of one name are told apart by RowPairs.
std::string row_name(const Simulation& run, const Table& table, std::size_t row);

// What stands in a cell: a number, or the name of the row that it refers to.
std::string cell_name(const Simulation& run, const Column& column, double value);

struct RowPairs {
  bool in_place = false;  // all rows are the same in both runs, and stand at the same numbers
  std::vector<std::pair<std::size_t, std::size_t>> both;
  std::array<std::vector<std::pair<std::string, std::size_t>>, 2>
      only;  // rows that one run alone has, with their names
};

// Of a queue, the rows that came in this tick.
RowPairs row_pairs(const Simulation& a, const Table& in_a, const Simulation& b, const Table& in_b);

}  // namespace muster
