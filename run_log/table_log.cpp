#include "run_log/table_log.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "run_log/tables/cdr.hpp"

namespace muster::run_log {
namespace {

// What rows without names are about: columns of another table of their set that refer to named rows in the end.
const Table* names_of_listed(const Simulation& run, const Set& set) {
  if (set.kind != SetKind::listed) return nullptr;
  for (const char* quantity : {"ends", "radio"}) {
    if (const Table* found = run.board().find(set.name + "/*/" + quantity)) return found;
  }
  return nullptr;
}

// The set whose rows give the names of what a column refers to, or null.
const Set* named_set(const Simulation& run, const std::string& reference) {
  const Set* set = reference.empty() ? nullptr : run.board().find_set(reference);
  if (!set || set->is_named()) return set;
  const Table* further = names_of_listed(run, *set);
  if (!further) return nullptr;
  for (const Column& column : further->columns()) {
    if (column.reference != set->name && !column.reference.empty()) return named_set(run, column.reference);
  }
  return nullptr;
}

}  // namespace

// The names of all rows of a set that a column refers to: its own, or of what its rows are about.
class RowNames {
 public:
  RowNames(const Simulation& run, const std::string& reference) {
    const Set* set = run.board().find_set(reference);
    if (!set) return;
    own_ = &set->names;
    const Table* further = names_of_listed(run, *set);
    for (std::size_t c = 0; further && c < further->width(); ++c) {
      const std::string& next = further->columns()[c].reference;
      if (next.empty() || next == set->name) continue;
      const RowNames names(run, next);
      own_ = nullptr;
      for (std::size_t r = 0; r < further->now().rows; ++r)
        made_.push_back(names.at(further->now().data[r * further->width() + c]));
      return;
    }
  }
  // Empty where the cell is null, or the row is none.
  std::string_view at_view(double row) const {
    const std::vector<std::string>& names = own_ ? *own_ : made_;
    return row >= 0 && row < static_cast<double>(names.size()) ? std::string_view(names[static_cast<std::size_t>(row)])
                                                               : std::string_view();
  }
  std::string at(double row) const { return std::string(at_view(row)); }

