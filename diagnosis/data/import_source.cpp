#include "diagnosis/data/import_source.hpp"

#include <algorithm>

#include "text/names.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {

ImportSource::ImportSource(const std::vector<std::filesystem::path>& files, const ImportMap& map) : map_(map) {
  for (const auto& file : files) {
    parts_.push_back(map.file_name.parts_of(file.filename().string()));
    parts_.back()["file"] = file.stem().string();
    files_.push_back(ForeignTable::read(file, map.shape));
  }
  for (const auto& [name, side] : map.tables) sides_.emplace(name, ForeignTable::read(side.file));
}

std::string ImportSource::filled(std::string text, const SourceRow& at, const std::string& value) const {
  if (text.find('{') == text.npos) return text;
  text = diagnosis::filled(std::move(text), map_.variable, value);
  for (const auto& [name, part] : parts_[at.file]) text = diagnosis::filled(std::move(text), name, part);
  return text;
}

std::optional<std::string> ImportSource::part_in_braces(const std::string& text, const SourceRow& at) const {
  if (text.size() < 3 || text.front() != '{' || text.back() != '}') return std::nullopt;
  const auto found = parts_[at.file].find(text.substr(1, text.size() - 2));
  return found == parts_[at.file].end() ? std::nullopt : std::optional(found->second);
}

std::optional<double> ImportSource::number(const ColumnReference& from, const SourceRow& at, const std::string& value,
                                           const Place& rule, const std::string& advice) {
  if (from.table.empty()) {
    if (const auto part = part_in_braces(from.column, at)) {
      if (const auto number = parse_real(*part)) return number;
      throw invalid(rule, "the file " + quote(file(at).file()) + ": " + from.column + " is " + why_not_real(*part));
    }
  }
  const std::string column = filled(from.column, at, value);
  const ForeignTable& table = from.table.empty() ? file(at) : sides_.at(from.table);
  const std::size_t row = from.table.empty() ? at.row : side_row(from.table, at, value, rule);
  return table.number(row, column_of(table, column, rule), advice);
}

std::string_view ImportSource::text(const std::string& column, const SourceRow& at, const std::string& value,
                                    const Place& rule) {
  return file(at).text(at.row, column_of(file(at), filled(column, at, value), rule));
}

StampCell ImportSource::stamp(const std::string& words, const SourceRow& at, const Place& rule) {
  StampCell cell{"", place(at), at.file};
  const std::size_t blank = words.find(' ');
  const bool is_two = !file(at).has(words) && blank != words.npos;
  for (const std::string& column :
       is_two ? std::vector{words.substr(0, blank), words.substr(blank + 1)} : std::vector{words}) {
    const std::size_t c = column_of(file(at), column, rule);
    if (file(at).is_nothing(at.row, c)) return {"", cell.place, at.file};
    cell.text += (cell.text.empty() ? "" : " ") + std::string(file(at).text(at.row, c));
  }
  return cell;
}

// A column of the files whose cell there is one of these; "" if there is none.
std::string ImportSource::column_among(const SourceRow& at, const std::vector<std::string>& these) const {
  for (std::size_t c = 0; c < file(at).columns().size(); ++c)
    if (std::find(these.begin(), these.end(), file(at).text(at.row, c)) != these.end()) return file(at).columns()[c];
  return "";
}

// Row of the second table. The key is a text with {i}, or a column of the files in braces: {beacon}.
std::size_t ImportSource::side_row(const std::string& name, const SourceRow& at, const std::string& value,
                                   const Place& rule) {
  const SideTable& side = map_.tables.at(name);
  std::string key = filled(side.value, at, value);
  const bool is_of_column = key.size() > 2 && key.front() == '{' && key.back() == '}';
  if (is_of_column) key = file(at).text(at.row, column_of(file(at), key.substr(1, key.size() - 2), rule));
  const ForeignTable& table = sides_.at(name);
  auto [entry, is_new] = side_rows_.try_emplace({name, key}, table.rows());
  if (is_new) {
    const std::size_t column = column_of(table, side.key, rule);
    for (std::size_t r = 0; r < table.rows() && entry->second == table.rows(); ++r) {
      if (table.text(r, column) == key) entry->second = r;
    }
  }
  if (entry->second == table.rows()) {
    std::vector<std::string> keys;
    const std::size_t column = column_of(table, side.key, rule);
    for (std::size_t r = 0; r < table.rows(); ++r) keys.emplace_back(table.text(r, column));
    if (const std::string fitting = column_among(at, keys); is_of_column && !fitting.empty())
      throw invalid(side.place, side.key + ' ' + side.value + " is " + quote(key) + " in line " +
                                    std::to_string(place(at).line) + " of " + place(at).file + ", and " + table.file() +
                                    " has no such " + quote(side.key) + "; expected a column that has, such as {" +
                                    fitting + '}');
    throw invalid(rule, table.file() + " has no row whose " + quote(side.key) + " is " + quote(key) + ", as in line " +
                            std::to_string(place(at).line) + " of " + place(at).file + "; " + suggest(key, keys));
  }
  return entry->second;
}

std::size_t ImportSource::column_of(const ForeignTable& table, const std::string& name, const Place& rule) {
  const std::size_t column = table.require(name, rule);
  const bool is_of_files =
      std::any_of(files_.begin(), files_.end(), [&](const ForeignTable& f) { return &f == &table; });
  if (is_of_files) used_.insert(table.columns()[column]);
  return column;
}

std::vector<std::string> ImportSource::unused_columns() const {
  std::vector<std::string> result;
  for (const ForeignTable& table : files_) {
    for (const std::string& column : table.columns()) {
      if (!used_.count(column) && std::find(result.begin(), result.end(), column) == result.end())
        result.push_back(column);
    }
  }
  return result;
}

}  // namespace muster::diagnosis
