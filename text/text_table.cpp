#include "text_table.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <unordered_map>

#include "file_kind.hpp"
#include "foreign_lines.hpp"
#include "names.hpp"
#include "number.hpp"
#include "table_doubts.hpp"
#include "unit_words.hpp"

namespace muster {
namespace {

constexpr std::uint64_t most_of_a_table = std::uint64_t{8} << 30;
constexpr std::size_t most_row_bytes = std::numeric_limits<std::uint16_t>::max();

struct TextHash : std::hash<std::string_view> {
  using is_transparent = void;
};

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\t'; }
bool is_quoted(std::string_view raw) { return raw.starts_with('"'); }
bool has_outer_space(std::string_view text) {
  return !text.empty() && (text.front() == ' ' || text.front() == '\t' || text.back() == ' ' || text.back() == '\t');
}

}  // namespace

TextTable TextTable::read(const std::filesystem::path& path) {
  TextTable table;
  table.file_ = read_text_file(path, most_of_a_table);
  if (table.file_.text.empty())
    throw invalid({table.file()}, "is empty; expected a header such as t[s],tx,rx,rssi[dBm]");
  if (table.file_.text.starts_with("sep="))
    throw invalid(table.file_.place(0), "\"sep=\" is a spreadsheet's line, and no header: delete this line");
  if (const std::string kind = file_kind(std::string_view(table.file_.text).substr(0, 256)); !kind.empty())
    throw invalid(table.file_.place(0),
                  "begins as " + kind + " does; expected a table: a header of names, and ',' between cells" +
                      (kind.ends_with("QGroundControl")
                           ? ", such as x[m],y[m],z[m], in metres from an origin of your own (a degree of latitude is "
                             "some 111200 m, one of longitude that times cos(latitude))"
                           : ""));
  table.split();
  table.read_header();
  return table;
}

TextTable TextTable::with_column(std::size_t column, TextColumn label, std::vector<double> values) const {
  TextTable result = *this;
  result.columns_.at(column) = std::move(label);
  result.read_otherwise_[column] = std::move(values);
  return result;
}

TextTable TextTable::with_rows(const std::vector<std::size_t>& rows) const {
  TextTable result;
  result.file_.file = file_.file;
  std::string& text = result.file_.text;
  const auto add_line = [&](std::size_t line) {
    text.append(file_.text, row_starts_[line], row_starts_[line + 1] - row_starts_[line]);
    if (!text.ends_with('\n')) text += '\n';
  };
  add_line(0);
  for (const std::size_t row : rows) add_line(row + 1);
  result.split();
  result.columns_ = columns_;
  for (const auto& [column, values] : read_otherwise_) {
    std::vector<double>& kept = result.read_otherwise_[column];
    for (const std::size_t row : rows) kept.push_back(values[row]);
  }
  return result;
}

void TextTable::split() {
  const std::string& text = file_.text;
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  row_starts_.reserve(lines + 1);
  std::size_t at = 0;
  while (at < text.size()) {
    row_starts_.push_back(at);
    at = split_row(at);
    if (row_starts_.size() > 1) continue;
    width_ = cell_starts_.size();
    if (width_ == 1) refuse_foreign(text.substr(0, at), text.substr(at, text.find('\n', at) - at), file_.place(0));
    cell_starts_.reserve(std::min(lines * width_, text.size() + 1));  // a cell takes at least one byte
  }
  row_starts_.push_back(text.ends_with('\n') ? at : at + 1);  // as if the last line ended too
}

// Returns the start of the next line.
std::size_t TextTable::split_row(std::size_t start) {
  const std::string& text = file_.text;
  for (std::size_t cell = start, cells = 1;; ++cells) {
    if (cell - start > most_row_bytes) {
      throw invalid(file_.place(start),
                    "the row is too long; expected at most " + std::to_string(most_row_bytes) + " bytes");
    }
    if (width_ > 0 && cells > width_) fail_ragged(cells);
    cell_starts_.push_back(static_cast<std::uint16_t>(cell - start));
    const std::size_t end = cell_end(cell);
    if (end < text.size() && text[end] == ',') {
      cell = end + 1;
      continue;
    }
    if (width_ > 0 && cells < width_) fail_ragged(cells);
    return std::min(end + (end < text.size() && text[end] == '\r' ? 2 : 1), text.size());
  }
}

// The place of the ',', the line's end or the file's end that follows the cell.
std::size_t TextTable::cell_end(std::size_t cell) const {
  const std::string& text = file_.text;
  std::size_t at = cell;
  const bool in_quotes = at < text.size() && text[at] == '"';
  if (in_quotes) {
    for (++at; at < text.size() && !is_control(text[at]); ++at) {
      if (text[at] != '"') continue;
      if (at + 1 == text.size() || text[at + 1] != '"') break;
      ++at;
    }
    if (at == text.size() || text[at] != '"')
      throw invalid(file_.place(cell), "a quoted cell is not closed; expected '\"' in its line");
    ++at;
  } else {
    while (at < text.size() && text[at] != ',' && text[at] != '"' && !is_control(text[at])) ++at;
  }
  if (at == text.size() || text[at] == ',' || text[at] == '\n' || text.compare(at, 2, "\r\n") == 0) return at;
  if (text[at] == '\r') throw invalid(file_.place(at), "the line ends in CR alone; expected LF or CRLF");
  if (is_control(text[at]))
    throw invalid(file_.place(at), "the control character " + quote({&text[at], 1}) + " is not allowed" +
                                       (text[at] ? "" : ": the file is damaged, or no text; expected CSV in UTF-8"));
  throw invalid(file_.place(at),
                in_quotes ? quote({&text[at], 1}) + " after a quoted cell; expected ',' or the end of the line"
                          : "a quote inside a cell; expected the whole cell in quotes, its own quotes doubled");
}

void TextTable::fail_ragged(std::size_t found) const {
  const std::size_t start = row_starts_.back();
  const std::string& text = file_.text;
  if (text[start] == '\n' || text[start] == '\r')
    throw invalid(file_.place(start), text.find_first_not_of("\r\n", start) == text.npos
                                          ? "the file ends in an empty line; expected none below the last row"
                                          : "the line is empty; expected a row");
  if (const bool is_first = row_starts_.size() == 2 && (width_ == 1 || is_comment(text));
      is_comment(is_first ? text : text.substr(start)))
    throw invalid(file_.place(is_first ? 0 : start), "the line is a comment, and tables have none; expected " +
                                                         std::string(is_first ? "the header" : "a row") +
                                                         ": grep -v '^[#%]' FILE leaves comments out");
  const std::string first = text.substr(0, text.find_first_of("\r\n"));
  if (width_ == 1 && first.find(": ") != first.npos)
    throw invalid(file_.place(0), "the first line is " + quote(first) +
                                      ", as of a YAML file, and no header; expected a table: a header of names, and "
                                      "',' between cells");
  if (row_starts_.size() == 2 && width_ == 1)
    throw invalid(file_.place(0), "the first line is " + (first.empty() ? "empty" : quote(first)) +
                                      " and no header; expected one there, such as t[s],tx,rx,rssi[dBm]");
  const std::size_t end = std::min(text.find_first_of("\r\n", start), text.size());
  if (found == width_ + 1 && text[end - 1] == ',' &&
      static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(start),
                                          text.begin() + static_cast<std::ptrdiff_t>(end), ',')) == width_)
    throw invalid(file_.place(end - 1), "a comma stands at the end of the row, and makes an empty cell beyond the " +
                                            std::to_string(width_) + " of the header; expected none there");
  const std::string more = found > width_ ? " or more" : "";
  const bool is_sum = is_summary(text.substr(start, text.find_first_of(",\r\n", start) - start));
  throw invalid(file_.place(start), "the row has " + std::to_string(found) + more + (found == 1 ? " cell" : " cells") +
                                        "; expected " + std::to_string(width_) +
                                        ", with ',' between them and '.' in numbers" +
                                        (is_sum ? "; a last row of sums or means? expected the table without it" : ""));
}

