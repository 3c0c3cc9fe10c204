#include "file_table.hpp"

#include <algorithm>
#include <cmath>
#include <muster/row_types.hpp>

#include "text/names.hpp"
#include "text/number.hpp"
#include "text/synonyms.hpp"
#include "text/table_doubts.hpp"
#include "text/text_table.hpp"

namespace muster {

namespace {

// `, which is a wall` of a name that a table gives for something else.
std::string of_other_set(const Blackboard& board, const Set& wanted, const std::string& name) {
  for (const auto& [set, rows] : board.sets()) {
    if (rows.get() != &wanted && set.find('/') == set.npos && rows->is_named() && rows->find(name) >= 0)
      return ", which is a " + set;
  }
  return "";
}

std::vector<double> row_numbers(const TextTable& table, std::size_t at, const Column& column, const Blackboard& board) {
  Set& set = *board.find_set(column.reference);
  const auto names = table.texts(at, {column.nullable, false});
  std::vector<double> of_level;
  for (std::size_t level = 0; level < names.levels.size(); ++level) {
    const std::string& name = names.levels[level];
    if (name.empty() && column.nullable) {
      of_level.push_back(null());
      continue;
    }
    if (column.joins) set.add(name);
    const int row = set.find(name);
    if (row < 0) {
      const auto first = std::find(names.level.begin(), names.level.end(), level) - names.level.begin();
      const auto r = static_cast<std::size_t>(first);
      throw invalid(table.place(r, at),
                    "no " + set.name + " is called " + quote(name) + of_other_set(board, set, name) + "; " +
                        (parse_integer(name) ? "rows hold names, and no numbers: " : "") + suggest(name, set.names) +
                        (r + 1 == table.rows() && is_summary(name)
                             ? "; a last row of sums or means? expected the table without it"
                             : ""));
    }
    of_level.push_back(row);
  }
  std::vector<double> result(names.level.size());
  for (std::size_t r = 0; r < result.size(); ++r) result[r] = of_level[names.level[r]];
  return result;
}

// What a table is that has these columns beside those that it should have; "" where it is nothing known.
std::string of_another_kind(const TextTable& table, const std::vector<std::string>& known) {
  const auto has = [&](const char* name) { return table.find(name).has_value(); };
  const auto takes = [&](const char* name) { return std::find(known.begin(), known.end(), name) != known.end(); };
  const bool is_of_places = takes("x") && takes("y");
  if (is_of_places && has("x0") && has("y0") && has("x1") && has("y1"))
    return "this is a roadmap, pieces from x0, y0 to x1, y1, and no list of places; expected x[m],y[m], as "
           "`muster roadmap --path` writes a way on it, or <control.navigate>, which takes the roadmap";
  if (is_of_places && has("x") && has("y") && !takes("t") && has("t")) {
    std::string all;
    for (const std::string& each : known) all += (all.empty() ? "" : ", ") + each;
    return "these places have no times, which follow from the speed; expected " + all +
           " without t (poses over time carry a robot by physics.replay)";
  }
  if (takes("x0") && takes("x1") && !has("x0") && (has("x") || has("from") || has("source")))
    return std::string(has("x") ? "these are places one after the other" : "these are pieces between numbers") +
           ", and a roadmap is pieces between places; expected x0[m],y0[m],x1[m],y1[m], as `muster roadmap` writes "
           "them";
  const bool is_of_globe = has("lat") || has("latitude") || has("Latitude") || has("Lat");
  if (is_of_places && is_of_globe)
    return "places are metres from an origin of your own, x east and y north: a degree of latitude is some 111200 m, "
           "one of longitude that times cos(latitude)";
  if (is_of_places && has("yaw") && !takes("yaw"))
    return "these places have no headings, which follow from the way; expected x, y without yaw (in a mission, <go_to "
           "at=\"x y\" heading=\"1.57\"/> turns the robot there)";
  if (is_of_places && has("z") && !takes("z") && known.size() == 2)
    return "these places are on the ground; expected x, y without z, or <control.path3d/>, by which a robot flies "
           "along "
           "x[m],y[m],z[m]";
  return "";
}

// True of a first column that counts its rows, from 0 or 1.
bool counts_rows(const TextTable& table, std::size_t column) {
  if (column != 0 || table.rows() < 2 || table.columns().size() < 2) return false;
  const auto first = parse_integer(table.text(0, 0));
  if (!first || (*first != 0 && *first != 1)) return false;
  for (std::size_t r = 1; r < table.rows(); ++r)
    if (parse_integer(table.text(r, 0)) != *first + static_cast<std::int64_t>(r)) return false;
  return true;
}

// Refuses columns that no plugin reads, so that none is ignored silently.
void refuse_others(const TextTable& table, const Columns& columns) {
  std::vector<std::string> known;
  std::vector<TextColumn> wanted;
  for (const auto& column : columns) {
    known.push_back(column.name);
    wanted.push_back({column.name, column.unit});
  }
  for (std::size_t c = 0; c < table.columns().size(); ++c) {
    const auto& name = table.columns()[c].name;
    if (columns.find(name) >= 0) continue;
    const std::string other = of_another_kind(table, known), meant = as_wanted(table.columns()[c].label(), wanted);
    if (!meant.empty() && !table.find(meant.substr(0, meant.find('['))))
      throw invalid(table.header_place(c),
                    "column " + quote(name) + " means nothing here; expected " + quoted_label(meant));
    if (other.empty() && synonym(name, known).empty() && counts_rows(table, c))
      throw invalid(table.header_place(c), "column " + quote(name) + " counts the rows, and means nothing here; " +
                                               "expected the table without it: cut -d, -f2- FILE takes it away");
    throw invalid(table.header_place(c),
                  "column " + quote(name) + " means nothing here; " + (other.empty() ? suggest(name, known) : other));
  }
}

}  // namespace

std::unique_ptr<Cells> read_file_table(const std::filesystem::path& path, const Columns& columns, bool closed,
                                       Blackboard& board, TableCache& tables) {
  const std::shared_ptr<const TextTable> read = tables.read(path);
  const TextTable& table = *read;
  if (closed) refuse_others(table, columns);
  auto cells = std::make_unique<Cells>();
  cells->rows = table.rows();
  cells->data.resize(cells->rows * columns.size());
  std::vector<TextColumn> needed;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (!columns[c].nullable) needed.push_back({columns[c].name, columns[c].unit});
  }
  table.require_most(needed);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const auto& column = columns[c];
    std::vector<double> values(cells->rows, null());
    if (!column.nullable || table.find(column.name)) {
      const auto at = table.require(column.name, column.unit);
      values = column.reference.empty() ? table.reals(at, {column.nullable, column.infinite})
                                        : row_numbers(table, at, column, board);
      if (column.reference.empty()) refuse_negative_length(table, at, values);
    }
    for (std::size_t r = 0; r < values.size(); ++r)
      cells->data[r * columns.size() + c] = std::isnan(values[r]) ? null() : values[r];
  }
  return cells;
}

