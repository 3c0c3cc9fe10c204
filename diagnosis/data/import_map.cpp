#include "diagnosis/data/import_map.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <sstream>

#include "text/names.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == text.npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

double number_of(const std::string& text, const Place& place) {
  const auto value = parse_real(text);
  if (!value) throw invalid(place, why_not_real(text));
  return *value;
}

// A number, pi, or a number through another; none of any other text.
std::optional<double> constant(const std::string& text) {
  constexpr double pi = 3.141592653589793;
  if (text == "pi" || text == "M_PI" || text == "math.pi" || text == "np.pi") return pi;
  const std::size_t slash = text.find('/');
  if (slash == text.npos) return parse_real(text);
  const auto over = constant(trimmed(text.substr(0, slash))), under = constant(trimmed(text.substr(slash + 1)));
  return over && under && *under != 0 ? std::optional(*over / *under) : std::nullopt;
}

// SCALE*COLUMN, the factor a plain number and first.
double scale_of(const std::string& text, std::size_t star, const Place& place) {
  const std::string first = trimmed(text.substr(0, star)), second = trimmed(text.substr(star + 1));
  if (const auto value = parse_real(first)) return *value;
  const auto expected = [&](double factor, const std::string& column) {
    return invalid(place, quote(text) +
                              ": a rule is SCALE*COLUMN + OFFSET, with numbers for SCALE and OFFSET; expected " +
                              print_real(factor) + "*" + column);
  };
  if (const auto factor = constant(first)) throw expected(*factor, second);
  if (const auto factor = constant(second)) throw expected(*factor, first);
  throw invalid(place, why_not_real(first) + "; expected SCALE*COLUMN + OFFSET, such as 0.001*ms + 0.5");
}

ColumnReference column_reference(const std::string& text) {
  const std::size_t dot = text.find('.');
  return dot == text.npos ? ColumnReference{"", text} : ColumnReference{text.substr(0, dot), text.substr(dot + 1)};
}

// Parses "SCALE*COLUMN + OFFSET" and "SCALE*log10(COLUMN) + OFFSET"; each part but the column is optional. Signs of the
// offset are set off by spaces, so that a column may be called rssi-1.
NumberRule number_rule(std::string text, const Place& place) {
  NumberRule rule;
  for (const char* sign : {" + ", " - "}) {
    const std::size_t at = text.find(sign);
    if (at == text.npos) continue;
    if (text.back() == ')' && text.find('(') < at && text.rfind("log10(", 0) != 0)
      throw invalid(place, quote(text) + " has parentheses; expected SCALE*COLUMN + OFFSET, such as 0.01*x_cm + 0.05");
    const std::string second = trimmed(text.substr(at + 3));
    if (!parse_real(second) && (second.find('*') != text.npos || std::isalpha(static_cast<unsigned char>(second[0]))))
      throw invalid(place, quote(second) +
                               " is no number, and a rule takes one column, SCALE*COLUMN + OFFSET; expected "
                               "one of the two columns, or one that has both in it (of a stamp: t[s] = time COLUMN)");
    rule.offset = number_of(second, place) * (sign[1] == '-' ? -1 : 1);
    text = trimmed(text.substr(0, at));
    break;
  }
  if (const std::size_t star = text.find('*'); star != text.npos) {
    rule.scale = scale_of(text, star, place);
    text = trimmed(text.substr(star + 1));
  }
  if (text.rfind("log10(", 0) == 0 && text.back() == ')') {
    rule.logarithm = true;
    text = trimmed(text.substr(6, text.size() - 7));
  } else if (const auto constant = parse_real(text)) {
    rule.offset += rule.scale * *constant;
    return rule;
  }
  rule.from = column_reference(text);
  if (rule.from.column.empty()) throw invalid(place, "no column; expected SCALE*COLUMN + OFFSET, or a name in quotes");
  return rule;
}

// Parses "COLUMN [COLUMN] [since STAMP]".
TimeRule time_rule(const std::string& text, const Place& place) {
  TimeRule rule{text, {}};
  if (const std::size_t at = (' ' + text).find(" since "); at != text.npos) {
    const std::string stamp = trimmed(text.substr(at + 6));
    rule.words = trimmed(text.substr(0, at));
    rule.since = parse_stamp(stamp);
    if (!rule.since) throw invalid(place, why_no_stamp(stamp));
  }
  if (rule.words.empty()) throw invalid(place, "no column; expected time COLUMN, or time DATE_COLUMN CLOCK_COLUMN");
  return rule;
}

