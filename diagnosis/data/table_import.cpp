#include "diagnosis/data/table_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <regex>
#include <set>

#include "diagnosis/data/dataset.hpp"
#include "diagnosis/data/import_source.hpp"
#include "diagnosis/data/rule_checks.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/text_table_writer.hpp"

namespace muster::diagnosis {
namespace {

// Units that names of columns end in, and how a map makes them ours.
struct NamedUnit {
  std::string_view name, unit, rule;
};
constexpr NamedUnit named_units[] = {
    {"cm", "m", "0.01*"},
    {"mm", "m", "0.001*"},
    {"km", "m", "1000*"},
    {"dm", "m", "0.1*"},
    {"ft", "m", "0.3048*"},
    {"feet", "m", "0.3048*"},
    {"ms", "s", "0.001*"},
    {"us", "s", "1e-6*"},
    {"ns", "s", "1e-9*"},
    {"min", "s", "60*"},
    {"mw", "dBm", "10*log10"},
    {"deg", "rad", "0.017453292519943295*"},
    {"degrees", "rad", "0.017453292519943295*"},
};

// Of a column taken as it is whose name ends in another unit: "x_cm", "x (mm)"; "" where it does not.
std::string doubt_of_unit(const ColumnRule& rule) {
  const std::string& column = rule.number->from.column;
  std::string last;
  for (const char c : column) {
    if (std::isalpha(static_cast<unsigned char>(c)))
      last += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (c == '_' || c == ' ' || c == '(' || c == '[' || c == '.')
      last.clear();
  }
  if (last.size() == column.size()) return "";  // a whole name, such as "min"
  for (const auto& [name, unit, begins] : named_units) {
    if (last != name || rule.column.unit != unit) continue;
    const std::string of = (rule.number->from.table.empty() ? "" : rule.number->from.table + '.') + column;
    const bool is_function = begins.back() != '*';
    return fmt::format("; is it in {}? expected {} = {}{}{}{} in line {} of the map", name == "mw" ? "mW" : name,
                       rule.column.label(), begins, is_function ? "(" : "", of, is_function ? ")" : "",
                       rule.place.line);
  }
  return "";
}

class Importer {
 public:
  Importer(const std::vector<std::filesystem::path>& files, const ImportMap& map) : map_(map), source_(files, map) {
    for (const ColumnRule& rule : map_.columns) check_rule(rule);
    for (std::size_t f = 0; f < source_.files().size(); ++f) {
      for (std::size_t row = 0; row < source_.files()[f].rows(); ++row) rows_.push_back({f, row});
    }
    for (const ColumnRule& rule : map_.columns) refuse_quoted_column(rule, source_.files());
    find_origin();
    leave_out_rows_without_place();
    read_times();
    if (files.size() > 1) order_by_time();
  }

  Imported write(const std::filesystem::path& out) {
    std::vector<TextColumn> columns;
    for (const ColumnRule& rule : map_.columns) columns.push_back(rule.column);
    TextTableWriter writer(out, columns);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      for (const std::string& value : values()) {
        for (const ColumnRule& rule : map_.columns) write_cell(writer, rule, k, value);
        writer.end_row();
        ++result_.rows;
      }
    }
    check_all_there();
    say_assumptions();
    writer.close([&](const std::filesystem::path& written) { check(written); });
    return std::move(result_);
  }

 private:
  // Runs the checks of a fit.
  void check(const std::filesystem::path& written) {
    try {
      const Dataset data = read_dataset(written);
      result_.assumed.insert(result_.assumed.end(), data.notes.begin(), data.notes.end());
    } catch (const Error& error) {
      throw in_source(error, written);
    }
  }

  // Rewrites an error about the written table in terms of its sources, which the user has.
  Error in_source(const Error& error, const std::filesystem::path& written) const {
    const int line = error.place().file == written.string() ? error.place().line : 0;
    std::string words = error.message();
    if (line <= 1) return {error.exit(), Place{line == 1 ? map_.file : source_.files()[0].file()}, words};
    const auto row = static_cast<std::size_t>(line) - 1;
    const std::string with = made_with(row), opening = "row " + std::to_string(row) + ": ";
    if (words.compare(0, opening.size(), opening) == 0) words.erase(0, opening.size());
    return {error.exit(), source_of(row), (with.empty() ? "" : with + ": ") + rows_as_lines(words)};
  }

