#include "diagnosis/replicates/recorded_table.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "text/names.hpp"
#include "text/number.hpp"
#include "text/table_doubts.hpp"

namespace muster::diagnosis {
namespace {

// The columns of the world's table that the file has; the others are not compared.
void find_columns(const TextTable& text, const Table& of_world, std::vector<std::size_t>& found,
                  RecordedTable& result) {
  std::vector<TextColumn> all;
  for (std::size_t c = 0; c < of_world.width(); ++c) {
    const Column& column = of_world.columns()[c];
    // As `run --record` names what would be called like the columns before it.
    const bool is_taken = column.name == "t" || column.name == of_world.set().name;
    all.push_back({(is_taken ? of_world.set().name + '_' : "") + column.name, column.unit});
    if (!text.find(all.back().name)) continue;
    found.push_back(text.require(all.back().name, column.unit));
    result.columns.push_back(all.back());
    result.cells.push_back(c);
  }
  if (!found.empty()) return;
  std::string expected;
  for (const TextColumn& column : all) expected += (expected.empty() ? "" : ",") + column.label();
  throw invalid(text.header_place(0), "has no column of " + of_world.name() + "; expected t[s]," + of_world.set().name +
                                          " and some of " + expected);
}

// A turn about the vertical in the place of the quaternion that the world's table has, as physics.replay reads it, too.
// Its values, where the file has them and no quaternion.
std::optional<std::vector<double>> yaw_of(const TextTable& text, const Table& of_world) {
  const auto has = [&](const char* name) {
    const auto& columns = of_world.columns();
    for (std::size_t c = 0; c < of_world.width(); ++c)
      if (columns[c].name == name) return true;
    return false;
  };
  if (has("yaw") || !has("qw") || text.find("qw") || !text.find("yaw")) return std::nullopt;
  return text.reals(text.require("yaw", "rad"), {.empty = true});
}

void turn_into_quaternions(const std::vector<double>& yaw, const Table& of_world, RecordedTable& result,
                           std::vector<std::vector<double>>& values) {
  for (std::size_t c = 0; c < of_world.width(); ++c) {
    const std::string& name = of_world.columns()[c].name;
    if (name.size() != 2 || name[0] != 'q') continue;
    std::vector<double> part(yaw.size(), 0);
    for (std::size_t r = 0; r < yaw.size(); ++r)
      part[r] = name == "qw" ? std::cos(yaw[r] / 2) : name == "qz" ? std::sin(yaw[r] / 2) : 0;
    result.columns.push_back({name, ""});
    result.cells.push_back(c);
    values.push_back(std::move(part));
  }
}

// Errors of places add up in the direction that the robot had: without it they tell nothing of each interval.
void require_heading(const TextTable& text, const RecordedTable& read) {
  const auto has = [&](const char* name) {
    return std::any_of(read.columns.begin(), read.columns.end(), [&](const TextColumn& c) { return c.name == name; });
  };
  if (!has("x") || !has("y") || has("yaw") || (has("qw") && has("qx") && has("qy") && has("qz"))) return;
  throw invalid(text.header_place(*text.find("x")),
                "has x and y without the heading, so that intervals cannot be told apart; expected yaw[rad], too");
}

}  // namespace

double RecordedTable::last() const {
  double result = 0;
  for (const RecordedCourse& course : courses) result = std::max(result, course.t.back());
  return result;
}

RecordedTable read_recorded(const std::filesystem::path& file, const Table& of_world) {
  const TextTable text = TextTable::read(file);
  const std::string& set = of_world.set().name;
  RecordedTable result{.file = text.file(), .columns = {}, .cells = {}, .courses = {}};
  std::vector<std::size_t> found;
  find_columns(text, of_world, found, result);
  const std::size_t time = text.require("t", "s"), row = text.require(set, "");
  const std::vector<double> t = text.reals(time);
  const Factor names = text.texts(row);
  std::vector<std::vector<std::size_t>> rows(names.levels.size());
  for (std::size_t r = 0; r < t.size(); ++r) {
    auto& own = rows[names.level[r]];
    if (of_world.set().find(names.levels[names.level[r]]) < 0)
      throw invalid(text.place(r, row), "no " + set + " of the world is called " + quote(names.levels[names.level[r]]) +
                                            "; " + suggest(names.levels[names.level[r]], of_world.set().names));
    if (t[r] < 0) throw invalid(text.place(r, time), "a time before the start of the run, which is 0 s");
    if (!own.empty() && !(t[r] > t[own.back()]))
      throw invalid(text.place(r, time), "time does not rise: " + print_real(t[r]) + " s after " +
                                             print_real(t[own.back()]) + " s of " +
                                             quote(names.levels[names.level[r]]));
    own.push_back(r);
  }
  std::vector<std::vector<double>> values;
  for (const std::size_t column : found) {
    values.push_back(text.reals(column, {.empty = true}));
    if (const std::string doubt = mark_doubt(text, column, values.back()); !doubt.empty())
      throw Error(Exit::invalid_input, doubt);
  }
  if (const auto yaw = yaw_of(text, of_world)) turn_into_quaternions(*yaw, of_world, result, values);
  require_heading(text, result);
  if (const auto yaw = text.find("yaw"); yaw && text.columns()[*yaw].unit == "rad") {
    result.yaw_at = text.header_place(*yaw);
    const std::vector<double> angle = text.reals(*yaw, {.empty = true});
    for (const auto& own : rows) {
      for (std::size_t i = 1; i < own.size(); ++i)
        if (const double turn = std::abs(angle[own[i]] - angle[own[i - 1]]); !std::isnan(turn)) result.turned += turn;
    }
  }
  for (std::size_t level = 0; level < rows.size(); ++level) {
    RecordedCourse course{names.levels[level], {}, {}};
    std::vector<std::size_t> own;  // rows that lack nothing
    for (const std::size_t r : rows[level])
      if (std::none_of(values.begin(), values.end(), [&](const auto& column) { return std::isnan(column[r]); }))
        own.push_back(r);
    if (own.size() < 2)
      throw invalid(
          text.place(rows[level].front(), row),
          quote(course.row) + " has " + (own.empty() ? "no sample" : "one sample") + "; expected two or more");
    course.values.resize(static_cast<Eigen::Index>(own.size()), static_cast<Eigen::Index>(values.size()));
    for (std::size_t i = 0; i < own.size(); ++i) {
      course.t.push_back(t[own[i]]);
      for (std::size_t c = 0; c < values.size(); ++c)
        course.values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = values[c][own[i]];
    }
    result.courses.push_back(std::move(course));
  }
  if (result.courses.empty()) throw invalid({text.file()}, "has no rows; expected samples of " + of_world.name());
  return result;
}

}  // namespace muster::diagnosis
