#include "diagnosis/data/table_import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

#include "diagnosis/data/dataset.hpp"
#include "diagnosis/data/foreign_table.hpp"
#include "diagnosis/data/import_map.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/text_table_writer.hpp"

namespace muster::diagnosis {
namespace {

class Importer {
 public:
  Importer(const std::filesystem::path& file, const ImportMap& map) : map_(map), main_(ForeignTable::read(file)) {
    for (const auto& [name, side] : map.tables) sides_.emplace(name, ForeignTable::read(side.file));
    for (const ColumnRule& rule : map_.columns) check_rule(rule);
  }

  Imported write(const std::filesystem::path& out) {
    std::vector<TextColumn> columns;
    for (const ColumnRule& rule : map_.columns) columns.push_back(rule.column);
    TextTableWriter writer(out, columns);
    const std::vector<std::string> once = {""};
    for (std::size_t row = 0; row < main_.rows(); ++row) {
      for (const std::string& value : map_.variable.empty() ? once : map_.values) {
        for (const ColumnRule& rule : map_.columns) write_cell(writer, rule, row, value);
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
    if (line <= 1) return {error.exit(), Place{line == 1 ? map_.file : main_.file()}, words};
    const auto row = static_cast<std::size_t>(line) - 1;
    const std::string with = made_with(row), opening = "row " + std::to_string(row) + ": ";
    if (words.compare(0, opening.size(), opening) == 0) words.erase(0, opening.size());
    return {error.exit(), source_of(row), (with.empty() ? "" : with + ": ") + rows_as_lines(words)};
  }

  // Source of a row. Rows of the result count from 1, below its header.
  Place source_of(std::size_t row) const { return main_.place((row - 1) / rows_a_row()); }
  std::string made_with(std::size_t row) const {
    return map_.variable.empty() ? "" : "with " + map_.variable + " = " + map_.values[(row - 1) % rows_a_row()];
  }
  std::size_t rows_a_row() const { return map_.variable.empty() ? 1 : map_.values.size(); }

  std::string rows_as_lines(const std::string& words) const {
    static const std::regex row("row ([0-9]+)");
    std::string result;
    std::size_t from = 0;
    for (std::sregex_iterator at(words.begin(), words.end(), row), end; at != end; ++at) {
      const auto number = static_cast<std::size_t>(parse_integer(at->str(1)).value());
      const std::string with = made_with(number);
      result += words.substr(from, static_cast<std::size_t>(at->position()) - from) + "line " +
                std::to_string(source_of(number).line) + (with.empty() ? "" : ' ' + with);
      from = static_cast<std::size_t>(at->position() + at->length());
    }
    return result + words.substr(from);
  }

  // Checks a rule against the format's definition of its column.
  static void check_rule(const ColumnRule& rule) {
    const auto known = reading_columns().find(rule.column.name);
    if (known == reading_columns().end()) return;
    const auto& [name, unit] = *known;
    if (rule.column.unit != unit)
      throw invalid(rule.place, "column " + quote(rule.column.label()) + " has the wrong unit; expected " +
                                    quote(TextColumn{name, unit}.label()) + ", and SCALE*COLUMN where that differs");
    if (unit.empty() && !rule.is_name)
      throw invalid(rule.place, quote(name) + " is a column of names; expected " + name + " = " +
                                    (rule.number->column.empty() ? "\"NAME\"" : "name " + rule.number->column));
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

  void write_cell(TextTableWriter& writer, const ColumnRule& rule, std::size_t row, const std::string& value) {
    if (!rule.is_name) {
      const double number = number_of(rule, row, value);
      if (std::isnan(number))
        writer.empty();
      else
        writer.real(number);
      if (rule.column.name == "rssi" || rule.column.name == "path_loss") result_.empty += std::isnan(number);
    } else if (rule.name_column.empty()) {
      writer.text(filled(rule.name, map_.variable, value));
    } else {
      writer.text(main_.text(row, column_of(main_, filled(rule.name_column, map_.variable, value), rule.place)));
    }
  }

  double number_of(const ColumnRule& rule, std::size_t row, const std::string& value) {
    const NumberRule& number = *rule.number;
    if (number.column.empty()) return number.offset;
    const std::string column = filled(number.column, map_.variable, value);
    const ForeignTable& table = number.table.empty() ? main_ : sides_.at(number.table);
    const std::size_t in_row = number.table.empty() ? row : side_row(number.table, row, value, rule.place);
    const std::string advice = reading_columns().count(rule.column.name)
                                   ? ""
                                   : "; where these are names, expected " + rule.column.name + " = name " + column;
    const auto cell = table.number(in_row, column_of(table, column, rule.place), advice);
    if (!cell || is_none(rule.column.name, *cell)) return std::nan("");
    return number.scale * *cell + number.offset;
  }

  bool is_none(const std::string& column, double value) const {
    const auto found = map_.none.find(column);
    return found != map_.none.end() &&
           std::find(found->second.begin(), found->second.end(), value) != found->second.end();
  }

  // Row of the second table. The key is a text with {i}, or a column of the imported table in braces: {beacon}.
  std::size_t side_row(const std::string& name, std::size_t row, const std::string& value, const Place& place) {
    const SideTable& side = map_.tables.at(name);
    std::string key = filled(side.value, map_.variable, value);
    if (key.size() > 2 && key.front() == '{' && key.back() == '}')
      key = main_.text(row, column_of(main_, key.substr(1, key.size() - 2), place));
    const ForeignTable& table = sides_.at(name);
    auto [entry, is_new] = side_rows_.try_emplace({name, key}, table.rows());
    if (is_new) {
      const std::size_t column = column_of(table, side.key, place);
      for (std::size_t r = 0; r < table.rows() && entry->second == table.rows(); ++r) {
        if (table.text(r, column) == key) entry->second = r;
      }
    }
    if (entry->second == table.rows())
      throw invalid(place, table.file() + " has no row whose " + quote(side.key) + " is " + quote(key));
    return entry->second;
  }

  std::size_t column_of(const ForeignTable& table, const std::string& name, const Place& place) {
    used_[table.file()].insert(name);
    return table.require(name, place);
  }

  void say_assumptions() {
    for (const std::string& guess : main_.guesses()) result_.assumed.push_back(main_.file() + ": " + guess);
    for (const ColumnRule& rule : map_.columns) result_.assumed.push_back(rule.column.label() + " = " + in_words(rule));
    if (!map_.variable.empty())
      result_.assumed.push_back(fmt::format("each row of the file gives {} readings", map_.values.size()));
    std::string ignored;
    for (const std::string& column : main_.columns()) {
      if (!used_[main_.file()].count(column)) ignored += (ignored.empty() ? "" : ", ") + quote(column);
    }
    if (!ignored.empty()) result_.assumed.push_back("columns that are not used: " + ignored);
    result_.assumed.push_back(
        "frame: x east, y north, z up, in metres; headings in radians from x towards y, as the map's scales make them");
    result_.assumed.push_back("cells that are empty, nan, NA or null: nothing was received or known");
  }

  std::string in_words(const ColumnRule& rule) const {
    if (rule.is_name) return rule.name_column.empty() ? quote(rule.name) : "the names in " + quote(rule.name_column);
    const NumberRule& n = *rule.number;
    if (n.column.empty()) return fmt::format("{}", n.offset);
    std::string words =
        quote(n.column) + (n.table.empty() ? "" : " of " + map_.tables.at(n.table).file.filename().string());
    if (n.scale != 1) words = fmt::format("{} x {}", n.scale, words);
    if (n.offset != 0) words += fmt::format(" {} {}", n.offset < 0 ? '-' : '+', std::abs(n.offset));
    return words + (n.scale == 1 && !rule.column.unit.empty() ? ", taken to be in " + rule.column.unit : "");
  }

  const ImportMap& map_;
  ForeignTable main_;
  std::map<std::string, ForeignTable> sides_;
  std::map<std::pair<std::string, std::string>, std::size_t> side_rows_;
  std::map<std::string, std::set<std::string>> used_;
  Imported result_;
};

}  // namespace

Imported import_table(const std::filesystem::path& file, const std::filesystem::path& map,
                      const std::filesystem::path& out) {
  const ImportMap rules = read_import_map(map);
  return Importer(file, rules).write(out);
}

}  // namespace muster::diagnosis
