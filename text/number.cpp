#include "number.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <system_error>
#include <type_traits>
#include <utility>

#include "names.hpp"

namespace muster {
namespace {

constexpr std::string_view white_space = " \t\r\n";

template <class Number>
struct Parsed {
  Number value{};
  std::errc error{};
  std::string_view rest;  // what follows the number
};

template <class Number>
Parsed<Number> parse(std::string_view text) {
  Parsed<Number> result;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, result.value);
  result.error = error;
  result.rest = {stop, static_cast<std::size_t>(end - stop)};
  return result;
}

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> items;
  for (std::size_t at = text.find_first_not_of(white_space); at != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(white_space, at), text.size());
    items.push_back(text.substr(at, end - at));
    at = text.find_first_not_of(white_space, end);
  }
  return items;
}

// True for texts that from_chars reads without digits: nan, nan(...), inf and infinity in any case.
bool is_not_finite(std::string_view text) {
  const Parsed<double> parsed = parse<double>(text);
  return parsed.error == std::errc{} && parsed.rest.empty() && !std::isfinite(parsed.value);
}

bool is_hexadecimal(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  return text.starts_with("0x") || text.starts_with("0X");
}

// A word for a unit, of whatever quantity: no number here has one behind it.
bool is_unit(std::string_view text) {
  static constexpr std::string_view units[] = {
      "m",      "cm",      "mm",     "um",      "km",    "dm",     "ft",     "in",     "meter",   "meters", "metre",
      "metres", "s",       "ms",     "us",      "ns",    "sec",    "secs",   "second", "seconds", "min",    "mins",
      "minute", "minutes", "h",      "hr",      "hour",  "hours",  "d",      "m/s",    "km/h",    "kmh",    "cm/s",
      "mm/s",   "mps",     "m/s2",   "m/s^2",   "rad",   "deg",    "degs",   "degree", "degrees", "\u00b0", "rad/s",
      "deg/s",  "rpm",     "rad/s2", "radians", "db",    "dbm",    "dbi",    "db/m",   "hz",      "khz",    "mhz",
      "ghz",    "kg",      "g",      "gram",    "grams", "t",      "n",      "kn",     "nm",      "n*m",    "n/m",
      "w",      "mw",      "kw",     "v",       "mv",    "a",      "ma",     "ah",     "wh",      "j",      "pa",
      "kpa",    "%",       "bit",    "bits",    "bit/s", "kbit/s", "mbit/s", "kbps",   "mbps",    "bps",    "byte",
      "bytes",  "b",       "kb",     "mb",      "px",    "pixel",  "pixels", "1/s",    "m2",      "m^2",    "m3",
      "m^3",    "kg*m2",   "kg*m^2", "kgm2",    "kg/m3", "kg/m^3", "tick",   "ticks"};
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; });
  return std::find(std::begin(units), std::end(units), small) != std::end(units);
}

std::string_view trimmed(std::string_view text) {
  const auto from = text.find_first_not_of(white_space);
  return from == text.npos ? "" : text.substr(from, text.find_last_not_of(white_space) - from + 1);
}

// ": 16" of "0x10".
std::string decimal_of(std::string_view text) {
  const std::string_view minus = text.starts_with('-') ? "-" : "";
  const std::string_view digits = text.substr(minus.size() + 2);
  std::uint64_t value = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (error != std::errc{} || stop != digits.data() + digits.size()) return "";
  return ": " + std::string(minus) + std::to_string(value);
}

bool is_yes_or_no(std::string_view text) {
  static constexpr std::string_view words[] = {"true", "false", "yes", "no", "on", "off", "True", "False"};
  return std::find(std::begin(words), std::end(words), text) != std::end(words);
}

std::string without(std::string_view text, std::string_view signs, char instead = 0) {
  std::string result;
  for (const char c : text) {
    if (signs.find(c) == signs.npos)
      result += c;
    else if (instead)
      result += instead;
  }
  return result;
}

// "1,234,567.8": each comma has three digits behind it, and there are several commas, or a point.
bool has_thousands(std::string_view text) {
  if (!parse_real(without(text, ","))) return false;
  std::size_t commas = 0;
  for (std::size_t at = text.find(','); at != text.npos; at = text.find(',', at + 1), ++commas) {
    const std::string_view behind = text.substr(at + 1, 4);
    const bool three = behind.size() >= 3 && behind.find_first_not_of("0123456789") >= 3;
    if (!three || (behind.size() == 4 && behind[3] >= '0' && behind[3] <= '9')) return false;
  }
  return commas > 1 || text.find('.') != text.npos;
}

std::string comma_fault(std::string_view text) {
  if (has_thousands(text)) return "; no commas stand between thousands; expected " + without(text, ",");
  if (text.front() == ',' || text.back() == ',') return "; a comma stands beside it; expected none";
  return "; a decimal point is written '.'";
}

// "2024-05-03T12:00:00"
bool is_date(std::string_view text) {
  constexpr std::string_view form = "dddd-dd-dd";
  return text.size() >= form.size() && std::equal(form.begin(), form.end(), text.begin(), [](char f, char c) {
           return f == 'd' ? c >= '0' && c <= '9' : c == f;
         });
}

// "0.016666666666666666" of "1/60".
std::string value_of_fraction(std::string_view text) {
  const auto slash = text.find('/');
  if (slash == text.npos) return "";
  const auto above = parse_real(text.substr(0, slash)), below = parse_real(text.substr(slash + 1));
  return above && below && *below != 0 && std::isfinite(*above / *below) ? print_real(*above / *below) : "";
}

