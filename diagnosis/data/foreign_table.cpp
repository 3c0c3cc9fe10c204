#include "diagnosis/data/foreign_table.hpp"

#include <algorithm>
#include <cctype>

#include "text/file_kind.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/table_doubts.hpp"
#include "text/text_file.hpp"

namespace muster::diagnosis {
namespace {

constexpr std::uint64_t most_bytes = 2'000'000'000;
constexpr const char* blanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(blanks), last = text.find_last_not_of(blanks);
  return first == text.npos ? std::string_view() : text.substr(first, last - first + 1);
}

// The number of a column that is called column3; 0 if it is called otherwise.
std::size_t number_in(const std::string& column) {
  const auto number = column.rfind("column", 0) == 0 ? parse_integer(column.substr(6)) : std::nullopt;
  return number && *number > 0 ? static_cast<std::size_t>(*number) : 0;
}

// Throws Error: neither the result nor a message could hold it.
void refuse_control_characters(std::string_view line, const Place& place) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\t'; };
  const std::string_view text = line.substr(0, line.find_last_not_of('\r') + 1);
  const auto found = std::find_if(text.begin(), text.end(), is_control);
  if (found == text.end()) return;
  throw invalid({place.file, place.line, static_cast<int>(found - text.begin()) + 1},
                "the control character " + quote({&*found, 1}) + " is not allowed");
}

// For a rule that is meant as a number or a formula, and is read as the name of a column.
std::string why_no_column(const std::string& rule) {
  if (rule.find_first_of("/()*") != rule.npos)
    return ", and it is no rule; expected SCALE*COLUMN + OFFSET, such as 0.001*ms + 0.5";
  if (rule.size() > 1 && rule[0] == '-') return ", and it is no rule; expected -1*" + rule.substr(1);
  if (rule.empty() || rule.find_first_of("0123456789") > 1) return "";
  std::string point = rule;
  std::replace(point.begin(), point.end(), ',', '.');
  if (parse_real(point)) return ", and it is no number: a decimal point is written '.'";
  if (parse_real(rule.substr(0, rule.find(' '))))
    return ", and it is no number: units stand in the column's own name alone, as in tx_x[m]";
  return "";
}

// What is wrong with a rule that divides a column by a number, and how it is written here; "" of any other.
std::string division(const std::string& rule, const std::vector<std::string>& columns) {
  const std::size_t slash = rule.find('/');
  if (slash == rule.npos || std::find(columns.begin(), columns.end(), rule) != columns.end()) return "";
  const std::string column(trimmed(rule.substr(0, slash))), by(trimmed(rule.substr(slash + 1)));
  const auto divisor = parse_real(by);
  if (!divisor || *divisor == 0 || std::find(columns.begin(), columns.end(), column) == columns.end()) return "";
  return quote(rule) + ": a rule has no division; expected " + print_real(1 / *divisor) + "*" + column +
         " (SCALE*COLUMN + OFFSET)";
}

// What is wrong with a rule that calls a function of a column, as deg2rad(heading), and how it is written here; "" of
// any other.
std::string function_call(const std::string& rule, const std::vector<std::string>& columns) {
  struct Known {
    std::string_view name, words;
    double factor;
  };
  static constexpr double degree = 0.017453292519943295;
  static constexpr Known known[] = {
      {"deg2rad", "degrees in rad", degree},      {"radians", "degrees in rad", degree},
      {"toRadians", "degrees in rad", degree},    {"to_radians", "degrees in rad", degree},
      {"rad2deg", "rad in degrees", 1 / degree},  {"degrees", "rad in degrees", 1 / degree},
      {"toDegrees", "rad in degrees", 1 / degree}};
  const std::size_t open = rule.find('(');
  if (open == rule.npos || open == 0 || rule.back() != ')') return "";
  std::string name(trimmed(rule.substr(0, open)));
  const std::string column(trimmed(rule.substr(open + 1, rule.size() - open - 2)));
  name = name.substr(name.rfind('.') == name.npos ? 0 : name.rfind('.') + 1);  // np.deg2rad, math.radians
  const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  if (!std::all_of(name.begin(), name.end(), is_letter)) return "";
  const std::string what = "there is no function " + name;
  for (const Known& one : known)
    if (name == one.name)
      return what + "; expected " + print_real(one.factor) + "*" + column + ", which makes " + std::string(one.words);
  return what + ", only log10; expected SCALE*COLUMN + OFFSET or SCALE*log10(COLUMN) + OFFSET, such as 0.001*" +
         (std::find(columns.begin(), columns.end(), column) == columns.end() ? columns.front() : column);
}

