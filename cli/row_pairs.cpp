#include "row_pairs.hpp"

#include <algorithm>

namespace muster {
namespace {

// A listed set's rows are what the table of its first quantity refers to.
const Table* first_table(const Simulation& run, const std::string& set) {
  for (const auto& declared : standard().sets) {
    if (declared.name == set) return run.board().find(set + "/*/" + declared.quantities[0].name);
  }
  return nullptr;
}

const Table* references(const Simulation& run, const Table& table) {
  return table.set().kind == SetKind::listed ? first_table(run, table.set().name) : &table;
}

std::string joined_references(const Simulation& run, const Table& table, std::size_t row) {
  std::string result;
  for (std::size_t c = 0; c < table.width(); ++c) {
    if (table.columns()[c].reference.empty()) continue;
    const std::string name = cell_name(run, table.columns()[c], table.now().data[row * table.width() + c]);
    result += (result.empty() || name.empty() ? "" : " ") + name;
  }
  return result;
}

using Named = std::map<std::string, std::size_t>;

Named rows_by_name(const Simulation& run, const Table& table) {
  Named result;
  std::map<std::string, int> seen;
  const Set& set = table.set();
  const Cells& cells = table.now();
  for (std::size_t row = 0; row < cells.rows; ++row) {
    if (set.is_named() && !set.alive[row]) continue;
    if (set.kind == SetKind::queue && cells.appended[row] != run.tick()) continue;
    std::string name = row_name(run, table, row);
    if (const int count = ++seen[name]; count > 1) name += " #" + std::to_string(count);
    result.emplace(std::move(name), row);
  }
  return result;
}

// The same rows in the same places: the commonest case by far, in which no name need be made.
bool same_rows(const Simulation& a, const Set& in_a, const Simulation& b, const Set& in_b) {
  if (in_a.kind != in_b.kind || in_a.kind == SetKind::queue) return false;
  if (in_a.is_named()) return in_a.alive == in_b.alive && in_a.names == in_b.names;
  const Table *x = first_table(a, in_a.name), *y = first_table(b, in_b.name);
  if (!x || !y || x->columns().text() != y->columns().text() || x->now().data != y->now().data) return false;
  return std::all_of(x->columns().begin(), x->columns().end(), [&](const Column& column) {
    const Set *s = a.board().find_set(column.reference), *t = b.board().find_set(column.reference);
    return column.reference.empty() || (s && t && same_rows(a, *s, b, *t));
  });
}

}  // namespace

std::string cell_name(const Simulation& run, const Column& column, double value) {
  const Table* listed = first_table(run, column.reference);
  const bool is_number = listed && !listed->set().is_named() && value < static_cast<double>(listed->now().rows);
  return is_number ? row_name(run, *listed, static_cast<std::size_t>(value)) : cell_text(run.board(), column, value);
}

std::string row_name(const Simulation& run, const Table& table, std::size_t row) {
  if (table.set().is_named()) return table.set().names[row];
  const Table* by = references(run, table);
  std::string name = by && row < by->now().rows ? joined_references(run, *by, row) : "";
  return name.empty() ? std::to_string(row) : name;
}

RowPairs row_pairs(const Simulation& a, const Table& in_a, const Simulation& b, const Table& in_b) {
  RowPairs result;
  if (in_a.now().rows == in_b.now().rows && same_rows(a, in_a.set(), b, in_b.set())) {
    result.in_place = true;
    for (std::size_t row = 0; row < in_a.now().rows; ++row) {
      if (!in_a.set().is_named() || in_a.set().alive[row]) result.both.emplace_back(row, row);
    }
    return result;
  }
  const Named of_a = rows_by_name(a, in_a), of_b = rows_by_name(b, in_b);
  for (const auto& [name, row] : of_a) {
    const auto found = of_b.find(name);
    if (found != of_b.end())
      result.both.emplace_back(row, found->second);
    else
      result.only[0].emplace_back(name, row);
  }
  for (const auto& [name, row] : of_b) {
    if (!of_a.count(name)) result.only[1].emplace_back(name, row);
  }
  return result;
}

}  // namespace muster
