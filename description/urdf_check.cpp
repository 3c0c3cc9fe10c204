#include "description/urdf_check.hpp"

#include <algorithm>
#include <stdexcept>

#include "description/file_text.hpp"

namespace muster::description {

using tinyxml2::XMLElement;

namespace {

constexpr std::size_t max_links = 10000;

// Attributes of numbers: how many they hold, and whether urdfdom would drop the whole element without them.
struct Numbers {
  const char *element, *attribute;
  std::size_t count;
  bool needed;
};
constexpr Numbers numbers[] = {
    {"origin", "xyz", 3, false},     {"origin", "rpy", 3, false},       {"axis", "xyz", 3, true},
    {"mass", "value", 1, true},      {"inertia", "ixx", 1, true},       {"inertia", "ixy", 1, true},
    {"inertia", "ixz", 1, true},     {"inertia", "iyy", 1, true},       {"inertia", "iyz", 1, true},
    {"inertia", "izz", 1, true},     {"box", "size", 3, true},          {"sphere", "radius", 1, true},
    {"cylinder", "radius", 1, true}, {"cylinder", "length", 1, true},   {"mesh", "scale", 3, false},
    {"limit", "lower", 1, false},    {"limit", "upper", 1, false},      {"limit", "effort", 1, true},
    {"limit", "velocity", 1, true},  {"dynamics", "damping", 1, false}, {"dynamics", "friction", 1, false},
};

// SDF's <mass>5</mass> and <axis><xyz>0 0 1</xyz></axis>, where URDF has an attribute; else the words given.
std::string missing_number(const XMLElement& element, const Numbers& rule, const std::string& owner,
                           const std::string& otherwise) {
  const XMLElement* inside = element.FirstChildElement(rule.attribute);
  const char* text = inside ? inside->GetText() : element.GetText();
  if (!text) return otherwise;
  const auto values = parse_numbers(text);
  if (!values || values->size() != rule.count) return otherwise;
  const std::string own(text);
  const auto first = own.find_first_not_of(" \t\r\n"), last = own.find_last_not_of(" \t\r\n");
  const std::string value = own.substr(first, last - first + 1);
  return owner + ": <" + rule.element + "> has the text " +
         (inside ? "of <" + std::string(rule.attribute) + "> " : "") + "\"" + value + "\", as in SDF; expected <" +
         rule.element + " " + rule.attribute + "=\"" + value + "\"/>";
}

void check_numbers(const Source& source, const XMLElement& element, const std::string& owner) {
  for (const Numbers& rule : numbers) {
    if (element.Name() != std::string(rule.element)) continue;
    const char* text = element.Attribute(rule.attribute);
    const std::string what = owner + ": <" + rule.element + "> " + rule.attribute;
    const std::string expected = rule.count == 1 ? "a number" : std::to_string(rule.count) + " numbers";
    if (!text && rule.needed)
      source.fail(element.GetLineNum(),
                  missing_number(element, rule, owner, what + " is missing; expected " + expected));
    if (!text) continue;
    const auto values = parse_numbers(text);
    if (!values || values->size() != rule.count) {
      source.fail(element.GetLineNum(), what + "=\"" + text + "\" is wrong; expected " + expected);
    }
  }
  if (element.Name() == std::string("geometry")) {
    const XMLElement* first = element.FirstChildElement();
    if (const XMLElement* second = first ? first->NextSiblingElement() : nullptr)
      source.fail(second->GetLineNum(),
                  owner + ": <geometry> has a <" + first->Name() + "> and a <" + second->Name() +
                      ">, of which URDF reads the first alone; expected one shape, and another <" +
                      element.Parent()->Value() + "> for each more");
  }
  if (element.Name() == std::string("collision") && !element.FirstChildElement("geometry"))
    source.fail(element.GetLineNum(), owner + ": <collision> has no <geometry>");
  for (const auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement()) {
    check_numbers(source, *child, owner);
  }
}

void check_inertial(const Source& source, const XMLElement& link, const std::string& name, Outline& outline) {
  const XMLElement* inertial = link.FirstChildElement("inertial");
  if (!inertial) return;
  for (const char* part : {"mass", "inertia"}) {
    if (!inertial->FirstChildElement(part)) {
      source.fail(inertial->GetLineNum(), "link '" + name + "': <inertial> has no <" + part + ">");
    }
  }
  outline.mass_lines[name] = inertial->FirstChildElement("mass")->GetLineNum();
}

struct Edge {
  std::string joint, parent, child;
  int line;
};

Edge joint_edge(const Source& source, const XMLElement& joint, const std::string& name) {
  const auto end = [&](const char* which) {
    const XMLElement* element = joint.FirstChildElement(which);
    if (!element) source.fail(joint.GetLineNum(), "joint '" + name + "' has no <" + which + ">");
    return required(source, *element, "link");
  };
  return {name, end("parent"), end("child"), joint.GetLineNum()};
}

void check_joint(const Source& source, const XMLElement& joint, const std::string& name) {
  const std::string type = required(source, joint, "type");
  const std::vector<std::string> types = {"fixed", "revolute", "continuous", "prismatic", "floating", "planar"};
  if (type == "ball" || type == "spherical") {
    source.fail(joint.GetLineNum(), "joint '" + name + "': URDF has no type '" + type +
                                        "'; expected type 'floating' and <muster><ball joint=\"" + name +
                                        "\"/></muster>");
  }
  if (std::find(types.begin(), types.end(), type) == types.end()) {
    source.fail(joint.GetLineNum(),
                "joint '" + name + "': type '" + type +
                    "' is not known; expected fixed, revolute, continuous, prismatic, floating or planar" +
                    nearest(type, types));
  }
  if ((type == "revolute" || type == "prismatic") && !joint.FirstChildElement("limit")) {
    source.fail(joint.GetLineNum(), "joint '" + name + "' has no <limit>; a " + type + " joint needs one");
  }
  if (const XMLElement* mimic = joint.FirstChildElement("mimic")) {
    const bool itself = required(source, *mimic, "joint") == name;
    source.fail(mimic->GetLineNum(),
                "joint '" + name + "': " +
                    (itself ? "mimics itself" : "<mimic> is not supported; leave it out: the joint then moves freely"));
  }
}

// The one link that is in no joint; "" if there is none, or more than one.
std::string unjoined(const std::vector<Edge>& edges, const Outline& outline) {
  std::string found;
  for (const auto& [link, line] : outline.link_lines) {
    const bool is_in_one = std::any_of(
        edges.begin(), edges.end(), [&, &name = link](const Edge& e) { return e.child == name || e.parent == name; });
    if (is_in_one) continue;
    if (!found.empty()) return "";
    found = link;
  }
  return found;
}

// True if the parents of both joints are nobody's children: links that hang on one, written the other way round.
bool are_turned(const std::vector<Edge>& edges, const Edge& one, const Edge& other) {
  const auto hangs = [&](const std::string& link) {
    return std::any_of(edges.begin(), edges.end(), [&](const Edge& each) { return each.child == link; });
  };
  return one.parent != other.parent && !hangs(one.parent) && !hangs(other.parent);
}

// Checks that links have one parent, and that all exist.
std::map<std::string, Edge> parents(const Source& source, const std::vector<Edge>& edges, const Outline& outline) {
  std::map<std::string, Edge> parent_of;
  std::vector<std::string> links;
  for (const auto& [link, line] : outline.link_lines) links.push_back(link);
  for (const Edge& edge : edges) {
    for (const std::string& link : {edge.child, edge.parent}) {
      if (!outline.link_lines.count(link))
        source.fail(edge.line, "joint '" + edge.joint + "': link '" + link + "' is not known" + nearest(link, links));
    }
    const auto [other, added] = parent_of.emplace(edge.child, edge);
    if (!added) {
      const std::string left = unjoined(edges, outline);
      source.fail(edge.line, "link '" + edge.child + "' is the <child> of two joints, '" + other->second.joint +
                                 "' (line " + std::to_string(other->second.line) + ") and '" + edge.joint +
                                 "'; expected one" +
                                 (are_turned(edges, edge, other->second)
                                      ? ": are <parent> and <child> exchanged? expected <parent link=\"" + edge.child +
                                            "\"/> and <child link=\"" + edge.parent + "\"/>"
                                  : left.empty() ? ""
                                                 : ": link '" + left + "' is in no joint; is it meant here?"));
    }
  }
  return parent_of;
}

using Children = std::map<std::string, std::vector<const Edge*>>;

std::size_t links_below(const std::string& root, const Children& children) {
  std::vector<std::string> reached = {root};
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const auto found = children.find(reached[i]);
    if (found == children.end()) continue;
    for (const Edge* edge : found->second) reached.push_back(edge->child);
  }
  return reached.size() - 1;
}

// Links without a parent, the one that most others hang on first: what hangs on no joint has few.
std::vector<std::string> roots_of(const Outline& outline, const Children& children,
                                  const std::map<std::string, Edge>& parent_of) {
  std::vector<std::string> roots;
  for (const auto& [link, line] : outline.link_lines) {
    if (!parent_of.count(link)) roots.push_back(link);
  }
  std::stable_sort(roots.begin(), roots.end(), [&](const std::string& a, const std::string& b) {
    return links_below(a, children) > links_below(b, children);
  });
  return roots;
}

// Orders the joints from the root outwards; links not reached are on a cycle.
void order_tree(const Source& source, const std::vector<Edge>& edges, Outline& outline) {
  const auto parent_of = parents(source, edges, outline);
  Children children;
  for (const Edge& edge : edges) children[edge.parent].push_back(&edge);
  const std::vector<std::string> roots = roots_of(outline, children, parent_of);
  if (roots.size() > 1)
    source.fail(outline.link_lines.at(roots[1]), "link '" + roots[1] + "' is a second root beside '" + roots[0] +
                                                     "'; expected one tree: a <joint> with <child link=\"" + roots[1] +
                                                     "\"/>");
  if (!roots.empty()) outline.root = roots[0];
  if (outline.root.empty())
    source.fail(outline.link_lines.begin()->second, "every link has a parent: the joints form a cycle");
  std::vector<std::string> reached = {outline.root};
  for (std::size_t i = 0; i < reached.size(); ++i) {
    for (const Edge* edge : children[reached[i]]) {
      outline.order.push_back(edge->joint);
      reached.push_back(edge->child);
    }
  }
  if (reached.size() == outline.link_lines.size()) return;
  for (const auto& [link, line] : outline.link_lines) {
    if (std::find(reached.begin(), reached.end(), link) == reached.end()) {
      source.fail(line, "link '" + link + "' is on a cycle of joints; expected one tree from '" + outline.root + "'");
    }
  }
}

void add_name(const Source& source, std::map<std::string, int>& lines, const XMLElement& element,
              const std::string& name) {
  const auto [known, added] = lines.emplace(name, element.GetLineNum());
  if (added) return;
  source.fail(element.GetLineNum(), std::string(element.Name()) + " '" + name + "' is there twice; first in line " +
                                        std::to_string(known->second) + "; expected another name for one of them");
}

}  // namespace

