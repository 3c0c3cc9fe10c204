#include "params.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

#include "text/doubts.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/synonyms.hpp"
#include "text/unit_words.hpp"

namespace muster {
namespace {

[[noreturn]] void refuse(const muster_param& declared, int count, const XmlAttribute& given, const std::string& what,
                         const std::string& hint = "") {
  const std::string help = declared.help ? declared.help : "";
  const bool has_order = count > 1 && help.find(": ") != help.npos;  // "place: x y z"
  const auto has = [&](double limit) { return help.find(print_real(limit)) != help.npos; };
  const bool tells_of_limits =
      is_infinite(given.value) && (has(declared.min) || has(declared.max));  // "at -40 Rayleigh"
  throw invalid(given.value_place, "attribute " + quote(given.name) + ": " + what + "; expected " +
                                       expectation(declared, count) + (count > 1 ? ", with spaces between them" : "") +
                                       (has_order || tells_of_limits ? " (" + help + ")" : "") + hint);
}

void check_bounds(const muster_param& declared, int count, const XmlAttribute& given, double value, const Warn& warn) {
  if (value < declared.min || value > declared.max)
    refuse(declared, count, given, print_real(value) + " is out of bounds",
           unit_hint(declared.unit, value, declared.min, declared.max) +
               (declared.kind == MUSTER_INTEGER && declared.help && *declared.help
                    ? " (" + std::string(declared.help) + ')'
                    : ""));
  if (const std::string doubt = unit_doubt(declared.name, declared.unit, value); !doubt.empty())
    warn(given.value_place, "attribute " + quote(given.name) + ": " + doubt);
}

// Four corners that are given as two, or by ends of a rectangle.
std::string corners_hint(const muster_param& declared, std::size_t count, const std::string& text) {
  constexpr std::size_t corners = 8;
  const auto two = parse_reals(text, 4);
  if (count != corners || std::string_view(declared.name) != "corners" || !two) return "";
  const auto [x0, y0, x1, y1] = std::tuple((*two)[0], (*two)[1], (*two)[2], (*two)[3]);
  std::string all;
  for (const double each : {x0, y0, x1, y0, x1, y1, x0, y1}) all += (all.empty() ? "" : " ") + print_real(each);
  return "; for the rectangle between these two: corners=\"" + all + '"';
}

// What was meant, as it is to be typed: `; write at="3 2 0"`.
std::string as_meant(const XmlAttribute& given, const std::string& value) {
  return value.empty() ? "" : "; write " + given.name + "=\"" + value + '"';
}

std::string flag_as_meant(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; });
  for (const char* yes : {"true", "yes", "on", "1", "y", "enabled"})
    if (word == yes) return "true";
  for (const char* no : {"false", "no", "off", "0", "n", "disabled"})
    if (word == no) return "false";
  return "";
}

double choice_value(const muster_param& declared, const XmlAttribute& given) {
  const auto words = choices(declared);
  const auto found = std::find(words.begin(), words.end(), given.value);
  if (found == words.end()) {
    throw invalid(given.value_place, "attribute " + quote(given.name) + ": " + quote(given.value) +
                                         " is not a choice; " + suggest(given.value, words));
  }
  return static_cast<double>(found - words.begin());
}

}  // namespace

void refuse_unknown(const XmlAttribute& given, const std::string& element, const std::vector<std::string>& valid) {
  throw invalid(given.place,
                "<" + element + "> has no attribute " + quote(given.name) + "; " + suggest(given.name, valid));
}

Error lacking(const XmlElement& element, const std::string& attribute, const std::string& expected) {
  std::string foreign;
  for (const auto& given : element.attributes)
    if (!synonym(given.name, {attribute}).empty()) foreign = "; is " + quote(given.name) + " meant for it?";
  return invalid(element.place, "<" + element.name + "> has no attribute " + quote(attribute) +
                                    ", which it needs; expected " + expected + foreign);
}

void refuse_inside(const XmlElement& element) {
  const XmlElement& inside = element.children[0];
  const XmlAttribute *name = inside.attribute("name"), *value = inside.attribute("value");
  if ((inside.name == "param" || inside.name == "parameter" || inside.name == "arg") && name && value)
    throw invalid(inside.place, "<" + inside.name + "> stands inside <" + element.name + "> of line " +
                                    std::to_string(element.place.line) +
                                    ", whose parameters are its attributes; expected <" + element.name + " ... " +
                                    name->value + "=\"" + value->value + "\"/>");
  throw invalid(inside.place, "<" + inside.name + "> stands inside <" + element.name + "> of line " +
                                  std::to_string(element.place.line) +
                                  ", which takes attributes only; "
                                  "expected elements side by side in <world>, each closed by \"/>\"");
}

void expect_attributes(const XmlElement& element, const std::vector<std::string>& valid) {
  for (const auto& given : element.attributes)
    if (std::find(valid.begin(), valid.end(), given.name) == valid.end()) refuse_unknown(given, element.name, valid);
  if (!element.children.empty()) refuse_inside(element);
}

