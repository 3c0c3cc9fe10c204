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

// What poisons a cell that is to be filled: a NaN of its own, never taken for a value.
inline constexpr uint64_t poison_bits = 0x7ffadead0badcafeull;
inline double poison() { return std::bit_cast<double>(poison_bits); }

// Rows that have names, or, in queues and listed sets, only numbers. Numbers never change.
struct Set {
  std::string name;
  SetKind kind = SetKind::fixed;
  std::string owner;  // queue: the set whose row stands in column 0
  std::vector<std::string> names;
  std::vector<uint64_t> keys;  // random keys, from the names alone
  std::vector<uint8_t> alive;  // 0: the row has left
  std::vector<uint32_t> like;  // the row whose texts it has: its own, or that of which it joined as a copy
  std::size_t listed = 0;      // how many rows a listed set has now
  std::unordered_map<std::string, uint32_t> numbers;

  bool is_named() const { return kind == SetKind::fixed || kind == SetKind::live; }
  std::size_t rows() const { return kind == SetKind::listed ? listed : names.size(); }
  // The row's number, or -1.
  int find(const std::string& row) const;
  // False if the name is taken. `like`: a row that there is, or negative.
  bool add(const std::string& row, int like = -1);
  // Forgets the rows from this number on.
  void cut(std::size_t rows);
};

using Blob = std::shared_ptr<const std::vector<uint8_t>>;

// One version of a table's cells, row-major. A bytes cell holds 1 + its place in `blobs`, or 0 for no bytes.
struct Cells {
  std::vector<double> data;
  std::vector<Blob> blobs;
  std::vector<uint64_t> appended;  // queue: the tick at which each row came
  std::size_t rows = 0;
  uint64_t tick = 0;  // at which it was published
};

// A table: what is published, and what is being written. A tick that fails takes back what it published.
class Table {
 public:
  Table(std::string name, Set& set, Columns columns, std::string initial);
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;

  const std::string& name() const { return name_; }
  Set& set() const { return *set_; }
  const Columns& columns() const { return columns_; }
  std::size_t width() const { return columns_.size(); }

  const Cells& now() const { return *now_; }
  Cells& next() { return *next_; }
  // What was written in this tick, published or not; else what stands.
  const Cells& newest() const { return begun_ && !published_ ? *next_ : *now_; }
  // To put initial or restored values in place; not for steps.
  Cells& stored() {
    ++version_;
    return *now_;
  }
  // Grows whenever something new may stand.
  uint64_t version() const { return version_; }

  // Opens `next` for writing, once a tick: with last values carried over, or not where every cell will be written.
  void begin(bool carry, uint64_t tick) {
    begun_ = true;
    const bool is_sized = set_->kind == SetKind::fixed && next().rows == now().rows && next().blobs.empty();
    if (carry || !is_sized) begin_anew(carry, tick);
  }
  bool begun() const { return begun_; }
  void publish(uint64_t tick);
  bool published() const { return published_; }
  void take_back();
  void end_tick() { begun_ = published_ = false; }

  // Queue: for how many ticks after its own a row is still to be seen by some reader.
  uint64_t keep = 0;

  // One row of initial values; and such rows for those of the set that it lacks, as all do in a new table.
  void fill_initial(double* row) const;
  // Puts what another table of the same set and columns holds in place; or takes it, where nobody else will ask.
  void take_over(const Table& other);
  void take_over(Table&& other);
  void grow();

 private:
  void begin_anew(bool carry, uint64_t tick);
  void begin_queue(uint64_t tick);
  void compact_blobs();

  std::string name_;
  Set* set_;
  Columns columns_;
  std::vector<double> initial_;
  Cells cells_[2];
  Cells *now_ = &cells_[0], *next_ = &cells_[1];  // what stands, and what is being written
  bool begun_ = false, published_ = false;
  uint64_t version_ = 0;
};

class Blackboard {
 public:
  Set& add_set(const std::string& name, SetKind kind, const std::string& owner);
  Set* find_set(const std::string& name) const;
  // Sets and rows come with instances; one that is refused takes its own back.
  using Mark = std::map<std::string, std::size_t>;
  Mark mark() const;
  void back_to(const Mark& mark);
  // Forgets a set that has no tables.
  void drop_set(const std::string& name) { sets_.erase(name); }
  const std::map<std::string, std::unique_ptr<Set>>& sets() const { return sets_; }

  // By its whole name, "robot/*/pose@stage"; null if there is none.
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

// What stands in a cell, for messages and records: the number, the name of a referred row, or "" for null.
std::string cell_text(const Blackboard& board, const Column& column, double value);

}  // namespace muster