void Source::fail(int line, const std::string& message) const {
  throw std::runtime_error(file + ":" + std::to_string(line) + ": " + message);
}

std::string tag(const XMLElement& element) { return std::string("<") + element.Name() + "> "; }

std::string required(const Source& source, const XMLElement& element, const char* attribute) {
  const char* text = element.Attribute(attribute);
  if (!text || !*text) {
    const std::string name = element.Name(), inside = element.GetText() ? element.GetText() : "";
    const bool is_word = !inside.empty() && inside.find_first_of(" \t\r\n\"<") == inside.npos;
    source.fail(element.GetLineNum(),
                "<" + name + "> has no attribute '" + attribute + "'" +
                    (is_word ? "; expected <" + name + ' ' + attribute + "=\"" + inside + "\"/>" : ""));
  }
  return text;
}

double positive(const Source& source, const XMLElement& element, const char* attribute) {
  const std::string text = required(source, element, attribute);
  const auto value = parse_number(text);
  if (!value || !(*value > 0)) {
    source.fail(element.GetLineNum(),
                tag(element) + attribute + "=\"" + text + "\" is wrong; expected a number above 0");
  }
  return *value;
}

// Colours of a <material> of the robot, which urdfdom refuses in other words.
void check_colours(const Source& source, const XMLElement& element) {
  const char* text = element.Name() == std::string("color") ? element.Attribute("rgba") : nullptr;
  const auto values = parse_numbers(text ? text : "");
  const auto is_off = [](double value) { return !(value >= 0 && value <= 1); };
  if (text && (!values || values->size() != 4 || std::any_of(values->begin(), values->end(), is_off)))
    source.fail(element.GetLineNum(), "<color> rgba=\"" + std::string(text) + "\": expected four numbers from 0 to 1");
  for (const auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement())
    check_colours(source, *child);
}