void TextTable::read_header() {
  bool has_names = false;
  for (std::size_t column = 0; column < width_; ++column) has_names = has_names || !parse_real(raw(0, column));
  if (!has_names)
    throw invalid(header_place(0),
                  "the first line has numbers and no names; expected a header above it, such as "
                  "x[m],y[m]");
  std::unordered_map<std::string, std::size_t> seen;
  for (std::size_t column = 0; column < width_; ++column) {
    columns_.push_back(read_label(column));
    const auto [first, is_new] = seen.emplace(columns_.back().name, column);
    if (is_new) continue;
    throw invalid(header_place(column), "column " + quote(columns_.back().name) +
                                            " stands twice; the first is column " + std::to_string(first->second + 1) +
                                            " of the header; expected one of the two, or another name for it");
  }
}

namespace {

// Of "rssi [dBm]": `; did you mean "rssi[dBm]"?`.
std::string without_space_before_unit(const std::string& label) {
  const auto open = label.find(" [");
  if (open == label.npos || label.back() != ']') return "";
  std::string meant = label;
  meant.erase(open, 1);
  return meant.find(' ') == meant.npos ? "; did you mean " + quote(meant) + "?" : "";
}

}  // namespace

TextColumn TextTable::read_label(std::size_t column) const {
  const std::string label = cell_text(raw(0, column));
  const std::size_t open = label.find('[');
  TextColumn result{label.substr(0, open), ""};
  bool good = !result.name.empty() && !has_outer_space(label) && !has_outer_space(result.name) &&
              result.name.find(']') == label.npos;
  if (open != label.npos) {
    good = good && label.find_first_of("[]", open + 1) == label.size() - 1 && label.ends_with(']') &&
           open + 2 < label.size();
    result.unit = label.substr(open + 1, label.size() - std::min(label.size(), open + 2));
  }
  if (label.empty()) throw invalid(header_place(column), nameless(column));
  if (!good)
    throw invalid(header_place(column), quote(label) +
                                            " is not a column; expected name or name[unit], without spaces around it" +
                                            without_space_before_unit(label));
  return result;
}