const XmlAttribute& needed(const XmlElement& element, const char* name, const char* expected) {
  if (const auto* found = element.attribute(name)) return *found;
  throw lacking(element, name, expected);
}

uint64_t positive_integer(const XmlAttribute& given) {
  const auto value = parse_integer(given.value);
  if (!value || *value < 1) {
    throw invalid(
        given.value_place,
        "attribute " + quote(given.name) + ": " +
            (value ? given.value + " is out of bounds" : why_not_integer(given.value)) +
            "; expected an integer from 1" +
            (parse_real(given.value) && !value && given.name == "every" ? ": it counts ticks of the world's dt" : ""));
  }
  return static_cast<uint64_t>(*value);
}

uint64_t ticks_in(const XmlAttribute& given, double dt) {
  const auto seconds = parse_real(given.value);
  if (!parse_integer(given.value) && seconds && *seconds > 0 && dt > 0) {
    const double ticks = std::max(1.0, std::round(*seconds / dt));
    throw invalid(given.value_place, "attribute " + quote(given.name) + ": " + why_not_integer(given.value) +
                                         "; expected an integer from 1: it counts ticks of " + print_real(dt) + " s; " +
                                         given.value + " s are " + given.name + "=\"" + print_real(ticks) + '"');
  }
  return positive_integer(given);
}

double real_of(const XmlAttribute& given, double least, const char* expected) {
  const auto value = parse_real(given.value);
  if (!value)
    throw invalid(given.value_place, "attribute " + quote(given.name) + ": " + why_not_real(given.value) +
                                         "; expected " + expected + other_unit_hint("s", given.value));
  if (!(*value >= least))
    throw invalid(given.value_place,
                  "attribute " + quote(given.name) + ": " + given.value + " is out of bounds; expected " + expected);
  return *value;
}

void check_name(const XmlAttribute& given) {
  if (!is_name(given.value))
    throw invalid(given.value_place, "attribute " + quote(given.name) + ": " + quote(given.value) +
                                         " is not a name; expected letters, digits, _, - and .");
}

std::vector<std::string> choices(const muster_param& declared) {
  std::vector<std::string> words(1);
  for (const char* c = declared.text; *c; ++c) {
    if (*c == '|')
      words.emplace_back();
    else
      words.back() += *c;
  }
  return words;
}

std::string expectation(const muster_param& declared, int count) {
  const std::string unit = *declared.unit ? std::string(" ") + declared.unit : "";
  const std::string many = count > 1 ? std::to_string(count) + " numbers" : "a number";
  switch (declared.kind) {
    case MUSTER_REAL:
      return many + " from " + print_real(declared.min) + " to " + print_real(declared.max) + unit;
    case MUSTER_INTEGER:
      return "an integer from " + print_real(declared.min) + " to " + print_real(declared.max);
    case MUSTER_FLAG:
      return "true or false";
    case MUSTER_CHOICE:
      return expected_one_of(choices(declared)).substr(9);
    case MUSTER_REFERENCE:
      return std::string("the name of a ") + declared.text;
    case MUSTER_FILE:
      return "a path relative to the world file";
    default:
      return "a text";
  }
}

std::vector<double> attribute_values(const muster_param& declared, int count, const XmlAttribute& given,
                                     const FindRow& find_row, const Warn& warn) {
  switch (declared.kind) {
    case MUSTER_REAL: {
      const auto n = static_cast<std::size_t>(count);
      const auto values = parse_reals(given.value, n);
      if (!values || (count == 1 && !parse_real(given.value)))
        refuse(declared, count, given, count == 1 ? why_not_real(given.value) : why_not_reals(given.value, n),
               other_unit_hint(declared.unit, given.value) + corners_hint(declared, n, given.value) +
                   as_meant(given, count == 1 ? "" : reals_as_meant(given.value, n)));
      for (const double value : *values) check_bounds(declared, count, given, value, warn);
      return *values;
    }
    case MUSTER_INTEGER: {
      const auto value = parse_integer(given.value);
      if (!value) refuse(declared, count, given, why_not_integer(given.value));
      check_bounds(declared, count, given, static_cast<double>(*value), warn);
      return {static_cast<double>(*value)};
    }
    case MUSTER_FLAG:
      if (given.value != "true" && given.value != "false")
        refuse(declared, count, given, quote(given.value) + " is neither", as_meant(given, flag_as_meant(given.value)));
      return {given.value == "true" ? 1.0 : 0.0};
    case MUSTER_CHOICE:
      return {choice_value(declared, given)};
    case MUSTER_REFERENCE:
      return {find_row(declared.text, given.value, given.value_place)};
    default:
      return {};
  }
}

std::string value_text(const muster_param& declared, double value) {
  if (declared.kind == MUSTER_FLAG) return value != 0 ? "true" : "false";
  if (declared.kind == MUSTER_CHOICE) return choices(declared).at(static_cast<std::size_t>(value));
  return print_real(value);
}

}  // namespace muster
