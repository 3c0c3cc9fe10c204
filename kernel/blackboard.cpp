#include "blackboard.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "text/number.hpp"

namespace muster {

int Set::find(const std::string& row) const {
  const auto found = numbers.find(row);
  return found == numbers.end() ? -1 : static_cast<int>(found->second);
}

bool Set::add(const std::string& row, int of) {
  if (!numbers.emplace(row, static_cast<uint32_t>(names.size())).second) return false;
  names.push_back(row);
  keys.push_back(key_of(row));
  alive.push_back(1);
  like.push_back(of < 0 ? static_cast<uint32_t>(names.size() - 1) : like[static_cast<std::size_t>(of)]);
  return true;
}

void Set::cut(std::size_t rows) {
  for (std::size_t r = rows; r < names.size(); ++r) numbers.erase(names[r]);
  names.resize(std::min(rows, names.size()));
  keys.resize(names.size());
  alive.resize(names.size());
  like.resize(names.size());
}

Table::Table(std::string name, Set& set, Columns columns, const std::string& initial)
    : name_(std::move(name)), set_(&set), columns_(std::move(columns)), initial_(columns_.size(), 0.0) {
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    if (columns_[c].nullable) initial_[c] = null();
  }
  if (!initial.empty()) {
    const auto values = parse_reals(initial, columns_.size());
    if (!values)
      throw std::invalid_argument("table " + name_ + ": initial values \"" + initial + "\" do not fit its columns");
    initial_ = *values;
  }
}

Table::~Table() {
  for (Cells& cells : cells_) let_go(cells);
}

std::shared_ptr<const HeldNumbers> Table::hold() const {
  auto& held = held_of(*now_);
  auto reader = held.lock();
  if (!reader) held = reader = std::make_shared<HeldNumbers>();
  return reader;
}

// The address survives the move of a vector.
void Table::move_to_reader(Cells& cells) {
  auto& held = held_of(cells);
  if (const auto reader = held.lock()) {
    reader->data = std::move(cells.data);
    cells.data = reader->data;
  }
  held.reset();
}

void Table::fill_initial(double* row) const { std::copy(initial_.begin(), initial_.end(), row); }

void Table::take_over(const Table& other) {
  stored() = other.now();
  grow();  // rows may have joined with the instance that is being linked
}

void Table::take_over(Table&& other) {
  for (Cells& cells : other.cells_) other.let_go(cells);
  stored() = std::move(*other.now_);
  *next_ = std::move(*other.next_);
  grow();
}

void Table::grow() {
  if (set_->kind == SetKind::queue) return;
  Cells& now = stored();
  const auto from = now.rows;
  now.rows = set_->rows();
  now.data.resize(now.rows * width());
  for (auto row = from; row < now.rows; ++row) fill_initial(now.data.data() + row * width());
}

void Table::begin_anew(bool carry, uint64_t tick) {
  const Cells& now = this->now();
  Cells& next = this->next();
  next.blobs.clear();
  if (set_->kind == SetKind::queue) return begin_queue(tick);
  if (set_->kind == SetKind::listed) {
    next.rows = set_->rows();  // other rows than last time: nothing carries over
    next.data.resize(next.rows * width());
    return;
  }
  next.rows = now.rows;
  next.data.resize(now.data.size());
  if (!carry) return;
  std::copy(now.data.begin(), now.data.end(), next.data.begin());
  next.blobs = now.blobs;
}

// Drops rows that every reader has seen.
void Table::begin_queue(uint64_t tick) {
  const Cells& now = this->now();
  Cells& next = this->next();
  next.data.clear();
  next.appended.clear();
  next.blobs = now.blobs;
  for (std::size_t r = 0; r < now.rows; ++r) {
    if (now.appended[r] + keep < tick) continue;
    next.data.insert(next.data.end(), now.data.begin() + r * width(), now.data.begin() + (r + 1) * width());
    next.appended.push_back(now.appended[r]);
  }
  next.rows = next.appended.size();
}

// Keeps the blobs that cells refer to, in the order of the cells: so equal tables are equal bytes.
void Table::compact_blobs() {
  Cells& next = this->next();
  std::vector<Blob> kept;
  for (std::size_t c = 0; c < width(); ++c) {
    if (!columns_[c].bytes) continue;
    for (std::size_t r = 0; r < next.rows; ++r) {
      double& cell = next.data[r * width() + c];
      if (cell == 0) continue;
      kept.push_back(next.blobs[static_cast<std::size_t>(cell) - 1]);
      cell = static_cast<double>(kept.size());
    }
  }
  next.blobs = std::move(kept);
}

void Table::publish(uint64_t tick) {
  if (columns_.any_bytes()) compact_blobs();
  next().tick = tick;
  std::swap(now_, next_);
  published_ = true;
  ++version_;
}

void Table::take_back() {
  if (published_) std::swap(now_, next_);
  ++version_;
  end_tick();
}

std::string cell_text(const Blackboard& board, const Column& column, double value) {
  if (std::isnan(value)) return "";
  if (column.reference.empty()) return print_real(value);
  const Set* set = board.find_set(column.reference);
  const auto row = static_cast<std::size_t>(value);
  return set && set->is_named() && row < set->names.size() ? set->names[row] : print_real(value);
}

Set& Blackboard::add_set(const std::string& name, SetKind kind, const std::string& owner) {
  auto& set = sets_[name];
  if (!set) {
    set = std::make_unique<Set>();
    set->name = name;
    set->kind = kind;
    set->owner = owner;
  }
  return *set;
}

Blackboard::Mark Blackboard::mark() const {
  Mark result;
  for (const auto& [name, set] : sets_) result[name] = set->names.size();
  return result;
}

void Blackboard::back_to(const Mark& mark) {
  std::erase_if(sets_, [&](const auto& set) { return !mark.count(set.first); });
  for (const auto& [name, rows] : mark) sets_.at(name)->cut(rows);
}

Set* Blackboard::find_set(const std::string& name) const {
  const auto found = sets_.find(name);
  return found == sets_.end() ? nullptr : found->second.get();
}

Table* Blackboard::find(const std::string& name) const {
  const auto found = tables_.find(name);
  if (found != tables_.end()) return found->second.get();
  const auto other = aliases_.find(name);
  return other == aliases_.end() ? nullptr : other->second;
}

Table& Blackboard::add(std::unique_ptr<Table> table) {
  auto& place = tables_[table->name()];
  place = std::move(table);
  return *place;
}

std::map<std::string, std::unique_ptr<Table>> Blackboard::take_tables() {
  aliases_.clear();
  return std::exchange(tables_, {});
}

}  // namespace muster
