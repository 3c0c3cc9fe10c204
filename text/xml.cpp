#include "xml.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "text_file.hpp"
#include "xml_scan.hpp"

namespace muster {
namespace {

constexpr std::uint64_t most_of_xml = 16 << 20;

// Joins the parsed tree with the places from the scan; both are in document order.
class Join {
 public:
  Join(const std::string& file, const std::vector<XmlSpot>& spots) : file_(file), spots_(spots) {}

  XmlElement element(const tinyxml2::XMLElement& from) {
    XmlElement result{from.Name(), next(), {}, {}};
    for (const auto* a = from.FirstAttribute(); a != nullptr; a = a->Next()) {
      XmlAttribute attribute{a->Name(), a->Value(), next(), next()};
      result.attributes.push_back(std::move(attribute));
    }
    for (const auto* child = from.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      result.children.push_back(element(*child));
    }
    return result;
  }

  bool complete() const { return next_ == spots_.size(); }

 private:
  Place next() {
    const XmlSpot& spot = spots_.at(next_++);
    return {file_, spot.line, spot.column};
  }

  const std::string& file_;
  const std::vector<XmlSpot>& spots_;
  std::size_t next_ = 0;
};

}  // namespace

const XmlAttribute* XmlElement::attribute(std::string_view wanted) const {
  const auto found =
      std::find_if(attributes.begin(), attributes.end(), [&](const auto& a) { return a.name == wanted; });
  return found == attributes.end() ? nullptr : &*found;
}

XmlElement read_xml(const std::filesystem::path& path, CheckRoot check_root, const InPlaceOfText& in_place_of_text) {
  const TextFile file = read_text_file(path, most_of_xml);
  if (file.text.empty()) throw invalid({file.file}, "is empty; expected an XML element");
  const std::vector<XmlSpot> spots = scan_xml(file, check_root, in_place_of_text);
  tinyxml2::XMLDocument document;
  if (document.Parse(file.text.data(), file.text.size()) != tinyxml2::XML_SUCCESS) {
    throw invalid({file.file, document.ErrorLineNum()}, std::string("is not well-formed XML: ") + document.ErrorName());
  }
  Join join(file.file, spots);
  XmlElement root = join.element(*document.RootElement());
  if (!join.complete()) throw Error(Exit::internal, root.place, "the scan and the parser disagree about this file");
  return root;
}

std::string xml_escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '"')
      result += "&quot;";
    else if (c == '\'')
      result += "&apos;";
    else
      result += c;
  }
  return result;
}

}  // namespace muster