std::vector<std::string> unread_columns(const std::filesystem::path& path, const Columns& columns, TableCache& tables) {
  const std::shared_ptr<const TextTable> table = tables.read(path);
  std::vector<std::string> absent, result;
  for (const auto& column : columns)
    if (column.nullable && !table->find(column.name)) absent.push_back(column.name);
  for (std::size_t c = 0; c < table->columns().size() && !absent.empty(); ++c) {
    const std::string& name = table->columns()[c].name;
    if (columns.find(name) >= 0) continue;
    std::string meant = synonym(name, absent);
    if (meant.empty() && name.size() > 2) meant = nearest(name, absent);
    const int number = meant.empty() ? -1 : columns.find(meant);
    if (number < 0) continue;
    const std::string& unit = columns[static_cast<std::size_t>(number)].unit;
    result.push_back(table->header_place(c).text() + ": column " + quote(name) + " is not read; is it " + meant +
                     "? expected the header " + quote(unit.empty() ? meant : meant + '[' + unit + ']'));
  }
  return result;
}

std::vector<std::string> doubtful_cells(const std::filesystem::path& path, const Columns& columns, const Cells& cells,
                                        TableCache& tables) {
  const std::shared_ptr<const TextTable> table = tables.read(path);
  std::vector<std::string> result;
  // Measured readings, whose rows make radios, are looked at where they are read as data.
  if (std::any_of(columns.begin(), columns.end(), [](const Column& column) { return column.joins; })) return result;
  std::vector<double> values(cells.rows);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const auto at = columns[c].reference.empty() ? table->find(columns[c].name) : std::nullopt;
    if (!at) continue;
    for (std::size_t r = 0; r < cells.rows; ++r) {
      const double value = cells.data[r * columns.size() + c];
      values[r] = is_null(value) ? std::nan("") : value;
    }
    for (std::string& doubt : column_doubts(*table, *at, values)) result.push_back(std::move(doubt));
  }
  return result;
}

}  // namespace muster
