// Attributes of elements in the files of missions and orders, and the files themselves.
#pragma once

#include <algorithm>
#include <filesystem>
#include <muster/plugin.hpp>
#include <optional>
#include <string>
#include <vector>

#include "plugins/other_kinds.hpp"
#include "plugins/world_folder.hpp"
#include "text/doubts.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/unit_words.hpp"
#include "text/xml.hpp"

namespace muster::missions {

[[noreturn]] inline void refuse(const Place& place, const std::string& what) {
  throw BadInput(place.text() + ": " + what);
}

inline void expect_attributes(const XmlElement& element, const std::vector<std::string>& valid) {
  for (const auto& given : element.attributes) {
    if (std::find(valid.begin(), valid.end(), given.name) == valid.end())
      refuse(given.place,
             "<" + element.name + "> has no attribute " + quote(given.name) + "; " + suggest(given.name, valid));
  }
}

inline const XmlAttribute& needed(const XmlElement& element, const char* name, const char* expected) {
  if (const auto* found = element.attribute(name)) return *found;
  refuse(element.place,
         "<" + element.name + "> has no attribute " + quote(name) + ", which it needs; expected " + expected);
}

inline double number(const XmlAttribute& given, double least, double most, const std::string& unit = "") {
  const auto value = parse_real(given.value);
  if (!value || !(*value >= least && *value <= most))
    refuse(given.value_place, "attribute " + quote(given.name) + ": " +
                                  (value ? given.value + " is out of bounds" : why_not_real(given.value)) +
                                  "; expected a number from " + print_real(least) + " to " + print_real(most) +
                                  (unit.empty() ? "" : ' ' + unit) +
                                  (value ? unit_hint(unit, *value, least, most) : other_unit_hint(unit, given.value)));
  return *value;
}

inline double number(const XmlElement& element, const char* name, double other, double least, double most) {
  const auto* given = element.attribute(name);
  return given ? number(*given, least, most) : other;
}

inline std::string text(const XmlElement& element, const char* name) {
  const auto* given = element.attribute(name);
  return given ? given->value : "";
}

// The root of the file that a parameter names: below the world's folder, the last in which files are looked for.
inline XmlElement read_file(const Setup& setup, const char* parameter) {
  const std::string given = setup.text(parameter);
  if (given.empty()) throw BadInput(std::string("has no attribute \"") + parameter + "\"; expected an XML file");
  const std::filesystem::path path(given);
  try {
    return read_xml(path.is_absolute() ? path : std::filesystem::path(world_folder(setup.host())) / path);
  } catch (const Error& e) {
    throw BadInput(e.what());
  }
}

// FNV-1a over names, values and nesting.
inline void mix(const XmlElement& element, uint64_t& hash) {
  const auto add = [&](const std::string& text) {
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    hash = (hash ^ 0x1f) * 0x100000001b3u;
  };
  add(element.name);
  for (const auto& attribute : element.attributes) add(attribute.name), add(attribute.value);
  for (const auto& child : element.children) mix(child, hash);
  add("/");
}

// Differs from that of any file of another content.
inline double mark_of(const XmlElement& root) {
  uint64_t hash = 0xcbf29ce484222325u;
  mix(root, hash);
  return static_cast<double>(hash >> 11);  // what a double holds
}

// The row of a radio, by its name at `place`.
inline double radio_row(const Setup& setup, const std::string& name, const Place& place) {
  const muster_host* host = setup.host();
  std::vector<std::string> valid;
  for (uint32_t row = 0; row < host->rows(host, "radio"); ++row) {
    valid.emplace_back(host->row_name(host, "radio", row));
    if (valid.back() == name) return row;
  }
  refuse(place, "no radio is called " + quote(name) + which_is_no_radio(host, name) + "; " + suggest(name, valid));
}

}  // namespace muster::missions
