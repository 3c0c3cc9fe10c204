// Checks names of elements and attributes: a misspelt name is an error, not dropped as by urdfdom.
#include <algorithm>
#include <sstream>

#include "description/file_text.hpp"
#include "description/urdf_check.hpp"

namespace muster::description {

using tinyxml2::XMLElement;

namespace {

using Names = std::vector<std::string>;

struct Kind {
  Names attributes, elements;
};

// Elements and attributes of <link> and <joint> by http://wiki.ros.org/urdf/XML, except those of <visual>, which is not
// checked here.
const std::map<std::string, Kind>& kinds() {
  static const std::map<std::string, Kind> all = {
      {"link", {{"name", "type"}, {"inertial", "visual", "collision"}}},
      {"inertial", {{}, {"origin", "mass", "inertia"}}},
      {"mass", {{"value"}, {}}},
      {"inertia", {{"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}, {}}},
      {"collision", {{"name"}, {"origin", "geometry"}}},
      {"geometry", {{}, {"box", "cylinder", "sphere", "mesh"}}},
      {"box", {{"size"}, {}}},
      {"cylinder", {{"radius", "length"}, {}}},
      {"sphere", {{"radius"}, {}}},
      {"mesh", {{"filename", "scale"}, {}}},
      {"joint",
       {{"name", "type"},
        {"origin", "parent", "child", "axis", "calibration", "dynamics", "limit", "mimic", "safety_controller"}}},
      {"origin", {{"xyz", "rpy"}, {}}},
      {"parent", {{"link"}, {}}},
      {"child", {{"link"}, {}}},
      {"axis", {{"xyz"}, {}}},
      {"calibration", {{"rising", "falling", "reference_position"}, {}}},
      {"dynamics", {{"damping", "friction"}, {}}},
      {"limit", {{"lower", "upper", "effort", "velocity"}, {}}},
      {"mimic", {{"joint", "multiplier", "offset"}, {}}},
      {"safety_controller", {{"soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"}, {}}},
  };
  return all;
}

// "'a', 'b' or 'c'"
std::string listed(const Names& names, const char* before, const char* after) {
  std::string result;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) result += i + 1 < names.size() ? ", " : " or ";
    result += before + names[i] + after;
  }
  return result;
}

// A name of another namespace, "xmlns:xacro" or "xacro:once", is for other programs.
bool is_foreign(const std::string& name) { return name == "xmlns" || name.find(':') != std::string::npos; }

void check_geometry(const Source& source, const XMLElement& geometry) {
  const Names& known = kinds().at("geometry").elements;
  only_children(source, geometry, known);
  if (!geometry.FirstChildElement())
    source.fail(geometry.GetLineNum(), "<geometry> is empty; expected " + listed(known, "<", ">"));
}

}  // namespace

void only_attributes(const Source& source, const XMLElement& element, const Names& known) {
  for (const auto* attribute = element.FirstAttribute(); attribute; attribute = attribute->Next()) {
    const std::string name = attribute->Name();
    if (is_foreign(name) || std::find(known.begin(), known.end(), name) != known.end()) continue;
    std::string expected = nearest(name, known);
    if (expected.empty() && !known.empty()) expected = "; expected " + listed(known, "'", "'");
    source.fail(element.GetLineNum(), tag(element) + "has no attribute '" + name + "'" + expected);
  }
}

namespace {

// What SDF has as an element with a text and URDF as an attribute: `expected <axis xyz="0 0 1"/>`; "" for any other.
std::string as_attribute(const XMLElement& element, const XMLElement& child) {
  const auto kind = kinds().find(element.Name());
  const std::string name = child.Name(), text = child.GetText() ? child.GetText() : "";
  if (kind == kinds().end() || text.empty()) return "";
  const Names& attributes = kind->second.attributes;
  if (name == "pose" || std::find(attributes.begin(), attributes.end(), name) == attributes.end()) {
    if (name != "pose") return "";
    std::istringstream words(text);
    std::vector<std::string> numbers;
    for (std::string word; words >> word;) numbers.push_back(word);
    if (numbers.size() != 6) return "expected <origin xyz=\"X Y Z\" rpy=\"ROLL PITCH YAW\"/>";
    return "expected <origin xyz=\"" + numbers[0] + ' ' + numbers[1] + ' ' + numbers[2] + "\" rpy=\"" + numbers[3] +
           ' ' + numbers[4] + ' ' + numbers[5] + "\"/>";
  }
  return "expected <" + std::string(element.Name()) + ' ' + name + "=\"" + text + "\"/>";
}

}  // namespace

void only_children(const Source& source, const XMLElement& element, const Names& known, const Names& many) {
  std::set<std::string> seen;
  for (const auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement()) {
    const std::string name = child->Name();
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      if (const std::string remedy = as_attribute(element, *child); !remedy.empty())
        source.fail(child->GetLineNum(), tag(element) + "has no element <" + name + ">, as in SDF; " + remedy);
      const std::string expected = known.empty() ? "" : "; expected " + listed(known, "<", ">");
      source.fail(child->GetLineNum(),
                  tag(element) + "has no element <" + name + ">" + expected + nearest(name, known));
    }
    const bool may_repeat = std::find(many.begin(), many.end(), name) != many.end();
    if (!seen.insert(name).second && !may_repeat)
      source.fail(child->GetLineNum(), tag(element) + "has a second <" + name + ">");
  }
}

void check_names(const Source& source, const XMLElement& element) {
  const std::string name = element.Name();
  if (name == "visual") {  // urdfdom refuses unknown shapes, without a line number
    if (const XMLElement* geometry = element.FirstChildElement("geometry")) check_geometry(source, *geometry);
    return;
  }
  const Kind& kind = kinds().at(name);
  only_attributes(source, element, kind.attributes);
  only_children(source, element, kind.elements, {"visual", "collision"});
  if (name == "geometry") check_geometry(source, element);
  for (const auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement())
    check_names(source, *child);
}

}  // namespace muster::description