template <class Number>
std::string why_not(std::string_view text, std::string_view kind) {
  std::string refusal = quote(text) + " is not " + std::string(kind);
  if (text.empty()) return refusal + "; the text is empty";
  const Parsed<double> leading = parse<double>(trimmed(text));
  if (leading.error == std::errc{} && std::isfinite(leading.value) && is_unit(trimmed(leading.rest)))
    return refusal + "; " + quote(trimmed(leading.rest)) + " follows the number: units are fixed and not written";
  if (is_unit(text)) return refusal + ", but a unit: units are fixed and not written";
  if (is_yes_or_no(text)) return refusal + ", but a word for yes or no";
  if (text.find_first_of(white_space) != text.npos) return refusal + "; it has spaces in it or around it";
  if (text.find(',') != text.npos) return refusal + comma_fault(text);
  for (const auto& [sign, code] : {std::pair("\u2212", "U+2212"), {"\u2013", "U+2013"}, {"\u2014", "U+2014"}})
    if (text.find(sign) != text.npos) return refusal + "; its minus is the sign " + code + "; expected '-'";
  for (const auto& [blank, code] : {std::pair("\u00a0", "U+00A0"), {"\u202f", "U+202F"}, {"\u2009", "U+2009"}})
    if (text.find(blank) != text.npos)
      return refusal + "; a blank in it is the no-break or thin space " + code + "; expected a plain one";
  if (const std::string value = value_of_fraction(text); std::is_same_v<Number, double> && !value.empty())
    return refusal + ", but a fraction; expected " + value;
  if (is_date(text)) return refusal + ", but a date; expected seconds (muster import reads dates)";
  if (text.front() == '+') return refusal + "; a positive number is written without '+'";
  if (is_hexadecimal(text)) return refusal + "; numbers are written in decimal" + decimal_of(text);
  if (is_not_finite(text)) return refusal + "; it must be finite";
  const Parsed<Number> parsed = parse<Number>(text);
  if (parsed.error == std::errc::result_out_of_range && parsed.rest.empty()) return quote(text) + " is out of range";
  if (parsed.error != std::errc::invalid_argument) return refusal + "; " + quote(parsed.rest) + " follows the number";
  return refusal;
}

}  // namespace

bool is_infinite(std::string_view text) {
  const Parsed<double> parsed = parse<double>(text);
  return parsed.error == std::errc{} && parsed.rest.empty() && std::isinf(parsed.value);
}

std::optional<double> parse_real(std::string_view text) {
  const Parsed<double> parsed = parse<double>(text);
  if (parsed.error != std::errc{} || !parsed.rest.empty() || !std::isfinite(parsed.value)) return std::nullopt;
  return parsed.value;
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
  const Parsed<std::int64_t> parsed = parse<std::int64_t>(text);
  if (parsed.error != std::errc{} || !parsed.rest.empty()) return std::nullopt;
  return parsed.value;
}

std::optional<std::vector<double>> parse_reals(std::string_view text, std::size_t n) {
  std::vector<double> values;
  for (const std::string_view item : split(text)) {
    const std::optional<double> value = parse_real(item);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  if (values.size() != n) return std::nullopt;
  return values;
}

bool stands_for_nothing(std::string_view text) {
  static constexpr std::string_view words[] = {"",    "nan",  "NaN",  "NAN",  "NA",  "N/A",
                                               "n/a", "null", "NULL", "None", "none"};
  return std::find(std::begin(words), std::end(words), text) != std::end(words);
}

std::string print_real(double value) {
  if (std::isnan(value)) return "nan";  // to_chars would add the sign of a NaN
  char text[32];                        // the longest, -2.2250738585072014e-308, has 24
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string why_not_real(std::string_view text) { return parse_real(text) ? "" : why_not<double>(text, "a number"); }

std::string why_not_integer(std::string_view text) {
  return parse_integer(text) ? "" : why_not<std::int64_t>(text, "an integer");
}

std::string reals_as_meant(std::string_view text, std::size_t n) {
  const std::string plain = without(without(text, "()[]{}"), ",;", ' ');
  if (plain == text || !parse_reals(plain, n)) return "";
  std::string result;
  for (const std::string_view item : split(plain)) result += (result.empty() ? "" : " ") + std::string(item);
  return result;
}

std::string why_not_reals(std::string_view text, std::size_t n) {
  if (!reals_as_meant(text, n).empty())
    return quote(text) + (text.find_first_of("()[]{}") != text.npos ? " has brackets around its numbers"
                          : text.find(',') != text.npos             ? " has commas between its numbers"
                                                                    : " has semicolons between its numbers");
  const std::vector<std::string_view> items = split(text);
  const std::string apart = without(text, ",", ' ');
  const std::size_t number = split(apart).size();
  // "3, 2" where three are expected: each comma has a blank behind it, so that none is a decimal comma.
  if (apart != text && number == items.size() && parse_reals(apart, number))
    return quote(text) + " has commas between its numbers, and " + std::to_string(number) +
           (number == 1 ? " number" : " numbers");
  for (const std::string_view item : items) {
    if (std::string why = why_not_real(item); !why.empty()) return why;
  }
  if (items.size() == n) return "";
  return quote(text) + " has " + std::to_string(items.size()) + (items.size() == 1 ? " number" : " numbers");
}

}  // namespace muster