// Parses "LATITUDE LONGITUDE [ALTITUDE]", columns.
GlobeRule globe_rule(const std::string& word, const std::vector<std::string>& columns, const Place& place) {
  GlobeRule rule;
  rule.axis = word == "east" ? 0 : word == "north" ? 1 : 2;
  const std::size_t most = 3, least = rule.axis == 2 ? 3 : 2;
  if (columns.size() < least || columns.size() > most)
    throw invalid(place,
                  "expected " + word +
                      (rule.axis == 2 ? " LATITUDE LONGITUDE ALTITUDE" : " LATITUDE LONGITUDE, and perhaps ALTITUDE") +
                      ", the names of columns");
  const auto begins = [](const std::string& column, std::string_view with) {
    const std::string name = column_reference(column).column;
    return name.size() >= with.size() && std::equal(with.begin(), with.end(), name.begin(), [](char a, char b) {
             return a == std::tolower(static_cast<unsigned char>(b));
           });
  };
  if ((begins(columns[0], "lon") || begins(columns[0], "lng")) && begins(columns[1], "lat"))
    throw invalid(place, quote(columns[0]) + " stands where the latitude does; expected " + word + " " + columns[1] +
                             " " + columns[0] + ": the latitude first");
  rule.latitude = column_reference(columns[0]);
  rule.longitude = column_reference(columns[1]);
  if (columns.size() == most) rule.altitude = column_reference(columns[2]);
  return rule;
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file)
      : source_(read_text_file(file, 1'000'000)), folder_(file.parent_path()) {}

  ImportMap read() {
    std::istringstream lines(source_.text);
    std::string line;
    for (place_ = {source_.file, 1, 0}; std::getline(lines, line); ++place_.line) {
      line = trimmed(line);
      for (const char c : line) {
        if (static_cast<unsigned char>(c) < 0x20 && c != '\t')
          throw invalid(place_, "the control character " + quote({&c, 1}) + " is not allowed");
      }
      if (!line.empty() && line[0] != '#') read_rule(line);
    }
    place_.line = 0;
    map_.file = source_.file;
    if (map_.columns.empty()) throw invalid(place_, "no column is mapped; expected lines such as rssi[dBm] = rssi");
    return std::move(map_);
  }

 private:
  void read_rule(const std::string& line) {
    const std::size_t equals = line.find('=');
    if (const auto words = words_of(line);
        equals == line.npos && words.size() > 3 && words[0] == "for" && words[2] == "in")
      throw invalid(place_,
                    quote(line) + " has no '='; expected for " + words[1] + " =" + line.substr(line.find(" in ") + 3));
    if (equals == line.npos)
      throw invalid(place_, quote(line) + " has no '='; expected COLUMN[UNIT] = RULE" +
                                (line.find_first_of(",;\t") != line.npos
                                     ? "; is this the table? expected muster import TABLE --map MAP"
                                     : ""));
    const std::string left = trimmed(line.substr(0, equals)), right = trimmed(line.substr(equals + 1));
    const auto words = words_of(left);
    if (words.size() == 2 && words[0] == "for") return read_variable(words[1], right);
    if (words.size() == 2 && words[0] == "table") return read_table(words[1], right);
    if (words.size() == 2 && words[0] == "none") return read_none(words[1], right);
    if (left == "file name") return read_file_name(right);
    if (read_shape(left, right)) return;
    if (left == "origin") return read_origin(right);
    if (left == "none")
      throw invalid(place_, "none names no column; expected none COLUMN = " + right +
                                ", the column of the log in which that means no value");
    if (words.size() != 1)
      throw invalid(place_, quote(left) + " is no column; expected name or name[unit], for, table, none or file name");
    read_column(left, right);
  }

  void read_variable(const std::string& name, const std::string& right) {
    map_.variable = name;
    map_.values = words_of(right);
    if (map_.values.empty()) throw invalid(place_, "for " + name + " has no values; expected a list such as 1 2 3");
  }

  void read_table(const std::string& name, const std::string& right) {
    const auto words = words_of(right);
    if (words.size() != 3) throw invalid(place_, "expected table NAME = FILE KEY_COLUMN KEY");
    if (const auto used = dotted_.find(name); used != dotted_.end())
      throw invalid(place_, "table " + quote(name) + " stands below line " + std::to_string(used->second) +
                                ", which uses it; expected it above");
    map_.tables[name] = {folder_ / words[0], words[1], words[2], place_};
  }

  void read_none(const std::string& column, const std::string& right) {
    if (right.find(',') != right.npos && right.find(' ') != right.npos)
      throw invalid(place_, quote(right) + ": values stand between blanks, without commas; expected none " + column +
                                " = 0 -128");
    for (const auto& word : words_of(right)) map_.none[column].push_back(number_of(word, place_));
  }

  void read_file_name(const std::string& pattern) { map_.file_name = FileNamePattern(pattern, place_); }

  void read_origin(const std::string& right) {
    const auto words = words_of(right);
    if (words.size() != 2 && words.size() != 3) throw invalid(place_, "expected origin = LATITUDE LONGITUDE ALTITUDE");
    map_.origin = GeodeticPoint{number_of(words[0], place_), number_of(words[1], place_),
                                words.size() == 3 ? number_of(words[2], place_) : 0};
    if (const std::string why = why_no_point(*map_.origin); !why.empty()) throw invalid(place_, why);
  }

  // False for a line about something else.
  bool read_shape(const std::string& left, const std::string& right) {
    static const std::map<std::string, char> separators = {
        {"comma", ','}, {"semicolon", ';'}, {"tab", '\t'}, {"space", ' '}};
    const auto words = words_of(right);
    if (left == "header") {
      if (words == std::vector<std::string>{"none"}) {
        map_.shape.has_header = false;
        return true;
      }
      const auto line = words.size() == 2 && words[0] == "line" ? parse_integer(words[1]) : std::nullopt;
      if (!line || *line < 1 || *line > 1'000'000)
        throw invalid(place_, "expected header = none, or header = line NUMBER");
      map_.shape.header_line = static_cast<int>(*line);
    } else if (left == "comment") {
      if (words.empty()) throw invalid(place_, "expected comment = WORD, with which lines begin that are left out");
      map_.shape.comments = words;
    } else if (left == "end") {
      if (right.empty()) throw invalid(place_, "expected end = TEXT, with which the line begins that ends the table");
      map_.shape.end = right;
    } else if (left == "cells") {
      const auto found = separators.find(right);
      if (found == separators.end())
        throw invalid(place_,
                      quote(right) + " separates no cells; " + suggest(right, {"comma", "semicolon", "tab", "space"}));
      map_.shape.separator = found->second;
    } else if (left == "decimal") {
      if (right != "comma" && right != "point") throw invalid(place_, "expected decimal = comma or decimal = point");
      map_.shape.decimal_comma = right == "comma";
    } else {
      return false;
    }
    return true;
  }

  // "field.x" is the column x of a table "field" where one is declared above, and else the column field.x, as ROS calls
  // it.
  void resolve(ColumnReference& from) {
    if (from.table.empty() || map_.tables.count(from.table)) return;
    std::vector<std::string> known;
    for (const auto& [other, table] : map_.tables) known.push_back(other);
    if (!nearest(from.table, known).empty())
      throw invalid(place_, "there is no table " + quote(from.table) + " above; " + suggest(from.table, known));
    dotted_.emplace(from.table, place_.line);
    from = {"", from.table + '.' + from.column};
  }

  void read_column(const std::string& label, const std::string& right) {
    const std::size_t open = label.find('[');
    ColumnRule rule;
    rule.column.name = label.substr(0, open);
    rule.text = right;
    rule.place = place_;
    if (open != label.npos && label.back() == ']') rule.column.unit = label.substr(open + 1, label.size() - open - 2);
    for (const ColumnRule& other : map_.columns) {
      if (other.column.name == rule.column.name)
        throw invalid(place_, "column " + quote(rule.column.name) + " is mapped twice");
    }
    if (right.size() >= 2 && right.front() == '"' && right.back() == '"') {
      rule.is_name = true;
      rule.name = right.substr(1, right.size() - 2);
    } else if (right.rfind("name ", 0) == 0) {
      rule.is_name = true;
      rule.name_column = trimmed(right.substr(5));
    } else if (const auto words = words_of(right); words.size() > 1 && words[0] == "time") {
      rule.time = time_rule(trimmed(right.substr(5)), place_);
    } else if (words.size() > 1 && (words[0] == "east" || words[0] == "north" || words[0] == "up")) {
      rule.globe = globe_rule(words[0], {words.begin() + 1, words.end()}, place_);
      resolve(rule.globe->latitude), resolve(rule.globe->longitude);
      if (rule.globe->altitude) resolve(*rule.globe->altitude);
    } else {
      rule.number = number_rule(right, place_);
      resolve(rule.number->from);
    }
    map_.columns.push_back(rule);
  }

  TextFile source_;
  std::filesystem::path folder_;
  Place place_;
  ImportMap map_;
  std::map<std::string, int> dotted_;  // what stands before the dot in columns' names, and the line
};

}  // namespace

ImportMap read_import_map(const std::filesystem::path& file) { return Reader(file).read(); }

std::string filled(std::string text, const std::string& variable, const std::string& value) {
  if (variable.empty()) return text;
  const std::string slot = '{' + variable + '}';
  for (std::size_t at = text.find(slot); at != text.npos; at = text.find(slot, at + value.size()))
    text.replace(at, slot.size(), value);
  return text;
}

}  // namespace muster::diagnosis