  // Source of a row. Rows of the result count from 1, below its header.
  Place source_of(std::size_t row) const { return source_.place(rows_[(row - 1) / rows_a_row()]); }
  std::string made_with(std::size_t row) const {
    return map_.variable.empty() ? "" : "with " + map_.variable + " = " + map_.values[(row - 1) % rows_a_row()];
  }
  const std::vector<std::string>& values() const {
    static const std::vector<std::string> once = {""};
    return map_.variable.empty() ? once : map_.values;
  }
  std::size_t rows_a_row() const { return values().size(); }

  std::string rows_as_lines(const std::string& words) const {
    static const std::regex row("row ([0-9]+)");
    std::string result;
    std::size_t from = 0;
    for (std::sregex_iterator at(words.begin(), words.end(), row), end; at != end; ++at) {
      const auto number = static_cast<std::size_t>(parse_integer(at->str(1)).value());
      const std::string with = made_with(number);
      const Place place = source_of(number);
      result += words.substr(from, static_cast<std::size_t>(at->position()) - from) + "line " +
                std::to_string(place.line) + (source_.files().size() > 1 ? " of " + place.file : "") +
                (with.empty() ? "" : ' ' + with);
      from = static_cast<std::size_t>(at->position() + at->length());
    }
    return result + words.substr(from);
  }

  // Checks a rule against the format's definition of its column.
  void check_rule(const ColumnRule& rule) const {
    refuse_exchanged(rule, source_.files());
    const auto known = reading_columns().find(rule.column.name);
    const auto made_in = [&](const std::string& unit, const std::string& what) {
      if (rule.column.unit != unit)
        throw invalid(rule.place, quote(rule.column.label()) + " is made of " + what + "; expected " +
                                      quote(TextColumn{rule.column.name, unit}.label()));
    };
    if (rule.time) made_in("s", "times, in seconds");
    if (rule.globe) made_in("m", "a place on the globe, in metres");
    if (known == reading_columns().end()) return;
    if (rule.column.name == "t" && rule.column.unit.empty() && rule.number)
      return;  // a row number, or refused when read
    const auto& [name, unit] = *known;
    if (rule.column.unit != unit)
      throw invalid(rule.place,
                    "column " + quote(rule.column.label()) +
                        (rule.column.unit.empty() ? " has no unit; expected " : " has the wrong unit; expected ") +
                        quote(TextColumn{name, unit}.label()) + in_our_unit(rule, unit));
    if (unit.empty() && !rule.is_name) {
      const std::string from = rule.number ? rule.number->from.column : "",
                        begin = quote(name) + " is a column of names";
      const bool is_there =
          from.empty() || (rule.number && !rule.number->from.table.empty()) || from.find('{') != from.npos ||
          std::any_of(source_.files().begin(), source_.files().end(), [&](const auto& t) { return t.has(from); });
      if (!is_there)
        throw invalid(rule.place, begin + ", and " + source_.files()[0].file() + " has no column " + from +
                                      "; expected " + name + " = " + quote(from) + ", the same name in all rows");
      throw invalid(rule.place, begin + "; expected " + name + " = " + (from.empty() ? "\"NAME\"" : "name " + from));
    }
  }

  void check_all_there() const {
    std::vector<std::string> others;
    std::set<std::string> made;
    for (const ColumnRule& rule : map_.columns) {
      made.insert(rule.column.name);
      if (!reading_columns().count(rule.column.name)) others.push_back(rule.column.name);
    }
    std::vector<std::string> needed = {"tx", "rx", made.count("path_loss") ? "path_loss" : "rssi"};
    if (!made.count("distance") || made.count("tx_x") || made.count("rx_x"))
      needed.insert(needed.end(), {"tx_x", "tx_y", "rx_x", "rx_y"});
    for (const std::string& name : needed) {
      if (made.count(name)) continue;
      const std::string label = TextColumn{name, reading_columns().at(name)}.label(), near = nearest(name, others);
      throw invalid({map_.file}, "no rule makes the column " + quote(label) + "; expected " + label +
                                     (reading_columns().at(name).empty() ? " = name COLUMN" : " = COLUMN") +
                                     (near.empty() ? "" : "; is it " + quote(near) + "?"));
    }
  }

  void write_cell(TextTableWriter& writer, const ColumnRule& rule, std::size_t k, const std::string& value) {
    if (rule.is_name) {
      if (rule.name_column.empty())
        writer.text(source_.filled(rule.name, rows_[k], value));
      else
        writer.text(source_.text(rule.name_column, rows_[k], value, rule.place));
      return;
    }
    const auto number = rule.time    ? times_.at(&rule)[k]
                        : rule.globe ? metres_of(rule, k, value)
                                     : number_of(rule, rows_[k], value);
    if (std::isnan(number))
      writer.empty();
    else
      writer.real(number);
    if (rule.column.name == "rssi" || rule.column.name == "path_loss") result_.empty += std::isnan(number);
  }

