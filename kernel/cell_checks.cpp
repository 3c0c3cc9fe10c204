#include "cell_checks.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "text/names.hpp"
#include "text/number.hpp"

namespace muster {
namespace {

bool any_dead(const Set& set) {
  return set.kind == SetKind::live && std::memchr(set.alive.data(), 0, set.alive.size());
}

void poison_row(std::vector<double>& data, std::size_t row, std::size_t width) {
  std::fill_n(data.begin() + static_cast<std::ptrdiff_t>(row * width), width, poison());
}

// Poisons the rows still in the set; rows that have left keep their last values and have no writer.
void poison_alive(std::vector<double>& data, const Table& table) {
  const Set& set = table.set();
  if (!any_dead(set)) return std::fill(data.begin(), data.end(), poison());
  for (std::size_t r = 0; r < table.now().rows; ++r) {
    if (set.alive[r]) poison_row(data, r, table.width());
  }
}

void prepare(Claim& claim, uint64_t tick) {
  Table& table = *claim.out;
  if (claim.direct) {
    if (!table.begun()) table.begin(false, tick);
    return std::fill(table.next().data.begin(), table.next().data.end(), poison());
  }
  claim.appended = 0;
  claim.puts.clear();
  if (claim.lists || table.set().kind == SetKind::queue)
    claim.aside.clear();  // otherwise rows of the step before would look filled
  const bool queue = table.set().kind == SetKind::queue;
  if (claim.lists) return;  // begun when its rows are known
  const bool whole = claim.row < 0 && !claim.staged;
  if (!table.begun()) {
    table.begin(!whole || any_dead(table.set()), tick);
    if (claim.kind == MUSTER_MODIFY && !queue && (!whole || any_dead(table.set()))) {
      table.next().data = claim.in->now().data;  // rows that this stage does not touch pass through
      table.next().blobs = claim.in->now().blobs;
    }
  }
  if (queue) return;
  if (claim.staged) {
    claim.aside.assign(table.now().data.begin(), table.now().data.end());
    poison_alive(claim.aside, table);
  } else if (claim.row >= 0) {
    poison_row(table.next().data, static_cast<std::size_t>(claim.row), table.width());
  } else {
    poison_alive(table.next().data, table);
  }
}

// The rows that a claim has written in this step.
struct Written {
  const double* data;
  std::size_t rows;
};

Written written(const Claim& claim) {
  const auto width = claim.columns.size();
  if (claim.lists || claim.out->set().kind == SetKind::queue) return {claim.aside.data(), claim.appended};
  const auto& next = claim.out->next();
  if (claim.staged) return {claim.aside.data(), next.rows};
  if (claim.row >= 0) return {next.data.data() + static_cast<std::size_t>(claim.row) * width, 1};
  return {next.data.data(), next.rows};
}

constexpr const char* unfilled =
    "is not filled; expected step() to fill each cell that it writes in every tick, also where nothing is to change";

std::string wrong_value(const Column& column, double value) {
  if (std::bit_cast<uint64_t>(value) == poison_bits)
    return std::string(unfilled) + (column.nullable ? "; one without a value is muster::null()" : "");
  if (std::isnan(value)) {
    if (!column.nullable) return "is NaN; expected a number: 0 / 0 is none, nor a logarithm or root of less than 0";
    return std::bit_cast<uint64_t>(value) == MUSTER_NULL_BITS ? "" : "is NaN; an empty cell is muster::null()";
  }
  if (std::isinf(value) && !column.infinite) return "is infinite; expected a number: a value over 0 is none";
  return "";
}

std::size_t rows_of(const Instance& instance, const Set& set) {
  for (const auto& claim : instance.claims()) {
    if (claim.out && claim.lists && &claim.out->set() == &set) return claim.appended;
  }
  return set.rows();
}

// For each column, the number of rows that its references may name; 0 for a column without references.
std::vector<double> referred_rows(const Instance& instance, const Blackboard& board, const Columns& columns) {
  std::vector<double> rows(columns.size());
  for (std::size_t c = 0; c < rows.size(); ++c) {
    const Set* set = columns[c].reference.empty() ? nullptr : board.find_set(columns[c].reference);
    if (set) rows[c] = static_cast<double>(rows_of(instance, *set));
  }
  return rows;
}

bool names_row(double value, double rows) {
  return value >= 0 && value < rows && value == static_cast<double>(static_cast<std::int64_t>(value));
}

std::string wrong_reference(const Column& column, double value, double rows) {
  if (column.reference.empty() || (column.nullable && std::isnan(value)) || names_row(value, rows)) return "";
  return "is no row of " + column.reference;
}

// Names of the rows that a row without a name refers to, such as the radios of a link's endpoints: "a, b".
std::string referred_names(const Blackboard& board, const Set& set, std::size_t row, int depth = 0) {
  constexpr int deepest = 4;  // sets may refer to each other
  if (set.is_named() && row < set.names.size()) return set.names[row];
  std::string result;
  for (const auto& [name, table] : board.tables()) {
    if (&table->set() != &set || !table->columns().any_references() || row >= table->now().rows || depth == deepest)
      continue;
    for (std::size_t c = 0; c < table->width(); ++c) {
      const double value = table->now().data[row * table->width() + c];
      const Set* to = table->columns()[c].reference.empty() ? nullptr : board.find_set(table->columns()[c].reference);
      if (!to || !(value >= 0)) continue;
      const std::string one = referred_names(board, *to, static_cast<std::size_t>(value), depth + 1);
      if (!one.empty()) result += (result.empty() ? "" : ", ") + one;
    }
    return result;
  }
  return "";
}

// Distance of the two rows of another set that a row refers to, where those have places, as the endpoints of a link do;
// NaN where there is none.
double apart(const Blackboard& board, const Set& set, std::size_t row) {
  const auto numbers = [&](const Set& of, std::size_t at, const auto& is_meant) {
    std::vector<double> result;
    for (const auto& [name, table] : board.tables()) {
      if (&table->set() != &of || at >= table->now().rows) continue;
      for (std::size_t c = 0; c < table->width(); ++c) {
        if (is_meant(table->columns()[c])) result.push_back(table->now().data[at * table->width() + c]);
      }
      if (!result.empty()) return result;
    }
    return result;
  };
  const Set* ends = nullptr;
  const auto refers = [&](const Column& column) {
    if (!ends && !column.reference.empty()) ends = board.find_set(column.reference);
    return ends && board.find_set(column.reference) == ends;
  };
  const auto is_place = [](const Column& c) { return c.name == "x" || c.name == "y" || c.name == "z"; };
  const auto both = numbers(set, row, refers);
  if (both.size() != 2 || !(both[0] >= 0) || !(both[1] >= 0)) return null();
  const auto a = numbers(*ends, static_cast<std::size_t>(both[0]), is_place);
  const auto b = numbers(*ends, static_cast<std::size_t>(both[1]), is_place);
  return a.size() == 3 && b.size() == 3 ? std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) : null();
}

// Of a cell that is no number because the two ends of its row are at one place; else "".
std::string at_one_place(const Blackboard& board, const Claim& claim, std::size_t row, double value) {
  const Set& set = claim.out->set();
  const bool is_poison = std::bit_cast<uint64_t>(value) == poison_bits;
  if (set.kind != SetKind::listed || claim.lists || is_poison || std::isfinite(value) || apart(board, set, row) != 0)
    return "";
  return std::string(std::isinf(value) ? "is infinite" : "is NaN") +
         ": the two are 0 m apart, at one place; expected a number there, too: hold the distance above 0, as by "
         "std::max(0.01, distance), before a division or a logarithm, or move one of the two in the world";
}

bool is_queue_of_one(const Claim& claim) { return claim.row >= 0 && claim.out->set().kind == SetKind::queue; }

std::string cell_name(const Blackboard& board, const Claim& claim, std::size_t row, std::size_t column) {
  const Set& set = claim.out->set();
  const std::size_t number = claim.row >= 0 && set.kind != SetKind::queue ? static_cast<std::size_t>(claim.row) : row;
  const std::string name = is_queue_of_one(claim)                        ? claim.name.row
                           : set.is_named() && number < set.names.size() ? set.names[number]
                                                                         : std::to_string(number);
  const std::string of = set.kind == SetKind::listed && !claim.lists ? referred_names(board, set, number) : "";
  return claim.name.set + '/' + name + '/' + claim.name.quantity + (of.empty() ? "" : " (" + of + ")") + ": " +
         claim.columns[column].title();
}

// True for rows outside the claim: those of other instances, and those that have left.
bool is_others(const Claim& claim, std::size_t row) {
  const Set& set = claim.out->set();
  if (claim.row < 0 && set.is_named() && !set.alive[row]) return true;
  return claim.staged &&
         std::find(claim.others.begin(), claim.others.end(), static_cast<int>(row)) != claim.others.end();
}

// True where the claimant of one owner's queue appends a row of another owner.
bool speaks_for_another(const Claim& claim, double owner) { return is_queue_of_one(claim) && owner != claim.row; }

// `is 0, which is base, but it speaks for rover alone; expected "radio" as send() and append() fill it in`.
std::string for_itself_alone(const Blackboard& board, const Claim& claim, double owner) {
  const Column& column = claim.columns[0];
  const Set* owners = board.find_set(column.reference);
  const auto row = static_cast<std::size_t>(owner);
  std::string result = "is " + print_real(owner);
  if (owners && owners->is_named() && row < owners->names.size()) result += ", which is " + owners->names[row];
  result += ", but it speaks for " + claim.name.row + " alone; expected " + quote(column.name) +
            " to be left as send() and append() fill it in";
  for (std::size_t c = 1; c < claim.columns.size(); ++c) {
    if (claim.columns[c].reference == column.reference)
      return result + ", and whom it is for in " + quote(claim.columns[c].name) +
             (claim.columns[c].nullable ? " (null(): all)" : "");
  }
  return result;
}

// Fast path of the check: true where all written cells are finite, and all references are row numbers. No message.
bool is_plain(const Columns& columns, const Written& cells, const std::vector<double>& referred) {
  const std::size_t width = columns.size();
  if (columns.any_bytes() || !all_finite(cells.data, cells.rows * width)) return false;
  for (std::size_t c = 0; c < width; ++c) {
    for (std::size_t r = 0; !columns[c].reference.empty() && r < cells.rows; ++r) {
      if (!names_row(cells.data[r * width + c], referred[c])) return false;
    }
  }
  return true;
}

std::string check(const Instance& instance, const Blackboard& board, const Claim& claim) {
  const auto [data, rows] = written(claim);
  const auto width = claim.columns.size();
  const std::vector<double> referred = referred_rows(instance, board, claim.columns);
  if (!is_queue_of_one(claim) && is_plain(claim.columns, {data, rows}, referred)) return "";
  for (std::size_t r = 0; r < rows; ++r) {
    if (is_others(claim, r)) continue;
    for (std::size_t c = 0; c < width; ++c) {
      const auto& column = claim.columns[c];
      if (column.bytes) continue;  // filled by put_bytes(), or empty
      std::string wrong = wrong_value(column, data[r * width + c]);
      if (const std::string near = wrong.empty() ? "" : at_one_place(board, claim, r, data[r * width + c]);
          !near.empty())
        wrong = near;
      if (wrong.empty()) wrong = wrong_reference(column, data[r * width + c], referred[c]);
      if (wrong.empty() && c == 0 && speaks_for_another(claim, data[r * width]))
        wrong = for_itself_alone(board, claim, data[r * width]);
      if (!wrong.empty()) return cell_name(board, claim, r, c) + ' ' + wrong;
    }
  }
  return "";
}

// Moves the bytes written to the table; a bytes cell that got none is empty, and others' rows keep theirs.
void commit_bytes(Claim& claim, Cells& next, std::size_t first) {
  if (!claim.out->columns().any_bytes()) return;
  const auto width = claim.columns.size();
  const auto rows = written(claim).rows;
  const std::size_t start =
      claim.row >= 0 && claim.out->set().kind != SetKind::queue ? static_cast<std::size_t>(claim.row) : first;
  for (std::size_t c = 0; c < width; ++c) {
    if (!claim.columns[c].bytes) continue;
    for (std::size_t r = 0; r < rows; ++r) {
      if (!is_others(claim, r)) next.data[(start + r) * width + c] = 0;
    }
  }
  for (const auto& put : claim.puts) {
    if (is_others(claim, put.row)) continue;
    next.blobs.push_back(put.blob);
    next.data[(start + put.row) * width + put.column] = static_cast<double>(next.blobs.size());
  }
}

void commit_rows(Claim& claim, Cells& next, uint64_t tick) {
  const auto width = claim.columns.size();
  const auto first = next.rows;
  next.data.insert(next.data.end(), claim.aside.begin(),
                   claim.aside.begin() + static_cast<std::ptrdiff_t>(claim.appended * width));
  next.rows += claim.appended;
  next.appended.insert(next.appended.end(), claim.appended, tick);
  commit_bytes(claim, next, first);
}

void commit_listed(Claim& claim, uint64_t tick) {
  claim.out->begin(false, tick);
  std::copy_n(claim.aside.begin(), claim.appended * claim.columns.size(), claim.out->next().data.begin());
  commit_bytes(claim, claim.out->next(), 0);
}

// Copies the claim's own rows into a table whose other rows have other writers, or had; bytes of those are not of this
// step.
void commit_rest(Claim& claim) {
  const auto width = claim.columns.size();
  auto& next = claim.out->next();
  for (std::size_t r = 0; r < next.rows; ++r) {
    if (is_others(claim, r)) continue;
    for (std::size_t c = 0; c < width; ++c) {
      if (!claim.columns[c].bytes) next.data[r * width + c] = claim.aside[r * width + c];
    }
  }
  commit_bytes(claim, next, 0);
}

// Restores the values of rows that have left, which keep them even if they are written.
void keep_left(Claim& claim) {
  Table& table = *claim.out;
  if (!any_dead(table.set())) return;
  const auto width = table.width();
  for (std::size_t r = 0; r < table.now().rows; ++r) {
    if (table.set().alive[r]) continue;
    for (std::size_t c = 0; c < width; ++c) {
      double value = table.now().data[r * width + c];
      if (table.columns()[c].bytes && value != 0) {
        table.next().blobs.push_back(table.now().blobs[static_cast<std::size_t>(value) - 1]);
        value = static_cast<double>(table.next().blobs.size());
      }
      table.next().data[r * width + c] = value;
    }
  }
}

// All tables of a listed set that one instance lists must have the same rows.
std::string commit_lists(Instance& instance, uint64_t tick) {
  for (auto& claim : instance.claims()) {
    if (!claim.out || !claim.lists) continue;
    for (const auto& other : instance.claims()) {
      if (&other == &claim) break;
      if (!other.out || !other.lists || &other.out->set() != &claim.out->set() || other.appended == claim.appended)
        continue;
      return "lists " + std::to_string(other.appended) + " rows of " + other.name.logical() + ", but " +
             std::to_string(claim.appended) + " of " + claim.name.logical();
    }
    claim.out->set().listed = claim.appended;
    commit_listed(claim, tick);
  }
  return "";
}

}  // namespace