std::string name_of(char separator) {
  if (separator == ' ') return "blanks";
  return separator == '\t' ? "tabs" : std::string("'") + separator + "'";
}

}  // namespace

ForeignTable ForeignTable::read(const std::filesystem::path& path, const TableShape& shape) {
  TextFile source = read_text_file(path, most_bytes);
  if (const std::string kind = file_kind(std::string_view(source.text).substr(0, 256));
      !kind.empty() && shape.header_line == 0)
    throw invalid({source.file, 1, 1}, "begins as " + kind + " does; expected a table with a header of names");
  ForeignTable table;
  table.file_ = source.file;
  table.shape_ = shape;
  table.source_ = std::make_shared<const std::string>(std::move(source.text));
  table.unquoted_ = std::make_shared<std::deque<std::string>>();
  const std::vector<Line> lines = table.lines_of_table();
  if (lines.empty() && shape.header_line > 0)
    throw invalid({table.file_}, "has no line " + std::to_string(shape.header_line) +
                                     ", where the map has its header (header = line " +
                                     std::to_string(shape.header_line) + "); it has " +
                                     std::to_string(std::count(table.source_->begin(), table.source_->end(), '\n')) +
                                     " lines");
  if (lines.empty()) throw invalid({table.file_}, shape.has_header ? "is empty; expected a header" : "has no rows");
  for (std::size_t k = table.take_header(lines); k < lines.size(); ++k) table.add_row(lines[k]);
  if (table.cells_.empty()) throw invalid({table.file_}, "has no rows below its header");
  return table;
}

// Without blank lines, comments, what precedes a header whose line is given, and what follows the end.
std::vector<ForeignTable::Line> ForeignTable::lines_of_table() {
  std::vector<Line> lines;
  std::size_t comments = 0;
  const std::string_view text = *source_;
  int number = 1;
  for (std::size_t at = 0; at < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const Line line{text.substr(at, end - at), number};
    at = end + 1;
    if (number < shape_.header_line || trimmed(line.text).empty()) continue;
    if (!shape_.end.empty() && trimmed(line.text).substr(0, shape_.end.size()) == shape_.end &&
        number != shape_.header_line) {
      guesses_.push_back("the table ends above line " + std::to_string(number));
      break;
    }
    if (number != shape_.header_line && is_comment(line.text)) {
      if (lines.empty()) last_comment_ = line;
      ++comments;
      continue;
    }
    lines.push_back(line);
  }
  if (comments > 0) guesses_.push_back("comment lines that are left out: " + std::to_string(comments));
  return lines;
}

bool ForeignTable::is_comment(std::string_view line) const {
  return std::any_of(shape_.comments.begin(), shape_.comments.end(),
                     [&](const std::string& word) { return trimmed(line).substr(0, word.size()) == word; });
}