// An empty name of a column: an index, a comma too much, or one at the end of the line as programs export it.
std::string TextTable::nameless(std::size_t column) const {
  if (column + 1 == width_ && width_ > 1)
    return "the header ends in a comma, so that a last column has no name; expected no comma there, nor at the end of "
           "the rows: sed 's/,\\r*$//' FILE takes them away";
  if (column == 0)
    return "the header begins with a comma, so that the first column has no name, as the index that pandas writes; "
           "expected to_csv(..., index=False): cut -d, -f2- FILE takes it away";
  bool is_rest = true;
  for (std::size_t c = column; c < width_; ++c) is_rest = is_rest && raw(0, c).empty();
  if (const std::string count = std::to_string(width_ - column); is_rest)
    return "the header ends in " + count + " commas, so that columns " + std::to_string(column + 1) + " to " +
           std::to_string(width_) + " have no name; expected none there, nor at the end of the rows: sed -E 's/,{" +
           count + "}\\r*$//' FILE takes them away";
  return "two commas stand side by side in the header, so that column " + std::to_string(column + 1) +
         " has no name; expected name or name[unit]";
}

// The header with the units that the first row holds, "t[s],tx,rx_x[m]", as MATLAB and LabVIEW write them; "" where
// that row is another.
std::string TextTable::header_with_units(std::size_t column, std::string_view unit) const {
  if (rows() == 0 || read_otherwise_.count(column) || text(0, column) != unit) return "";
  std::string header;
  for (std::size_t c = 0; c < width_; ++c) {
    const std::string below = text(0, c);
    if (parse_real(below) || !columns_[c].unit.empty()) return "";
    header += (c ? "," : "") + TextColumn{columns_[c].name, below == "-" ? "" : below}.label();
  }
  return header;
}

std::optional<std::size_t> TextTable::find(std::string_view name) const {
  const auto found =
      std::find_if(columns_.begin(), columns_.end(), [&](const TextColumn& c) { return c.name == name; });
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

std::size_t TextTable::require(std::string_view name, std::string_view unit) const {
  const TextColumn wanted{std::string(name), std::string(unit)};
  const std::optional<std::size_t> found = find(name);
  if (!found) {
    std::vector<std::string> names;
    for (const TextColumn& column : columns_) names.push_back(column.name);
    // Of a name of two letters every short one is a letter away.
    constexpr std::size_t telling = 3;
    std::string near = nearest(name, names);
    if (name.size() < telling || near.size() < telling) near.clear();
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const std::string meant = as_wanted(cell_text(raw(0, c)), {wanted});
      if (meant.empty()) continue;
      throw invalid(header_place(c), "column " + quote(cell_text(raw(0, c))) + " is called otherwise here; expected " +
                                         quoted_label(meant));
    }
    throw invalid(header_place(0), "no column " + quote(wanted.label()) + " in the table, which has " + listed(names) +
                                       (near.empty() ? "" : "; did you mean " + quote(near) + "?"));
  }
  if (columns_[*found].unit == unit) return *found;
  if (columns_[*found].unit.empty()) {
    const std::string header = header_with_units(*found, unit);
    throw invalid(header_place(*found),
                  "column " + quote(wanted.name) + " has no unit" +
                      (header.empty() ? "; expected " + quote(wanted.label())
                                      : ", and line 2 holds units; expected them in the header, " + header +
                                            ", and no line of units"));
  }
  throw invalid(header_place(*found), "column " + quote(columns_[*found].label()) + " has the wrong unit; expected " +
                                          quote(wanted.label()) + conversion(columns_[*found].unit, wanted.unit));
}

void TextTable::require_most(const std::vector<TextColumn>& needed) const {
  std::string header, missing;
  std::size_t count = 0;
  for (const TextColumn& column : needed) {
    header += (header.empty() ? "" : ",") + column.label();
    if (find(column.name)) continue;
    missing += (count++ ? ", " : "") + quote(column.label());
  }
  if (count < 2) return;
  std::vector<std::string> names;
  for (const TextColumn& column : columns_) names.push_back(column.name);
  throw invalid(header_place(0),
                "no columns " + missing + " in the table, which has " + listed(names) + "; expected " + header);
}

