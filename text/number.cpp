#include "number.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <system_error>
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

bool is_unit(std::string_view text) {
  static constexpr std::string_view units[] = {"m",  "cm",  "mm",  "km", "s",   "ms",  "m/s", "rad", "deg",
                                               "dB", "dBm", "dBi", "Hz", "kHz", "MHz", "GHz", "kg",  "N"};
  return std::find(std::begin(units), std::end(units), text) != std::end(units);
}

// "2024-05-03T12:00:00"
bool is_date(std::string_view text) {
  constexpr std::string_view form = "dddd-dd-dd";
  return text.size() >= form.size() && std::equal(form.begin(), form.end(), text.begin(), [](char f, char c) {
           return f == 'd' ? c >= '0' && c <= '9' : c == f;
         });
}

template <class Number>
std::string why_not(std::string_view text, std::string_view kind) {
  std::string refusal = quote(text) + " is not " + std::string(kind);
  if (text.empty()) return refusal + "; the text is empty";
  if (text.find_first_of(white_space) != text.npos) return refusal + "; it has spaces in it or around it";
  if (text.find(',') != text.npos) return refusal + "; a decimal point is written '.'";
  for (const auto& [sign, code] : {std::pair("\u2212", "U+2212"), {"\u2013", "U+2013"}, {"\u2014", "U+2014"}})
    if (text.find(sign) != text.npos) return refusal + "; its minus is the sign " + code + "; expected '-'";
  for (const auto& [blank, code] : {std::pair("\u00a0", "U+00A0"), {"\u202f", "U+202F"}, {"\u2009", "U+2009"}})
    if (text.find(blank) != text.npos)
      return refusal + "; a blank in it is the no-break or thin space " + code + "; expected a plain one";
  if (is_date(text)) return refusal + ", but a date; expected seconds (muster import reads dates)";
  if (text.front() == '+') return refusal + "; a positive number is written without '+'";
  if (is_hexadecimal(text)) return refusal + "; numbers are written in decimal";
  if (is_not_finite(text)) return refusal + "; it must be finite";
  const Parsed<Number> parsed = parse<Number>(text);
  if (parsed.error == std::errc::result_out_of_range && parsed.rest.empty()) return quote(text) + " is out of range";
  if (parsed.error != std::errc::invalid_argument)
    return refusal + "; " + quote(parsed.rest) + " follows the number" +
           (is_unit(parsed.rest) ? ": units are fixed and not written" : "");
  return refusal;
}

}  // namespace

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

std::string print_real(double value) {
  if (std::isnan(value)) return "nan";  // to_chars would add the sign of a NaN
  char text[32];                        // the longest, -2.2250738585072014e-308, has 24
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string why_not_real(std::string_view text) { return parse_real(text) ? "" : why_not<double>(text, "a number"); }

std::string why_not_integer(std::string_view text) {
  return parse_integer(text) ? "" : why_not<std::int64_t>(text, "an integer");
}

std::string why_not_reals(std::string_view text, std::size_t n) {
  const std::vector<std::string_view> items = split(text);
  if (items.size() < n) {
    std::string spaced(text);
    std::replace(spaced.begin(), spaced.end(), ',', ' ');
    if (parse_reals(spaced, n)) return quote(text) + " has commas between its numbers";
  }
  for (const std::string_view item : items) {
    if (std::string why = why_not_real(item); !why.empty()) return why;
  }
  if (items.size() == n) return "";
  return quote(text) + " has " + std::to_string(items.size()) + (items.size() == 1 ? " number" : " numbers");
}

}  // namespace muster