// Returns the first line that is a row.
std::size_t ForeignTable::take_header(const std::vector<Line>& lines) {
  guess_separator(lines[0].text);
  const auto first = split(lines[0]);
  if (!shape_.has_header) {
    name_columns(std::vector<std::string_view>(first.size()));
    return 0;
  }
  const bool numbers =
      std::all_of(first.begin(), first.end(),
                  [](std::string_view cell) { return stands_for_nothing(cell) || parse_real(cell).has_value(); }) &&
      std::any_of(first.begin(), first.end(), [](std::string_view cell) { return parse_real(cell).has_value(); });
  if (!numbers) {
    name_columns(first);
    return 1;
  }
  // The names may be in the last comment above, as gnuplot and numpy write them.
  if (last_comment_ && shape_.header_line == 0) {
    const std::string_view line = trimmed(last_comment_->text);
    std::size_t mark = 0;
    for (const std::string& word : shape_.comments) {
      if (line.substr(0, word.size()) == word) mark = std::max(mark, word.size());
    }
    const auto names = split({trimmed(line.substr(mark)), last_comment_->number});
    if (names.size() == first.size()) {
      guesses_.push_back("the names of columns are those of the comment in line " +
                         std::to_string(last_comment_->number));
      name_columns(names);
      return 0;
    }
  }
  throw invalid(
      {file_, lines[0].number, 0},
      "the first line holds numbers and no names; expected a header, or header = none in the map, where columns "
      "are called column1, column2, ...");
}

void ForeignTable::guess_separator(std::string_view line) {
  if (shape_.separator) {
    separator_ = *shape_.separator;
    return;
  }
  const auto count = [&](char c) { return std::count(line.begin(), line.end(), c); };
  const auto commas = shape_.decimal_comma ? 0 : count(',');
  if (count('\t') > commas && count('\t') >= count(';'))
    separator_ = '\t';
  else if (count(';') > commas)
    separator_ = ';';
  else if (commas == 0 && trimmed(line).find(' ') != line.npos && line.find('"') == line.npos)
    separator_ = ' ';
  if (separator_ != ',') guesses_.push_back("cells are separated by " + name_of(separator_));
}

void ForeignTable::name_columns(std::vector<std::string_view> names) {
  for (std::size_t c = 0; c < names.size(); ++c) {
    columns_.emplace_back(names[c].empty() ? "column" + std::to_string(c + 1) : std::string(names[c]));
    if (names[c].empty() && shape_.has_header)
      guesses_.push_back("the column without a name is called " + columns_.back());
  }
}

void ForeignTable::add_row(const Line& line) {
  const auto cells = split(line);
  if (cells.size() != columns_.size())
    throw invalid({file_, line.number, 0},
                  "the row has " + std::to_string(cells.size()) + (cells.size() == 1 ? " cell" : " cells") +
                      "; expected " + std::to_string(columns_.size()) +
                      " (a line that is no row: comment = WORD or end = WORD in the map leaves it out)");
  if (std::all_of(cells.begin(), cells.end(), [](std::string_view cell) { return cell.empty(); })) {
    guesses_.push_back("line " + std::to_string(line.number) + " has no cell filled, and is left out");
    return;
  }
  cells_.insert(cells_.end(), cells.begin(), cells.end());
  lines_.push_back(line.number);
}

// A cell in quotes, its own quotes doubled. `end` becomes the place after the closing quote.
std::string_view ForeignTable::quoted(std::string_view line, std::size_t quote_at, std::size_t& end, int number) {
  bool doubled = false;
  std::size_t close = line.find('"', quote_at + 1);
  for (; close != line.npos && close + 1 < line.size() && line[close + 1] == '"'; close = line.find('"', close + 2))
    doubled = true;
  if (close == line.npos) throw invalid({file_, number, static_cast<int>(quote_at) + 1}, "a quoted cell is not closed");
  end = close + 1;
  const std::string_view inside = line.substr(quote_at + 1, close - quote_at - 1);
  if (!doubled) return inside;
  std::string& text = unquoted_->emplace_back();
  for (std::size_t i = 0; i < inside.size(); ++i) {
    text += inside[i];
    if (inside[i] == '"') ++i;  // the second of a pair
  }
  return text;
}