bool TextTable::is_numeric(std::size_t column) const {
  if (read_otherwise_.count(column)) return true;
  if (!columns_[column].unit.empty()) return true;
  for (std::size_t row = 0; row < rows(); ++row) {
    const std::string_view cell = raw(row + 1, column);
    if (!cell.empty()) return parse_real(cell).has_value();
  }
  return false;
}

std::vector<double> TextTable::reals(std::size_t column, Allow allow) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (const auto given = read_otherwise_.find(column); given != read_otherwise_.end()) return given->second;
  std::vector<double> values;
  values.reserve(rows());
  for (std::size_t row = 0; row < rows(); ++row) {
    const std::string_view cell = raw(row + 1, column);
    if (const std::optional<double> value = parse_real(cell)) {
      values.push_back(*value);
    } else if (cell.empty() && allow.empty) {
      values.push_back(std::numeric_limits<double>::quiet_NaN());
    } else if (allow.infinite && (cell == "inf" || cell == "-inf")) {
      values.push_back(cell == "inf" ? infinity : -infinity);
    } else if (row == 0 && !cell.empty() && cell == columns_[column].unit) {
      throw invalid(place(row, 0), "the line holds units, which the header has; expected rows of numbers below it");
    } else if (cell_text(cell) == columns_[column].label()) {
      throw invalid(place(row, 0), "the line repeats the header, as in two tables joined; expected one header");
    } else {
      const bool is_sum = row + 1 == rows() && (is_summary(cell_text(cell)) || is_summary(text(row, 0)));
      fail_cell(row, column,
                why_not_number(cell, allow) + other_unit_hint(columns_[column].unit, cell) +
                    (is_sum ? "; a last row of sums or means? expected the table without it" : ""));
    }
  }
  return values;
}

Factor TextTable::texts(std::size_t column, Allow allow) const {
  Factor factor;
  factor.level.reserve(rows());
  std::unordered_map<std::string, std::uint32_t, TextHash, std::equal_to<>> known;
  for (std::size_t row = 0; row < rows(); ++row) {
    std::string_view cell = raw(row + 1, column);
    std::string unquoted;
    if (cell.empty() && !allow.empty) fail_cell(row, column, "the cell is empty; expected a name");
    if (has_outer_space(cell))
      fail_cell(row, column, quote(cell) + " has spaces around it; expected none, or the cell in quotes");
    if (is_quoted(cell)) cell = unquoted = cell_text(cell);
    auto found = known.find(cell);
    if (found == known.end()) {
      found = known.emplace(cell, static_cast<std::uint32_t>(factor.levels.size())).first;
      factor.levels.emplace_back(cell);
    }
    factor.level.push_back(found->second);
  }
  return factor;
}

std::string_view TextTable::raw(std::size_t line, std::size_t column) const {
  const std::uint16_t* starts = &cell_starts_[line * width_];
  const std::size_t begin = row_starts_[line] + starts[column];
  std::size_t end = column + 1 < width_ ? row_starts_[line] + starts[column + 1] : row_starts_[line + 1];
  --end;  // the ',' or '\n'
  if (end > begin && file_.text[end - 1] == '\r') --end;
  return std::string_view(file_.text).substr(begin, end - begin);
}

// Every row is one line, so the cost is the same everywhere in the file.
Place TextTable::raw_place(std::size_t line, std::size_t column) const {
  const std::size_t begin = row_starts_[line];
  const std::string_view before = std::string_view(file_.text).substr(begin, cell_starts_[line * width_ + column]);
  const auto characters = std::count_if(before.begin(), before.end(), [](char c) { return (c & 0xC0) != 0x80; });
  return {file(), static_cast<int>(line) + 1, static_cast<int>(characters) + 1};
}

void TextTable::fail_cell(std::size_t row, std::size_t column, const std::string& what) const {
  throw invalid(place(row, column), "column " + quote(columns_[column].label()) + ": " + what);
}

std::string TextTable::why_not_number(std::string_view raw, Allow allow) {
  if (raw.empty()) return "the cell is empty; expected a number";
  const std::string text = cell_text(raw);
  if (parse_real(text)) return quote(text) + " is in quotes, so it is a name; expected a number";
  if (allow.empty && stands_for_nothing(text))
    return quote(text) + " is not a number; expected an empty cell where there is no value (muster import makes it so)";
  if (stands_for_nothing(text)) return quote(text) + " is not a number; expected one, or the table without this row";
  return why_not_real(text);
}

std::string TextTable::cell_text(std::string_view raw) {
  if (!is_quoted(raw)) return std::string(raw);
  std::string text;
  for (std::size_t i = 1; i + 1 < raw.size(); ++i) {
    text += raw[i];
    if (raw[i] == '"') ++i;  // the second of a pair
  }
  return text;
}

}  // namespace muster