Outline check_urdf(const Source& source, const XMLElement& robot) {
  const std::vector<std::string> known = {"link",   "joint",        "material", "muster",
                                          "gazebo", "transmission", "sensor",   "ros2_control"};
  only_attributes(source, robot, {"name", "version", "verbose"});
  Outline outline;
  std::vector<Edge> edges;
  for (const auto* element = robot.FirstChildElement(); element; element = element->NextSiblingElement()) {
    const std::string kind = element->Name();
    if (std::find(known.begin(), known.end(), kind) == known.end()) {
      source.fail(element->GetLineNum(), "<" + kind + "> is not known in <robot>" + nearest(kind, known));
    }
    if (kind != "link" && kind != "joint") continue;
    const std::string name = required(source, *element, "name");
    add_name(source, kind == "link" ? outline.link_lines : outline.joint_lines, *element, name);
    check_names(source, *element);
    check_numbers(source, *element, kind + " '" + name + "'");
    if (kind == "link") {
      check_inertial(source, *element, name, outline);
      continue;
    }
    check_joint(source, *element, name);
    edges.push_back(joint_edge(source, *element, name));
  }
  if (outline.link_lines.empty()) source.fail(robot.GetLineNum(), "has no links");
  for (const auto* each = robot.FirstChildElement(); each; each = each->NextSiblingElement()) {
    const std::string kind = each->Name();
    if (kind == "material") check_colours(source, *each);
  }
  if (outline.link_lines.size() > max_links) source.fail(robot.GetLineNum(), "has more than 10000 links");
  order_tree(source, edges, outline);
  return outline;
}

}  // namespace muster::description