std::vector<std::string_view> ForeignTable::split(const Line& whole) {
  refuse_control_characters(whole.text, {file_, whole.number, 0});
  const std::string_view line = separator_ == ' ' ? trimmed(whole.text) : whole.text;
  const char* const ends = separator_ == ' ' ? " \t" : nullptr;
  const auto next = [&](std::size_t from) {
    return ends ? line.find_first_of(ends, from) : line.find(separator_, from);
  };
  std::vector<std::string_view> cells;
  for (std::size_t at = 0;;) {
    std::size_t end = next(at);
    const std::size_t quote_at = line.find_first_not_of(' ', at);
    if (quote_at != line.npos && line[quote_at] == '"') {
      std::size_t past = 0;
      cells.push_back(quoted(line, quote_at, past, whole.number));
      end = next(past);
      if (!trimmed(line.substr(past, end == line.npos ? line.npos : end - past)).empty())
        throw invalid({file_, whole.number, static_cast<int>(past) + 1},
                      "text after a quoted cell; expected " + name_of(separator_) + " or the end of the line");
    } else {
      cells.push_back(trimmed(line.substr(at, end == line.npos ? line.npos : end - at)));
    }
    if (end == line.npos) return cells;
    at = ends ? line.find_first_not_of(ends, end) : end + 1;
  }
}

bool ForeignTable::has(const std::string& column) const {
  return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
}

std::size_t ForeignTable::require(const std::string& column, const Place& for_whom) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) {
    if (const std::size_t number = number_in(column); number > 0 && number <= columns_.size()) return number - 1;
    for (const std::string& fault : {division(column, columns_), function_call(column, columns_)})
      if (!fault.empty()) throw invalid(for_whom, fault);
    throw invalid(for_whom,
                  file_ + " has no column " + quote(column) + why_no_column(column) + "; " + suggest(column, columns_));
  }
  const auto first = static_cast<std::size_t>(found - columns_.begin());
  if (const auto again = std::find(found + 1, columns_.end(), column); again != columns_.end())
    throw invalid(for_whom, file_ + " has two columns " + quote(column) + "; expected column" +
                                std::to_string(first + 1) + " or column" +
                                std::to_string(again - columns_.begin() + 1));
  return first;
}

bool ForeignTable::is_nothing(std::size_t row, std::size_t column) const {
  return stands_for_nothing(text(row, column));
}

// True where the first row has names of units, at least two of them, and otherwise nothing.
bool ForeignTable::is_line_of_units() const {
  static constexpr std::string_view units[] = {"s",   "ms", "us", "ns", "m",   "cm",  "mm",  "km",    "rad", "deg",
                                               "dBm", "dB", "mW", "Hz", "m/s", "MHz", "GHz", "rad/s", "-",   "none"};
  std::size_t found = 0;
  for (std::size_t column = 0; column < columns_.size(); ++column) {
    std::string cell(text(0, column));
    if (cell.size() > 2 && (cell.front() == '[' || cell.front() == '(')) cell = cell.substr(1, cell.size() - 2);
    if (cell.empty()) continue;
    if (std::find(std::begin(units), std::end(units), cell) == std::end(units)) return false;
    ++found;
  }
  return found >= 2;
}

std::optional<double> ForeignTable::number(std::size_t row, std::size_t column, const std::string& advice) const {
  std::string cell(text(row, column));
  // A word such as Total below numbers, in whatever column.
  if (row > 0 && row + 1 == rows() && is_summary(text(row, 0)) && parse_real(text(row - 1, 0)))
    throw invalid(place(row), "the last line holds sums or means and no reading; expected it away: sed '" +
                                  std::to_string(place(row).line) + "d' FILE");
  if (shape_.decimal_comma && cell.find('.') == cell.npos) std::replace(cell.begin(), cell.end(), ',', '.');
  if (cell.size() > 1 && cell[0] == '+') cell.erase(0, 1);  // as loggers print it
  if (const auto value = parse_real(cell)) return value;
  if (stands_for_nothing(cell)) return std::nullopt;
  if (row == 0 && is_line_of_units())
    throw invalid(place(row), "the line holds units and no reading; expected it away: sed '" +
                                  std::to_string(place(row).line) + "d' FILE, and the units in the rules of the map");
  if (cell == columns_[column])
    throw invalid(place(row), "the line repeats the header, as in two logs joined; expected it away: sed '" +
                                  std::to_string(place(row).line) + "d' FILE");
  throw invalid(place(row), "column " + quote(columns_[column]) + ": " + why_not_real(cell) + advice);
}

}  // namespace muster::diagnosis
