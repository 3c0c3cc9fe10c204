// An XML file as a plain tree in which every name and value has its place. Nothing in the file is silently ignored.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "error.hpp"

namespace muster {

struct XmlAttribute {
  std::string name;
  std::string value;  // with its references, such as &lt;, replaced
  Place place;
  Place value_place;  // of the first character inside the quotes
};

struct XmlElement {
  std::string name;
  Place place;  // of the '<'
  std::vector<XmlAttribute> attributes;
  std::vector<XmlElement> children;

  // Null if there is no attribute of that name.
  const XmlAttribute* attribute(std::string_view wanted) const;
};

// Called with the root element's name before the rest of the file is read; throws where it is another than expected.
using CheckRoot = void (*)(const std::string& name, const Place& place);

// What to write in the place of a text that stands in an element: called with the start tags of the elements that are
// open there, without their brackets, the root first; "" for what is said of any file.
using InPlaceOfText = std::function<std::string(const std::vector<std::string_view>& open, std::string_view text)>;

// As the value of an attribute or the text of an element.
std::string xml_escaped(std::string_view text);

// The root element of a file of UTF-8 text, of at most 16 MB. Throws Error with file, line and column of the fault.
XmlElement read_xml(const std::filesystem::path& path, CheckRoot check_root = nullptr,
                    const InPlaceOfText& in_place_of_text = {});

}  // namespace muster
