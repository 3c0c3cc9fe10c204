// The blackboard: sets of named rows, and tables of numbers over them.
#pragma once

#include <bit>
#include <cstdint>
#include <map>
#include <memory>
#include <muster/sets.hpp>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "text/columns.hpp"

namespace muster {

// Value of a cell not yet filled: a NaN of its own bit pattern, distinct from every valid value.
inline constexpr uint64_t poison_bits = 0x7ffadead0badcafeull;
inline double poison() { return std::bit_cast<double>(poison_bits); }

// Rows with names, or, in queues and listed sets, with numbers only. Numbers never change.
struct Set {
  std::string name;
  SetKind kind = SetKind::fixed;
  std::string owner;  // queue: the owning set, whose row number is in column 0
  std::vector<std::string> names;
  std::vector<uint64_t> keys;  // random keys, from the names alone
  std::vector<uint8_t> alive;  // 0: the row has left
  std::vector<uint32_t> like;  // the row whose texts it has: its own, or that of which it joined as a copy
  std::size_t listed = 0;      // rows of a listed set now
  std::unordered_map<std::string, uint32_t> numbers;

  bool is_named() const { return kind == SetKind::fixed || kind == SetKind::live; }
  std::size_t rows() const { return kind == SetKind::listed ? listed : names.size(); }
  // The row's number, or -1.
  int find(const std::string& row) const;
  // False if the name is taken. `like`: an existing row, or negative.
  bool add(const std::string& row, int like = -1);
  // Drops the rows from this number on.
  void cut(std::size_t rows);
};

using Blob = std::shared_ptr<const std::vector<uint8_t>>;

// One version of a table's cells, row-major. A bytes cell holds 1 + its place in `blobs`, or 0 for no bytes.
struct Cells {
  std::vector<double> data;
  std::vector<Blob> blobs;
  std::vector<uint64_t> appended;  // queue: the tick of each row's arrival
  std::size_t rows = 0;
  uint64_t tick = 0;  // of its publication
};

// Keeps one version of a table's numbers for a reader outside of the run. They stay where they are and as they are: a
// table that is to change them, or goes, moves them here and goes on with a copy.
struct HeldNumbers {
  std::vector<double> data;  // empty as long as the table has them
};

// A table: its published cells and those being written. A failed tick takes back what it published.
class Table {
 public:
  Table(std::string name, Set& set, Columns columns, const std::string& initial);
  ~Table();
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;

  const std::string& name() const { return name_; }
  Set& set() const { return *set_; }
  const Columns& columns() const { return columns_; }
  std::size_t width() const { return columns_.size(); }

  const Cells& now() const { return *now_; }
  Cells& next() { return *next_; }
  // Cells written in this tick, published or not; else the published ones.
  const Cells& newest() const { return begun_ && !published_ ? *next_ : *now_; }
  // Published cells, for initial or restored values; not for steps.
  Cells& stored() {
    let_go(*now_);
    ++version_;
    return *now_;
  }
  // As long as the result lives, now().data of this moment keeps its address and its values. Not during a step.
  std::shared_ptr<const HeldNumbers> hold() const;
  // Grows with every possible change of the published cells.
  uint64_t version() const { return version_; }

  // Opens `next` for writing, once a tick: with the last values carried over, or without where every cell is to be
  // written.
  void begin(bool carry, uint64_t tick) {
    begun_ = true;
    let_go(*next_);
    const bool is_sized = set_->kind == SetKind::fixed && next().rows == now().rows && next().blobs.empty();
    if (carry || !is_sized) begin_anew(carry, tick);
  }
  bool begun() const { return begun_; }
  void publish(uint64_t tick);
  bool published() const { return published_; }
  void take_back();
  void end_tick() { begun_ = published_ = false; }

  // Queue: number of ticks after its own for which a reader may still need a row.
  uint64_t keep = 0;

  // fill_initial() gives one row of initial values; grow() adds such rows for those of the set that the table lacks.
  void fill_initial(double* row) const;
  // Copies the cells of another table of the same set and columns, or moves them.
  void take_over(const Table& other);
  void take_over(Table&& other);
  void grow();

 private:
  // Leaves numbers that a reader holds to it, before they change.
  void let_go(Cells& cells) {
    if (!held_of(cells).expired()) move_to_reader(cells);
  }
  void move_to_reader(Cells& cells);
  std::weak_ptr<HeldNumbers>& held_of(const Cells& cells) const { return held_[&cells - cells_]; }
  void begin_anew(bool carry, uint64_t tick);
  void begin_queue(uint64_t tick);
  void compact_blobs();

  std::string name_;
  Set* set_;
  Columns columns_;
  std::vector<double> initial_;
  Cells cells_[2];
  Cells *now_ = &cells_[0], *next_ = &cells_[1];  // published, and being written
  mutable std::weak_ptr<HeldNumbers> held_[2];    // of cells_
  bool begun_ = false, published_ = false;
  uint64_t version_ = 0;
};

class Blackboard {
 public:
  Set& add_set(const std::string& name, SetKind kind, const std::string& owner);
  Set* find_set(const std::string& name) const;
  // Row counts of all sets. A refused instance's sets and rows are removed by back_to().
  using Mark = std::map<std::string, std::size_t>;
  Mark mark() const;
  void back_to(const Mark& mark);
  // Drops a set that has no tables.
  void drop_set(const std::string& name) { sets_.erase(name); }
  const std::map<std::string, std::unique_ptr<Set>>& sets() const { return sets_; }

  // By its whole name, "robot/*/pose@stage"; null if absent.
  Table* find(const std::string& name) const;
  Table& add(std::unique_ptr<Table> table);
  // Another name of a table, such as that of the last stage of a chain.
  void alias(const std::string& name, Table& table) { aliases_[name] = &table; }
  const std::map<std::string, std::unique_ptr<Table>>& tables() const { return tables_; }
  std::map<std::string, std::unique_ptr<Table>> take_tables();

 private:
  std::map<std::string, std::unique_ptr<Set>> sets_;
  std::map<std::string, std::unique_ptr<Table>> tables_;
  std::map<std::string, Table*> aliases_;
};

// Text of a cell, for messages and records: the number, the name of a referred row, or "" for null.
std::string cell_text(const Blackboard& board, const Column& column, double value);

}  // namespace muster