  double number_of(const ColumnRule& rule, const SourceRow& at, const std::string& value) {
    const NumberRule& number = *rule.number;
    if (number.from.column.empty()) return number.offset;
    std::string advice;
    if (rule.column.name == "t")
      advice = "; where these are dates or clock times, expected t[s] = time " + number.from.column;
    else if (!reading_columns().count(rule.column.name))
      advice = "; where these are names, expected " + rule.column.name + " = name " + number.from.column;
    const auto cell = source_.number(number.from, at, value, rule.place, advice);
    if (!cell || is_none(rule.column.name, *cell)) return std::nan("");
    if (number.logarithm && *cell <= 0)
      throw invalid(source_.place(at),
                    "column " + quote(source_.filled(number.from.column, at, value)) + ": " + print_real(*cell) +
                        " has no logarithm; expected a power above 0 (none " + rule.column.name + " = " +
                        print_real(*cell) + " in the map makes such cells empty)" +
                        (*cell < 0 && *cell > -200 && rule.column.unit == "dBm"
                             ? "; is it dBm already? then " + rule.column.label() + " = " + number.from.column
                             : ""));
    return number.scale * (number.logarithm ? std::log10(*cell) : *cell) + number.offset;
  }

  bool is_none(const std::string& column, double value) {
    const auto found = map_.none.find(column);
    const bool is_it =
        found != map_.none.end() && std::find(found->second.begin(), found->second.end(), value) != found->second.end();
    if (is_it) met_.emplace(column, value);
    return is_it;
  }

  // Nothing for a receiver of satellites without a fix: empty, or zero and zero.
  std::optional<GeodeticPoint> point_of(const ColumnRule& rule, const SourceRow& at, const std::string& value) {
    const GlobeRule& globe = *rule.globe;
    const auto latitude = source_.number(globe.latitude, at, value, rule.place),
               longitude = source_.number(globe.longitude, at, value, rule.place);
    if (!latitude || !longitude || (*latitude == 0 && *longitude == 0)) return std::nullopt;
    const auto altitude = globe.altitude ? source_.number(*globe.altitude, at, value, rule.place) : std::nullopt;
    if (globe.axis == 2 && !altitude) return std::nullopt;
    GeodeticPoint point{*latitude, *longitude, altitude.value_or(plane_ ? plane_->origin().altitude : 0)};
    if (const std::string why = why_no_point(point); !why.empty()) throw invalid(source_.place(at), why);
    return point;
  }

  double metres_of(const ColumnRule& rule, std::size_t k, const std::string& value) {
    const auto point = point_of(rule, rows_[k], value);
    return point ? plane_->east_north_up(*point)[rule.globe->axis] : std::nan("");
  }

  // The origin that the map states, or the first point of the first rule, at the altitude of the first rule that has
  // one.
  void find_origin() {
    if (map_.origin) plane_.emplace(*map_.origin);
    for (const bool needs_altitude : {true, false}) {
      for (const ColumnRule& rule : map_.columns) {
        if (!rule.globe || (needs_altitude && !rule.globe->altitude)) continue;
        for (std::size_t k = 0; k < rows_.size() && !plane_; ++k) {
          if (const auto point = point_of(rule, rows_[k], values()[0])) plane_.emplace(*point);
        }
      }
    }
    const bool is_used = std::any_of(map_.columns.begin(), map_.columns.end(), [](const auto& r) { return r.globe; });
    if (!is_used) return;
    if (!plane_) throw invalid({map_.file}, "no row has a latitude and a longitude; expected some");
    const GeodeticPoint& o = plane_->origin();
    places_.push_back(
        fmt::format("places are metres east, north and up of latitude {}, longitude {}, altitude {} m (WGS 84){}",
                    o.latitude, o.longitude, o.altitude, map_.origin ? "" : ", the first point"));
  }

  void leave_out_rows_without_place() {
    std::size_t left_out = 0;
    std::optional<Place> first;
    std::vector<SourceRow> kept;
    for (const SourceRow& at : rows_) {
      const bool has_place = std::all_of(map_.columns.begin(), map_.columns.end(), [&](const ColumnRule& rule) {
        return !rule.globe || std::all_of(values().begin(), values().end(), [&](const std::string& value) {
          return point_of(rule, at, value).has_value();
        });
      });
      if (has_place) {
        kept.push_back(at);
        continue;
      }
      ++left_out;
      if (!first) first = source_.place(at);
    }
    rows_ = std::move(kept);
    if (first)
      places_.push_back(fmt::format("rows without a place (empty, or latitude and longitude 0), left out: {}, first {}",
                                    left_out, first->text()));
  }

