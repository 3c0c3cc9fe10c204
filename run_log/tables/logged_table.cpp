#include "run_log/tables/logged_table.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "run_log/tables/cdr.hpp"

namespace muster::run_log {
namespace {

constexpr const char* layouts[] = {"row", "rows", "message"};
constexpr const char* kinds[] = {"real", "text", "bytes"};
constexpr const char* types[] = {"float64", "string", "uint8[]"};

// A name as a message's definition takes it: letters, digits and '_', a letter first.
std::string field_name(const std::string& name) {
  std::string result;
  for (const char c : name) result += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return result.empty() || !std::isalpha(static_cast<unsigned char>(result[0])) ? "c_" + result : result;
}

std::string field_lines(const LoggedTable& table) {
  std::string result;
  for (const Field& field : table.fields)
    result += std::string(types[static_cast<int>(field.kind)]) + ' ' + field_name(field.name) +
              (field.unit.empty() ? "" : "  # [" + field.unit + ']') + '\n';
  return result;
}

template <std::size_t n>
std::size_t place_of(const std::string& word, const char* const (&words)[n], const char* what) {
  for (std::size_t i = 0; i < n; ++i) {
    if (word == words[i]) return i;
  }
  throw mcap::Malformed(0, std::string("a channel's metadata name ") + what + " that does not exist");
}

// "x[m]:real"
Field field_of(const std::string& word) {
  const auto colon = word.rfind(':');
  if (colon == word.npos || colon == 0) throw mcap::Malformed(0, "a channel's metadata name a field without its kind");
  Field result{word.substr(0, colon), "", static_cast<Field::Kind>(place_of(word.substr(colon + 1), kinds, "a kind"))};
  const auto bracket = result.name.find('[');
  if (bracket != std::string::npos && result.name.back() == ']') {
    result.unit = result.name.substr(bracket + 1, result.name.size() - bracket - 2);
    result.name.resize(bracket);
  }
  return result;
}

void read_row(const LoggedTable& table, CdrReader& from, const TakeReal& take) {
  static thread_local std::vector<double> reals;
  reals.clear();
  std::string names = table.row;
  for (const Field& field : table.fields) {
    if (field.kind == Field::Kind::real) {
      reals.push_back(from.real());
    } else if (field.kind == Field::Kind::bytes) {
      from.bytes();
    } else if (const std::string_view name = from.text(); table.layout != Layout::row && !name.empty()) {
      names += (names.empty() ? "" : "/") + std::string(name);
    }
  }
  const std::string row = with_names(table.table, names);
  std::size_t next = 0;
  for (const Field& field : table.fields) {
    if (field.kind == Field::Kind::real) take(row, field, reals[next++]);
  }
}

// A line of a definition, "float64 x  # [m]"; null where it is none of a field.
std::optional<Field> field_of_definition(const std::string& line) {
  std::istringstream words(line);
  std::string type, unit;
  Field field;
  if (!(words >> type >> field.name)) return {};
  const auto found = std::find(std::begin(types), std::end(types), type);
  if (found == std::end(types)) return {};
  field.kind = static_cast<Field::Kind>(found - std::begin(types));
  if (words >> type >> unit && type == "#" && unit.size() > 2 && unit.front() == '[' && unit.back() == ']')
    field.unit = unit.substr(1, unit.size() - 2);
  return field;
}

}  // namespace

std::string with_names(const std::string& table, const std::string& names) {
  const auto star = table.find('*');
  if (star == std::string::npos) return table;
  return table.substr(0, star) + names + table.substr(star + 1);
}

std::string topic_of(const LoggedTable& table) {
  if (table.layout == Layout::row) return '/' + with_names(table.table, table.row);
  std::string result = '/' + table.table;
  if (const auto star = result.find("*/"); star != result.npos) result.erase(star, 2);
  return result;
}

std::string type_of(const LoggedTable& table) {
  std::string result = "muster/msg/";
  bool is_first = true;
  for (const char c : table.table) {
    const bool is_letter = std::isalnum(static_cast<unsigned char>(c));
    if (is_letter) result += is_first ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    is_first = !is_letter;
  }
  return result;
}

std::string definition_of(const LoggedTable& table) {
  const std::string head = "# " + table.table + " of a run of muster\n";
  if (table.layout != Layout::rows) return head + field_lines(table);
  const std::string row = type_of(table).substr(std::string("muster/msg/").size()) + "Row";
  return head + row + "[] rows\n" + std::string(80, '=') + "\nMSG: muster/" + row + '\n' + field_lines(table);
}

mcap::Texts metadata_of(const LoggedTable& table) {
  std::string fields;
  for (const Field& field : table.fields)
    fields += (fields.empty() ? "" : " ") + field.title() + ':' + kinds[static_cast<int>(field.kind)];
  return {{"muster.table", table.table},
          {"muster.row", table.row},
          {"muster.layout", layouts[static_cast<int>(table.layout)]},
          {"muster.fields", fields}};
}

std::optional<LoggedTable> table_of(const mcap::Channel& channel) {
  const auto found = channel.metadata.find("muster.table");
  if (found == channel.metadata.end()) return {};
  const auto text = [&](const char* name) {
    const auto at = channel.metadata.find(name);
    if (at == channel.metadata.end()) throw mcap::Malformed(0, std::string("a channel's metadata lack ") + name);
    return at->second;
  };
  LoggedTable result{
      found->second, text("muster.row"), static_cast<Layout>(place_of(text("muster.layout"), layouts, "a layout")), {}};
  std::istringstream words(text("muster.fields"));
  for (std::string word; words >> word;) result.fields.push_back(field_of(word));
  return result;
}

std::optional<LoggedTable> table_of(const mcap::Channel& channel, const mcap::Schema& schema) {
  if (auto whole = table_of(channel)) return whole;
  constexpr std::string_view before = "# ", behind = " of a run of muster";
  std::istringstream lines(schema.data);
  std::string line;
  if (!schema.name.starts_with("muster/msg/") || schema.encoding != "ros2msg" || !std::getline(lines, line)) return {};
  if (!line.starts_with(before) || !line.ends_with(behind) || line.size() <= before.size() + behind.size()) return {};
  LoggedTable result{line.substr(before.size(), line.size() - before.size() - behind.size()), "", Layout::message, {}};
  while (std::getline(lines, line)) {
    if (line.ends_with("[] rows")) result.layout = Layout::rows;
    if (auto field = field_of_definition(line)) result.fields.push_back(std::move(*field));
  }
  if (result.layout == Layout::rows || channel.topic == topic_of(result)) return result;
  const auto star = result.table.find('*');  // "/robot/leader/pose" of "robot/*/pose"
  const std::string head = '/' + result.table.substr(0, star), tail = result.table.substr(star + 1);
  if (star == std::string::npos || !channel.topic.starts_with(head) || !channel.topic.ends_with(tail) ||
      channel.topic.size() <= head.size() + tail.size())
    return {};
  result.row = channel.topic.substr(head.size(), channel.topic.size() - head.size() - tail.size());
  result.layout = Layout::row;
  return result;
}

std::vector<FieldValue> values_of(const LoggedTable& table, std::string_view data) {
  CdrReader from(data);
  std::vector<FieldValue> result;
  for (const Field& field : table.fields) {
    result.emplace_back();
    if (field.kind == Field::Kind::real)
      result.back().real = from.real();
    else
      result.back().text = field.kind == Field::Kind::bytes ? from.bytes() : from.text();
  }
  return result;
}

void read_message(const LoggedTable& table, std::string_view data, const TakeReal& take) {
  CdrReader from(data);
  std::uint32_t rows = table.layout == Layout::rows ? from.count("a number of rows") : 1;
  if (rows > from.left() || (rows > 0 && table.fields.empty()))
    throw mcap::Malformed(
        0, "a message of " + std::to_string(rows) + " rows in " + std::to_string(from.left()) + " bytes");
  for (; rows > 0; --rows) read_row(table, from, take);
}

}  // namespace muster::run_log
