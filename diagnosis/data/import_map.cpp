#include "diagnosis/data/import_map.hpp"

#include <algorithm>
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

// Parses "SCALE*COLUMN + OFFSET"; each part but the column is optional. Signs of the offset are set off by spaces, so
// that a column may be called rssi-1.
NumberRule number_rule(std::string text, const Place& place) {
  NumberRule rule;
  for (const char* sign : {" + ", " - "}) {
    const std::size_t at = text.find(sign);
    if (at == text.npos) continue;
    rule.offset = number_of(trimmed(text.substr(at + 3)), place) * (sign[1] == '-' ? -1 : 1);
    text = trimmed(text.substr(0, at));
    break;
  }
  if (const std::size_t star = text.find('*'); star != text.npos) {
    rule.scale = number_of(trimmed(text.substr(0, star)), place);
    text = trimmed(text.substr(star + 1));
  }
  if (const auto constant = parse_real(text)) {
    rule.offset += rule.scale * *constant;
    return rule;
  }
  const std::size_t dot = text.find('.');
  if (dot != text.npos) rule.table = text.substr(0, dot);
  rule.column = dot == text.npos ? text : text.substr(dot + 1);
  if (rule.column.empty()) throw invalid(place, "no column; expected SCALE*COLUMN + OFFSET, or a name in quotes");
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
    if (equals == line.npos) throw invalid(place_, quote(line) + " has no '='; expected COLUMN[UNIT] = RULE");
    const std::string left = trimmed(line.substr(0, equals)), right = trimmed(line.substr(equals + 1));
    const auto words = words_of(left);
    if (words.size() == 2 && words[0] == "for") return read_variable(words[1], right);
    if (words.size() == 2 && words[0] == "table") return read_table(words[1], right);
    if (words.size() == 2 && words[0] == "none") return read_none(words[1], right);
    if (words.size() != 1)
      throw invalid(place_, quote(left) + " is no column; expected name or name[unit], for, table or none");
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
    map_.tables[name] = {folder_ / words[0], words[1], words[2]};
  }

  void read_none(const std::string& column, const std::string& right) {
    for (const auto& word : words_of(right)) map_.none[column].push_back(number_of(word, place_));
  }

  void read_column(const std::string& label, const std::string& right) {
    const std::size_t open = label.find('[');
    ColumnRule rule{
        .column = {label.substr(0, open), ""}, .name = "", .name_column = "", .number = {}, .place = place_};
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
    } else {
      rule.number = number_rule(right, place_);
      if (!rule.number->table.empty() && !map_.tables.count(rule.number->table)) {
        std::vector<std::string> known;
        for (const auto& [name, table] : map_.tables) known.push_back(name);
        throw invalid(
            place_, "there is no table " + quote(rule.number->table) + " above; " + suggest(rule.number->table, known));
      }
    }
    map_.columns.push_back(rule);
  }

  TextFile source_;
  std::filesystem::path folder_;
  Place place_;
  ImportMap map_;
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