  void read_times() {
    for (const ColumnRule& rule : map_.columns) {
      if (!rule.time) continue;
      std::vector<StampCell> cells;
      for (const SourceRow& at : rows_) cells.push_back(source_.stamp(rule.time->words, at, rule.place));
      std::vector<std::string> assumed;
      times_[&rule] = seconds_of(cells, rule.time->since, assumed);
      for (const std::string& words : assumed) result_.assumed.push_back(rule.column.label() + ": " + words);
    }
  }

  // Sorts rows of several files. Rows of one file keep their order if the map makes no t.
  void order_by_time() {
    const auto rule = std::find_if(map_.columns.begin(), map_.columns.end(),
                                   [](const ColumnRule& r) { return r.column.name == "t" && !r.is_name; });
    if (rule == map_.columns.end()) return;
    std::vector<double> t;
    if (rule->time)
      t = times_.at(&*rule);
    else if (rule->number) {
      for (const SourceRow& at : rows_) t.push_back(number_of(*rule, at, values()[0]));
    }
    for (double& v : t) v = std::isnan(v) ? -1e300 : v;  // refused when read
    std::vector<std::size_t> order(rows_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return t[a] < t[b]; });
    const auto sorted = [&](auto& values) {
      auto result = values;
      for (std::size_t k = 0; k < order.size(); ++k) result[k] = values[order[k]];
      values = std::move(result);
    };
    sorted(rows_);
    for (auto& [of, seconds] : times_) sorted(seconds);
    result_.assumed.push_back("rows of all files are in the order of t");
  }

  void say_assumptions() {
    for (const auto& [column, values] : map_.none)
      for (const double value : values)
        if (!met_.count({column, value}))
          result_.assumed.push_back(fmt::format("none {} = {}: no cell has it", column, value));
    for (const ForeignTable& table : source_.files()) {
      for (const std::string& guess : table.guesses()) result_.assumed.push_back(table.file() + ": " + guess);
    }
    for (const ColumnRule& rule : map_.columns) result_.assumed.push_back(rule.column.label() + " = " + in_words(rule));
    result_.assumed.insert(result_.assumed.end(), places_.begin(), places_.end());
    if (!map_.variable.empty())
      result_.assumed.push_back(fmt::format("each row of the file gives {} readings", map_.values.size()));
    std::string ignored;
    for (const std::string& column : source_.unused_columns()) ignored += (ignored.empty() ? "" : ", ") + quote(column);
    if (!ignored.empty()) result_.assumed.push_back("columns that are not used: " + ignored);
    result_.assumed.push_back(
        "frame: x east, y north, z up, in metres; headings in radians from x towards y, as the map's scales make them");
    result_.assumed.push_back("cells that are empty, nan, NA, n/a, null or none: nothing was received or known");
  }

  std::string in_words(const ColumnRule& rule) const {
    if (rule.is_name) return rule.name_column.empty() ? quote(rule.name) : "the names in " + quote(rule.name_column);
    if (!rule.number) return rule.text;
    const NumberRule& n = *rule.number;
    if (n.from.column.empty()) return fmt::format("{}", n.offset);
    std::string words = quote(n.from.column);
    if (!n.from.table.empty()) words += " of " + map_.tables.at(n.from.table).file.filename().string();
    if (n.logarithm) words = "log10 of " + words;
    if (n.scale != 1) words = fmt::format("{} x {}", n.scale, words);
    if (n.offset != 0) words += fmt::format(" {} {}", n.offset < 0 ? '-' : '+', std::abs(n.offset));
    const bool plain = n.scale == 1 && !n.logarithm && !rule.column.unit.empty();
    return words + (plain ? ", taken to be in " + rule.column.unit + doubt_of_unit(rule) : "");
  }

  const ImportMap& map_;
  ImportSource source_;
  std::vector<SourceRow> rows_;                             // in the order of the result
  std::map<const ColumnRule*, std::vector<double>> times_;  // by rule, of rows_
  std::optional<TangentPlane> plane_;
  std::set<std::pair<std::string, double>> met_;  // values of "none" that a cell has, by column
  std::vector<std::string> places_;               // assumptions
  Imported result_;
};

}  // namespace

Imported import_table(const std::vector<std::filesystem::path>& files, const std::filesystem::path& map,
                      const std::filesystem::path& out) {
  const ImportMap rules = read_import_map(map);
  return Importer(files, rules).write(out);
}

}  // namespace muster::diagnosis
