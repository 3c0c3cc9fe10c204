// Values in the names of files: run_{distance}m_ch{channel}.csv.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "text/error.hpp"

namespace muster::diagnosis {

class FileNamePattern {
 public:
  FileNamePattern() = default;  // of any name, without parts
  // Throws Error for a pattern without parts, with two parts side by side, or with a part twice.
  FileNamePattern(const std::string& text, const Place& place);

  bool has(const std::string& part) const;
  // Each part's text; the shortest that fits, from left to right. Throws Error, at the pattern's place, for a name that
  // does not fit.
  std::map<std::string, std::string> parts_of(const std::string& name) const;

 private:
  std::string text_;
  Place place_;
  std::vector<std::string> names_, literals_;  // literals_[k] stands before names_[k], the last one at the end
};

}  // namespace muster::diagnosis
