// Two runs held against each other, tick by tick: what differs, since when, and by how much. Rows are paired by name,
// columns by name and unit.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "row_pairs.hpp"

namespace muster {

// A number of a row in which runs may differ: a column, or what the columns of a pose are together.
struct Measure {
  std::string name, unit;    // of a difference: dB where the columns are in dBm
  int column[2] = {-1, -1};  // in either run; -1: made of several

  std::string title() const { return unit.empty() ? name : name + '[' + unit + ']'; }
};

// How one measure of one row goes apart.
struct Course {
  static constexpr uint64_t never = ~uint64_t{0};

  uint64_t first = never;   // tick of the first difference
  uint64_t beyond = never;  // tick of the first difference beyond the tolerance
  double largest = 0;       // absolute
  uint64_t largest_at = 0;
  uint64_t unlike = 0;        // ticks at which nothing can be subtracted: one side is empty, or names or bytes differ
  std::vector<double> trace;  // the largest of each span of ticks

  // Second run less first, at that tick, the last or none; NaN where nothing can be subtracted.
  double at(uint64_t tick) const { return tick == now_at ? now : 0; }
  double now = 0;
  uint64_t now_at = never;
};

struct TableDivergence {
  std::array<std::string, 2> columns;  // of the table in either run
  bool by_row = false;                 // courses have traces of their own
  std::vector<Measure> measures;
  std::vector<double> tolerance;                    // of each measure; NaN: none
  std::map<std::string, std::vector<Course>> rows;  // those that have differed, a course a measure
  std::vector<std::vector<double>> trace;           // of each measure, the largest of all rows in each span
};

// Where runs first differ by a bit.
struct FirstDifference {
  uint64_t tick = 0;
  std::string table, row, column;  // no column: the row is there in one run only
  std::array<std::string, 2> value, writer;
};

// "QUANTITY/MEASURE", or more of the measure's whole name from its end, such as "robot/*/pose/distance".
using Tolerances = std::map<std::string, double>;

class Divergence {
 public:
  // A trace has a value for each `span` ticks.
  Divergence(Tolerances tolerances, uint64_t span) : tolerances_(std::move(tolerances)), span_(span) {}

  // Both stand at the same tick. Call at the start and after each tick; the first throws Error if a tolerance is of no
  // measure that both have.
  void look(const Simulation& a, const Simulation& b);

  const std::map<std::string, TableDivergence>& tables() const { return tables_; }
  const std::optional<FirstDifference>& first() const { return first_; }
  // Tables, columns and rows that one run alone has.
  const std::set<std::string>& only(std::size_t run) const { return only_[run]; }
  bool same() const { return !first_ && only_[0].empty() && only_[1].empty(); }
  // Whether every difference is within its tolerance.
  bool within() const;
  uint64_t tick() const { return tick_; }
  uint64_t span() const { return span_; }

 private:
  struct Pair {
    const Simulation* run[2];
    const Table* table[2];
    const std::string& name;
  };
  bool compare(const Pair& pair);
  void pair_columns(const Pair& pair, TableDivergence& found);
  void compare_rows(const Pair& pair, TableDivergence& found, std::size_t in_a, std::size_t in_b);
  void compare_counts(const Pair& pair, TableDivergence& found);
  void note(TableDivergence& found, const std::string& row, std::size_t measure, double difference, bool unlike);
  void note_only(const Pair& pair, TableDivergence& found, const RowPairs& rows);
  void find_first(const Simulation& a, const Simulation& b, const std::set<std::string>& differing);
  void check_tolerances() const;

  Tolerances tolerances_;
  uint64_t span_;
  uint64_t tick_ = 0;
  std::map<std::string, TableDivergence> tables_;
  std::array<std::map<std::string, std::map<std::string, double>>, 2>
      counts_;  // of a queue's rows so far, by their names
  std::optional<FirstDifference> first_;
  std::array<std::set<std::string>, 2> only_;
};

}  // namespace muster
