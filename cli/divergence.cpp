#include "divergence.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <muster/tables.hpp>

#include "pose_angles.hpp"
#include "text/names.hpp"

namespace muster {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

bool is_pose(const Table& table) { return table.columns().text() == Pose::columns; }
bool is_queue(const Table& table) { return table.set().kind == SetKind::queue; }

const double* cells_of(const Table& table, std::size_t row) { return table.now().data.data() + row * table.width(); }

bool same_bits(double a, double b) { return std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b); }

bool same_bytes(const Table& a, double in_a, const Table& b, double in_b) {
  if (in_a == 0 || in_b == 0) return in_a == in_b;
  return *a.now().blobs[static_cast<std::size_t>(in_a) - 1] == *b.now().blobs[static_cast<std::size_t>(in_b) - 1];
}

// Whether a cell is the same thing in both runs, to the last bit.
bool same_cell(const Simulation* const run[2], const Table* const table[2], const int column[2],
               const double value[2]) {
  const Column& a = table[0]->columns()[static_cast<std::size_t>(column[0])];
  const Column& b = table[1]->columns()[static_cast<std::size_t>(column[1])];
  if (a.bytes || b.bytes) return a.bytes && b.bytes && same_bytes(*table[0], value[0], *table[1], value[1]);
  if (same_bits(value[0], value[1])) return true;
  return !a.reference.empty() && cell_name(*run[0], a, value[0]) == cell_name(*run[1], b, value[1]);
}

// Null where no instance does. Who writes a queue's row claims it by its owner.
const Instance* writer_of(const Simulation& run, const Table& table, std::size_t row) {
  const int claimed = static_cast<int>(is_queue(table) ? *cells_of(table, row) : static_cast<double>(row));
  const auto writes = [&](const Claim& claim) {
    return claim.out == &table && (claim.row < 0 || claim.row == claimed) &&
           std::find(claim.others.begin(), claim.others.end(), claimed) == claim.others.end();
  };
  for (const auto& instance : run.instances()) {
    if (std::any_of(instance->claims().begin(), instance->claims().end(), writes)) return instance.get();
  }
  return nullptr;
}

// "physics (physics.simbody/1)"
std::string title(const Instance& instance) { return instance.name() + " (" + instance.plugin().id + ')'; }

std::string writer_text(const Simulation& run, const Table& table, std::size_t row) {
  if (const Instance* writer = writer_of(run, table, row)) return title(*writer);
  for (const auto& batch : run.batches()) {
    for (const auto& sum : batch.sums) {
      if (sum.total == &table) return "the sum of its parts";
    }
  }
  return "the world file";
}

// Who would write in this run what that instance of the other one writes.
std::string counterpart(const Simulation& run, const Instance* writer) {
  for (const auto& instance : run.instances()) {
    if (writer && instance->name() == writer->name()) return title(*instance);
  }
  return "nobody";
}

// Names of tables, what the world gives before what instances write, in the order in which they do.
std::vector<std::string> in_order(const Simulation& run) {
  std::vector<std::string> written, result;
  for (const auto& batch : run.batches()) {
    for (const Instance* instance : batch.instances) {
      for (const Claim& claim : instance->claims()) {
        if (claim.out) written.push_back(claim.out->name());
      }
    }
    for (const auto& sum : batch.sums) written.push_back(sum.total->name());
  }
  for (const auto& [name, table] : run.board().tables()) {
    if (std::find(written.begin(), written.end(), name) == written.end()) result.push_back(name);
  }
  result.insert(result.end(), written.begin(), written.end());
  return result;
}

// Columns of one name and unit, or, if asked, what one run alone has.
std::vector<Measure> common_columns(const Table* const table[2], std::array<std::set<std::string>, 2>* only = nullptr) {
  std::vector<Measure> result;
  for (std::size_t i = 0; i < 2; ++i) {
    const Columns &columns = table[i]->columns(), &others = table[1 - i]->columns();
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const int other = others.find(columns[c].name);
      const bool both = other >= 0 && others[static_cast<std::size_t>(other)].title() == columns[c].title();
      if (both && i == 0) result.push_back({columns[c].name, columns[c].unit, {static_cast<int>(c), other}});
      if (!both && only) (*only)[i].insert(table[i]->name() + ' ' + columns[c].title());
    }
  }
  return result;
}

