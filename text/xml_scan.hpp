// Scans the bytes of an XML file before tinyxml2 parses them. Refuses input that tinyxml2 accepts in silence (entities,
// text, a second root, `&#0;`) or parses in quadratic time (40,000 attributes). Finds the columns, which tinyxml2 does
// not keep.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "text_file.hpp"
#include "xml.hpp"

namespace muster {

struct XmlSpot {
  int line;
  int column;
};

// Thrown by an InPlaceOfText where not the text is wrong, but an element around it: told at its place.
struct FaultOfElement {
  std::size_t depth;  // of the open elements, from 0
  std::string what;
};

// In document order: each element's '<', then the name and the value of each of its attributes.
std::vector<XmlSpot> scan_xml(const TextFile& file, CheckRoot check_root, const InPlaceOfText& in_place_of_text);

}  // namespace muster