bool all_finite(const double* data, std::size_t count) {
  constexpr std::size_t lanes = 8;  // independent partial sums
  double sums[lanes] = {};
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) sums[lane] += data[i + lane] * 0;
  }
  for (; i < count; ++i) sums[0] += data[i] * 0;
  return std::all_of(sums, sums + lanes, [](double sum) { return sum == 0; });
}

void prepare_cells(Instance& instance, uint64_t tick) {
  for (auto& claim : instance.claims()) {
    if (claim.out) prepare(claim, tick);
  }
}

std::string check_cells(const Instance& instance, const Blackboard& board) {
  for (const auto& claim : instance.claims()) {
    if (!claim.out) continue;
    const auto& next = claim.out->next().data;
    if (claim.direct && !claim.columns.any_references() && all_finite(next.data(), next.size())) continue;
    std::string wrong = check(instance, board, claim);
    if (!wrong.empty()) return wrong;
  }
  return "";
}

std::string commit_cells(Instance& instance, uint64_t tick) {
  for (auto& claim : instance.claims()) {
    if (!claim.out || claim.lists || claim.direct) continue;
    if (claim.out->set().kind == SetKind::queue)
      commit_rows(claim, claim.out->next(), tick);
    else if (claim.staged)
      commit_rest(claim);
    else
      commit_bytes(claim, claim.out->next(), 0);
    if (claim.out->set().is_named()) keep_left(claim);
  }
  return commit_lists(instance, tick);
}

}  // namespace muster
