// Names in a text attribute, with blanks between: radios, topics.
#pragma once

#include <algorithm>
#include <muster/plugin.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace muster {

// Throws BadInput where commas or semicolons part them, which no name has.
inline std::vector<std::string> names_in(const muster_host* host, const char* attribute) {
  const char* given = host->text(host, attribute);
  std::string text = given ? given : "";
  const auto parts = [](char c) { return c == ',' || c == ';'; };
  const bool has_commas = std::any_of(text.begin(), text.end(), parts);
  const std::string as_given = text;
  std::replace_if(text.begin(), text.end(), parts, ' ');
  std::istringstream words(text);
  std::vector<std::string> names;
  for (std::string name; words >> name;) names.push_back(name);
  if (!has_commas) return names;
  std::string meant;
  for (const std::string& name : names) meant += (meant.empty() ? "" : " ") + name;
  throw BadInput("attribute \"" + std::string(attribute) + "\": \"" + as_given +
                 "\" has commas between its names; expected blanks: " + attribute + "=\"" + meant + '"');
}

}  // namespace muster