// The first bit in which a table's rows differ, its tick and writers left out.
std::optional<FirstDifference> first_in(const Simulation* const run[2], const Table* const table[2],
                                        const RowPairs& rows) {
  const auto columns = common_columns(table);
  for (const auto& [in_a, in_b] : rows.both) {
    for (const Measure& measure : columns) {
      const double value[] = {cells_of(*table[0], in_a)[measure.column[0]],
                              cells_of(*table[1], in_b)[measure.column[1]]};
      if (same_cell(run, table, measure.column, value)) continue;
      FirstDifference result;
      result.row = row_name(*run[0], *table[0], in_a);
      result.column = measure.title();
      for (std::size_t i = 0; i < 2; ++i) {
        const Column& column = table[i]->columns()[static_cast<std::size_t>(measure.column[i])];
        result.value[i] = column.bytes ? "other bytes" : cell_name(*run[i], column, value[i]);
        result.writer[i] = writer_text(*run[i], *table[i], i == 0 ? in_a : in_b);
      }
      return result;
    }
  }
  for (std::size_t i = 0; i < 2; ++i) {
    if (rows.only[i].empty()) continue;
    const auto& [name, row] = rows.only[i].front();
    FirstDifference result;
    result.row = name;
    result.value[i] = "there";
    result.value[1 - i] = "not there";
    result.writer[i] = writer_text(*run[i], *table[i], row);
    result.writer[1 - i] = counterpart(*run[1 - i], writer_of(*run[i], *table[i], row));
    return result;
  }
  return {};
}

bool ends_in(const std::string& whole, const std::string& end) { return whole == end || whole.ends_with('/' + end); }

}  // namespace

void Divergence::look(const Simulation& a, const Simulation& b) {
  tick_ = a.tick();
  std::set<std::string> differing;
  for (const auto& [name, table] : a.board().tables()) {
    const auto other = b.board().tables().find(name);
    if (other == b.board().tables().end())
      only_[0].insert(name);
    else if (compare({{&a, &b}, {table.get(), other->second.get()}, name}))
      differing.insert(name);
  }
  for (const auto& [name, table] : b.board().tables()) {
    if (!a.board().tables().count(name)) only_[1].insert(name);
  }
  if (!first_ && !differing.empty()) find_first(a, b, differing);
  if (tick_ == 0) check_tolerances();
}

void Divergence::pair_columns(const Pair& pair, TableDivergence& found) {
  for (std::size_t i = 0; i < 2; ++i) found.columns[i] = pair.table[i]->columns().text();
  found.measures = common_columns(pair.table, &only_);
  for (Measure& measure : found.measures) {
    if (measure.unit == "dBm") measure.unit = "dB";  // what levels differ by
  }
  const bool poses = is_pose(*pair.table[0]) && is_pose(*pair.table[1]);
  if (poses) found.measures = {{"distance", "m"}, {"heading", "rad"}, {"tilt", "rad"}};
  if (is_queue(*pair.table[0])) found.measures.push_back({"count", ""});
  found.by_row = poses && pair.table[0]->set().is_named();
  found.tolerance.assign(found.measures.size(), nothing);
  for (std::size_t m = 0; m < found.measures.size(); ++m) {
    for (const auto& [quantity, tolerance] : tolerances_) {
      if (ends_in(pair.name + '/' + found.measures[m].name, quantity)) found.tolerance[m] = tolerance;
    }
  }
  found.trace.resize(found.measures.size());
  for (auto& [row, courses] : found.rows) courses.resize(found.measures.size());
}

void Divergence::check_tolerances() const {
  for (const auto& [quantity, tolerance] : tolerances_) {
    std::vector<std::string> valid;
    bool known = false;
    for (const auto& [name, found] : tables_) {
      for (const Measure& measure : found.measures) {
        known |= ends_in(name + '/' + measure.name, quantity);
        valid.push_back(name.substr(name.rfind('/') + 1) + '/' + measure.name);
      }
    }
    std::sort(valid.begin(), valid.end());
    valid.erase(std::unique(valid.begin(), valid.end()), valid.end());  // tables of one quantity share its name
    std::vector<std::string> below;                                     // a table was named, and not its measure
    std::copy_if(valid.begin(), valid.end(), std::back_inserter(below),
                 [&](const std::string& each) { return each.starts_with(quantity + '/'); });
    if (!known && !below.empty())
      throw Error(Exit::invalid_input, "--within: " + quote(quantity) + " is no quantity; " + expected_one_of(below));
    if (!known)
      throw Error(Exit::invalid_input,
                  "--within: both runs have no quantity " + quote(quantity) + "; " + suggest(quantity, valid));
  }
}

// True where anything differs, down to a bit.
bool Divergence::compare(const Pair& pair) {
  const Table &a = *pair.table[0], &b = *pair.table[1];
  TableDivergence& found = tables_[pair.name];
  if (found.columns[0] != a.columns().text() || found.columns[1] != b.columns().text()) pair_columns(pair, found);
  const RowPairs rows = row_pairs(*pair.run[0], a, *pair.run[1], b);
  const auto &of_a = a.now().data, &of_b = b.now().data;
  const bool is_plain = found.columns[0] == found.columns[1] && !a.columns().any_bytes();
  if (rows.in_place && is_plain && std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), same_bits))
    return false;
  note_only(pair, found, rows);
  for (const auto& [in_a, in_b] : rows.both) compare_rows(pair, found, in_a, in_b);
  if (is_queue(a)) compare_counts(pair, found);
  return !first_ && first_in(pair.run, pair.table, rows);
}