 private:
  const std::vector<std::string>* own_ = nullptr;
  std::vector<std::string> made_;
};

namespace {

Field::Kind kind_of(const Simulation& run, const Column& column) {
  if (column.bytes) return Field::Kind::bytes;
  return named_set(run, column.reference) ? Field::Kind::text : Field::Kind::real;
}

}  // namespace

std::uint64_t log_time(double seconds) { return static_cast<std::uint64_t>(std::llround(seconds * 1e9)); }

TableLog::TableLog(const std::vector<RecordDeclaration>& tables, mcap::Sink& sink) : sink_(sink) {
  std::set<std::string> seen;
  for (const auto& declared : tables) {
    if (!seen.insert(declared.table).second) continue;
    tables_.emplace_back();
    tables_.back().declared = declared;
  }
}

void TableLog::declare(const Simulation& run, const TableView& view, Logged& logged) {
  const Table& table = *view.table;
  const Set& set = table.set();
  const std::string columns = table.columns().text();
  const bool is_alike = logged.own && logged.columns == columns;  // the channels stay
  logged.own = &table;
  logged.names = names_of_listed(run, set);
  logged.columns = columns;
  logged.sources.clear();
  const Layout layout = view.row >= 0 || set.is_named() ? Layout::row
                        : set.kind == SetKind::queue    ? Layout::message
                                                        : Layout::rows;
  logged.table = {logged.declared.table, "", layout, {}};
  const auto add = [&](const Table& of, std::size_t c) {
    const Column& column = of.columns()[c];
    logged.table.fields.push_back({column.name, column.unit, kind_of(run, column)});
    logged.sources.push_back({&of, c});
  };
  if (const Table* names = logged.names; names && names != &table) {
    for (std::size_t c = 0; c < names->width(); ++c) {
      if (named_set(run, names->columns()[c].reference)) add(*names, c);
    }
  }
  for (std::size_t c = 0; c < table.width(); ++c) add(table, c);
  logged.is_plain = std::all_of(logged.table.fields.begin(), logged.table.fields.end(),
                                [](const Field& field) { return field.kind == Field::Kind::real; });
  if (is_alike) return;
  logged.channels.clear();
  mcap::Schema schema{0, type_of(logged.table), "ros2msg", definition_of(logged.table)};
  if (const int earlier = types_[schema.name]++; earlier > 0) schema.name += std::to_string(earlier + 1);
  logged.schema = sink_.schema(std::move(schema));
  // All that are known, at once: who watches can subscribe before the first message of a queue.
  const bool has_channels = layout == Layout::row && view.row < 0;
  for (std::size_t r = 0; r < (has_channels ? set.names.size() : 1); ++r) {
    if (!has_channels || set.alive[r]) channel(view, logged, r);
  }
}

std::uint16_t TableLog::channel(const TableView& view, Logged& logged, std::size_t row) {
  if (logged.channels.size() <= row) logged.channels.resize(row + 1, -1);
  int& number = logged.channels[row];
  if (number < 0) {
    LoggedTable table = logged.table;
    if (table.layout == Layout::row && view.row < 0) table.row = view.table->set().names[row];
    number = sink_.channel({0, logged.schema, topic_of(table), "cdr", metadata_of(table)});
  }
  return static_cast<std::uint16_t>(number);
}

void TableLog::send(const Simulation& run, std::uint16_t channel, std::uint32_t sequence) {
  const std::uint64_t now = log_time(run.time());
  sink_.message({channel, sequence, now, now, message_});
}

// Names are looked up once a table, not once a row.
std::vector<RowNames> TableLog::names_of(const Simulation& run, const Logged& logged) {
  std::vector<RowNames> result;
  for (std::size_t f = 0; f < logged.sources.size(); ++f) {
    const auto& [table, column] = logged.sources[f];
    const bool is_name = logged.table.fields[f].kind == Field::Kind::text;
    result.emplace_back(run, is_name ? table->columns()[column].reference : "");
  }
  return result;
}

void TableLog::put_fields(const Logged& logged, const std::vector<RowNames>& names, std::size_t row, CdrWriter& to) {
  for (std::size_t f = 0; f < logged.sources.size(); ++f) {
    const auto& [table, column] = logged.sources[f];
    const Cells& cells = table->now();
    const double value = cells.data[row * table->width() + column];
    if (logged.table.fields[f].kind == Field::Kind::real) {
      to.put(value);
    } else if (logged.table.fields[f].kind == Field::Kind::text) {
      to.text(names[f].at_view(value));
    } else {
      static const std::vector<std::uint8_t> nothing;
      const auto& bytes = value == 0 ? nothing : *cells.blobs[static_cast<std::size_t>(value) - 1];
      to.bytes(bytes.data(), bytes.size());
    }
  }
}

void TableLog::write_named(const Simulation& run, const TableView& view, Logged& logged) {
  const Table& table = *view.table;
  const Set& set = table.set();
  const Cells& cells = table.now();
  const bool have_channels = logged.table.layout == Layout::row && view.row < 0;
  const auto names = logged.is_plain ? std::vector<RowNames>{} : names_of(run, logged);
  const std::size_t first = view.row >= 0 ? static_cast<std::size_t>(view.row) : 0;
  const std::size_t last = view.row >= 0 ? first + 1 : cells.rows;
  for (std::size_t r = first; r < last; ++r) {
    if (set.is_named() && !set.alive[r]) continue;
    if (set.kind == SetKind::queue && cells.appended[r] != run.tick()) continue;  // each message once
    CdrWriter to(message_);
    if (logged.is_plain)
      to.reals(cells.data.data() + r * table.width(), table.width());
    else
      put_fields(logged, names, r, to);
    send(run, channel(view, logged, have_channels ? r : 0), logged.sequence);
  }
}

void TableLog::write_listed(const Simulation& run, const TableView& view, Logged& logged) {
  std::size_t rows = view.table->now().rows;
  for (const auto& source : logged.sources) rows = std::min(rows, source.table->now().rows);
  const auto names = names_of(run, logged);
  CdrWriter to(message_);
  to.count(rows);
  for (std::size_t r = 0; r < rows; ++r) put_fields(logged, names, r, to);
  send(run, channel(view, logged, 0), logged.sequence);
}

void TableLog::write(const Simulation& run) {
  for (Logged& logged : tables_) {
    const auto found = run.find_table(logged.declared.table);
    if (!found) continue;  // it went with a plugin
    const TableView view = *found;
    const Set& set = view.table->set();
    if (set.kind != SetKind::queue && run.tick() % logged.declared.every != 0) continue;
    // A swap may have made tables anew, with other columns.
    const bool is_known = logged.own == view.table && logged.names == names_of_listed(run, set) &&
                          logged.columns == view.table->columns().text();
    if (!is_known) declare(run, view, logged);
    if (logged.table.layout == Layout::rows)
      write_listed(run, view, logged);
    else
      write_named(run, view, logged);
    ++logged.sequence;
  }
}

}  // namespace muster::run_log
