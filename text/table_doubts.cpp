#include "table_doubts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "doubts.hpp"
#include "names.hpp"
#include "number.hpp"
#include "unit_words.hpp"

namespace muster {
namespace {

constexpr double apart = 10;          // times the largest other value, which a mark for no value is at least
constexpr double globe = 1e5;         // m; a scene is smaller, coordinates of UTM are larger
constexpr double lowest_gain = -200;  // dBi
constexpr std::string_view lengths[] = {"radius", "range", "width", "height", "thickness", "length"};

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return result;
}

double rounded(double value) { return std::round(value * 1e6) / 1e6; }

struct Label {
  std::string name, unit;
};

// Parts a header of others: "x (m)", "x_m", "x/m".
Label parted(const std::string& label) {
  const auto open = label.find_first_of("([{/");
  std::string name = label.substr(0, open);
  std::string unit = open == label.npos ? "" : label.substr(open + 1, label.find_first_of(")]}", open) - open - 1);
  while (!name.empty() && (name.back() == ' ' || name.back() == '_')) name.pop_back();
  while (!name.empty() && name.front() == ' ') name.erase(0, 1);
  return {lower(name), unit};
}

// True where the words are those of one unit, in any case: "M" of "m".
bool is_unit(const std::string& word, const std::string& unit) { return lower(word) == lower(unit); }

}  // namespace

bool is_mark(double value) {
  const double size = std::abs(value);
  for (const double mark : {999.0, 9999.0, 99999.0, 999999.0, 9999999.0, 32767.0, 32768.0, 65535.0})
    if (size == mark) return true;
  return size == 999.9 || size == 9999.9 || size >= 1e30;
}

std::string mark_doubt(const TextTable& table, std::size_t column, const std::vector<double>& values) {
  double largest = 0, mark = std::numeric_limits<double>::quiet_NaN();
  double least = std::numeric_limits<double>::infinity(), most = -least;
  std::size_t first = 0, marks = 0, others = 0;
  for (std::size_t row = 0; row < values.size(); ++row) {
    const double value = values[row];
    if (!std::isfinite(value)) continue;
    if (is_mark(value) && (marks == 0 || value == mark)) {
      if (marks++ == 0) first = row, mark = value;
      continue;
    }
    ++others;
    largest = std::max(largest, std::abs(value));
    least = std::min(least, value), most = std::max(most, value);
  }
  if (marks == 0 || others == 0 || std::abs(mark) < apart * largest) return "";
  return table.place(first, column).text() + ": column " + quote(table.columns()[column].label()) + ": " +
         print_real(mark) + (marks > 1 ? " in " + std::to_string(marks) + " rows" : "") +
         " lies far from all others, " + print_real(rounded(least)) +
         (least < most ? " to " + print_real(rounded(most)) : "") +
         ": is it a mark for no value? expected the table without " + (marks > 1 ? "these rows" : "this row");
}

void refuse_negative_length(const TextTable& table, std::size_t column, const std::vector<double>& values) {
  const TextColumn& declared = table.columns()[column];
  const bool is_length = std::find(std::begin(lengths), std::end(lengths), declared.name) != std::end(lengths);
  if (!is_length) return;
  const auto wrong = std::find_if(values.begin(), values.end(), [](double value) { return value < 0; });
  if (wrong == values.end()) return;
  throw invalid(table.place(static_cast<std::size_t>(wrong - values.begin()), column),
                "column " + quote(declared.label()) + ": " + print_real(*wrong) +
                    " is negative; expected a number from 0" + (declared.unit.empty() ? "" : ", in " + declared.unit));
}

std::vector<std::string> column_doubts(const TextTable& table, std::size_t column, const std::vector<double>& values) {
  std::vector<std::string> result;
  const TextColumn& declared = table.columns()[column];
  if (declared.name == "t") return result;  // times are held against the run by who reads them
  std::string doubt = mark_doubt(table, column, values);
  if (!doubt.empty()) return {doubt};
  for (std::size_t row = 0; row < values.size(); ++row) {
    const double value = values[row];
    if (!std::isfinite(value)) continue;
    constexpr double whole_turn = 6.3;  // rad, written with few digits
    if (declared.unit == "rad" && std::abs(value) <= whole_turn) continue;
    doubt = unit_doubt(declared.name, declared.unit, value);
    if (declared.unit == "m" && std::abs(value) >= globe)
      doubt = print_real(value) + " m: a place on the globe (UTM)? expected metres from an origin of your own";
    if (declared.unit == "dBi" && value < lowest_gain)
      doubt = print_real(value) + " dBi is the gain of no antenna; is it a mark for no value? expected a number";
    if (doubt.empty()) continue;
    result.push_back(table.place(row, column).text() + ": column " + quote(declared.label()) + ": " + doubt);
    break;
  }
  return result;
}

std::string as_wanted(const std::string& label, const std::vector<TextColumn>& wanted) {
  const Label meant = parted(label);
  for (const TextColumn& column : wanted) {
    const std::string name = lower(column.name);
    if (meant.name == name) {
      if (meant.unit.empty() || is_unit(meant.unit, column.unit)) return column.label();
      const std::string how = conversion(meant.unit, column.unit);
      if (!how.empty()) return column.label() + how;
    }
    // "x_m", "x_ft": a unit behind the name.
    const auto bar = meant.name.rfind('_');
    if (bar == std::string::npos || meant.name.substr(0, bar) != name) continue;
    const std::string unit = meant.name.substr(bar + 1);
    if (!column.unit.empty() && is_unit(unit, column.unit)) return column.label();
    const std::string how = conversion(unit, column.unit);
    if (!how.empty()) return column.label() + how;
  }
  return "";
}

std::string quoted_label(const std::string& wanted) {
  const auto end = wanted.find(": ");
  return end == wanted.npos ? quote(wanted) : quote(wanted.substr(0, end)) + wanted.substr(end);
}

std::string conversion(const std::string& from, const std::string& to) {
  if (from.empty() || to.empty() || from == to) return "";
  if (from == "mW" && to == "dBm") return ": 10 log10 of the milliwatts";
  if (from == "deg" && to == "rad") return ": 1 deg is 0.0174533 rad";
  const std::optional<double> value = in_unit(to, "1" + from);
  if (from == "ns" && to == "s") return ": 1 ns is 0.000000001 s";
  if (from == "us" && to == "s") return ": 1 us is 0.000001 s";
  return value ? ": 1 " + from + " is " + print_real(*value) + ' ' + to : "";
}

bool is_summary(std::string_view cell) {
  static constexpr std::string_view words[] = {"total", "totals", "sum", "mean",  "average", "avg",   "median",
                                               "min",   "max",    "std", "count", "summe",   "gesamt"};
  std::string word = lower(cell);
  while (!word.empty() && (word.back() == ':' || word.back() == ' ')) word.pop_back();
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

}  // namespace muster