void Divergence::compare_rows(const Pair& pair, TableDivergence& found, std::size_t in_a, std::size_t in_b) {
  const double *a = cells_of(*pair.table[0], in_a), *b = cells_of(*pair.table[1], in_b);
  const std::size_t width = pair.table[0]->width();
  if (found.columns[0] == found.columns[1] && !pair.table[0]->columns().any_bytes() &&
      std::equal(a, a + width, b, same_bits))
    return;
  const std::string row = row_name(*pair.run[0], *pair.table[0], in_a);
  for (std::size_t m = 0; m < found.measures.size(); ++m) {
    const Measure& measure = found.measures[m];
    if (measure.column[0] < 0) continue;
    const double value[] = {a[measure.column[0]], b[measure.column[1]]};
    if (same_cell(pair.run, pair.table, measure.column, value)) continue;
    const Column& column = pair.table[0]->columns()[static_cast<std::size_t>(measure.column[0])];
    const double difference = value[1] - value[0];
    const bool unlike = column.bytes || !column.reference.empty() || !std::isfinite(difference);
    note(found, row, m, unlike ? 0 : difference, unlike);
  }
  const bool poses = !found.measures.empty() && found.measures[0].column[0] < 0 && !is_queue(*pair.table[0]);
  if (!poses) return;
  const Pose &p = *reinterpret_cast<const Pose*>(a), &q = *reinterpret_cast<const Pose*>(b);
  note(found, row, 0, std::hypot(q.x - p.x, q.y - p.y, q.z - p.z), false);
  note(found, row, 1, turned(p, q), false);
  note(found, row, 2, tilted(p, q), false);
}

// Messages that differ in number go on doing so when none comes.
void Divergence::compare_counts(const Pair& pair, TableDivergence& found) {
  for (std::size_t i = 0; i < 2; ++i) {
    const Cells& cells = pair.table[i]->now();
    for (std::size_t row = 0; row < cells.rows; ++row) {
      if (cells.appended[row] != tick_) continue;
      const std::string name = row_name(*pair.run[i], *pair.table[i], row);
      counts_[0][pair.name][name] += i == 0;
      counts_[1][pair.name][name] += i == 1;
    }
  }
  for (const auto& [name, count] : counts_[0][pair.name])
    note(found, name, found.measures.size() - 1, counts_[1][pair.name][name] - count, false);
}

void Divergence::note_only(const Pair& pair, TableDivergence& found, const RowPairs& rows) {
  const Set& set = pair.table[0]->set();
  for (std::size_t i = 0; i < 2; ++i) {
    for (const auto& [row, number] : rows.only[i]) {
      if (set.is_named()) only_[i].insert(set.name + '/' + row);
      for (std::size_t m = 0; m < found.measures.size(); ++m) {
        const bool counts = set.kind == SetKind::listed || (set.is_named() && !std::isnan(found.tolerance[m]));
        if (counts) note(found, row, m, 0, true);
      }
    }
  }
}

void Divergence::note(TableDivergence& found, const std::string& row, std::size_t measure, double difference,
                      bool unlike) {
  if (difference == 0 && !unlike) return;
  auto& courses = found.rows[row];
  courses.resize(found.measures.size());
  Course& course = courses[measure];
  const double size = std::abs(difference);
  course.first = std::min(course.first, tick_);
  course.unlike += unlike;
  if (size > course.largest) course.largest = size, course.largest_at = tick_;
  const double tolerance = found.tolerance[measure];
  if (size > tolerance || (unlike && !std::isnan(tolerance))) course.beyond = std::min(course.beyond, tick_);
  course.now = unlike ? nothing : difference;
  course.now_at = tick_;
  const auto extend = [&](std::vector<double>& trace) {
    trace.resize(std::max<std::size_t>(trace.size(), tick_ / span_ + 1));
    trace.back() = std::max(trace.back(), size);
  };
  extend(found.trace[measure]);
  if (found.by_row) extend(course.trace);
}

void Divergence::find_first(const Simulation& a, const Simulation& b, const std::set<std::string>& differing) {
  const Simulation* const run[] = {&a, &b};
  for (const std::string& name : in_order(a)) {
    if (!differing.count(name)) continue;
    const Table* const table[] = {a.board().find(name), b.board().find(name)};
    first_ = first_in(run, table, row_pairs(a, *table[0], b, *table[1]));
    first_->tick = tick_;
    first_->table = name;
    return;
  }
}

bool Divergence::within() const {
  for (const auto& [name, found] : tables_) {
    for (const auto& [row, courses] : found.rows) {
      if (std::any_of(courses.begin(), courses.end(), [](const Course& c) { return c.beyond != Course::never; }))
        return false;
    }
  }
  return true;
}

}  // namespace muster
