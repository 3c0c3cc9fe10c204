#include "schema_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <map>

#include "text/number.hpp"
#include "text/xml.hpp"
#include "world_file/params.hpp"
#include "world_file/world.hpp"

namespace muster::cli {
namespace {

std::string documentation(const std::string& text) {
  return "<xs:annotation><xs:documentation>" + xml_escaped(text) + "</xs:documentation></xs:annotation>";
}

std::string facet(const char* name, const std::string& value) {
  return fmt::format("<xs:{} value=\"{}\"/>", name, xml_escaped(value));
}

std::string restriction(const std::string& base, const std::string& facets) {
  return "<xs:simpleType><xs:restriction base=\"" + base + "\">" + facets + "</xs:restriction></xs:simpleType>";
}

// Integers without an exponent, as XSD and muster write them.
std::string whole(double value) { return std::to_string(static_cast<std::int64_t>(value)); }

std::string words(const std::vector<std::string>& words) {
  std::string facets;
  for (const auto& word : words) facets += facet("enumeration", word);
  return restriction("xs:string", facets);
}

// Of one value, or of a list of `count` numbers.
std::string type_of(const muster_param& param, int count) {
  switch (param.kind) {
    case MUSTER_REAL: {
      std::string one = restriction(
          "real", facet("minInclusive", print_real(param.min)) + facet("maxInclusive", print_real(param.max)));
      if (count <= 1) return one;
      const std::string list = "<xs:simpleType><xs:list>" + one + "</xs:list></xs:simpleType>";
      return "<xs:simpleType><xs:restriction>" + list + facet("length", std::to_string(count)) +
             "</xs:restriction></xs:simpleType>";
    }
    case MUSTER_INTEGER:
      return restriction("xs:integer",
                         facet("minInclusive", whole(param.min)) + facet("maxInclusive", whole(param.max)));
    case MUSTER_FLAG:
      return words({"true", "false"});
    case MUSTER_CHOICE:
      return words(choices(param));
    case MUSTER_REFERENCE:
      return restriction("name", "");
    default:
      return restriction("xs:string", "");
  }
}

// Empty where there is none.
std::string default_of(const muster_param& param, int count) {
  if (param.flags & MUSTER_REQUIRED || param.kind == MUSTER_REFERENCE) return "";
  if (param.kind == MUSTER_TEXT || param.kind == MUSTER_FILE) return param.text ? param.text : "";
  std::string result = param.kind == MUSTER_INTEGER ? whole(param.value) : value_text(param, param.value);
  for (int i = 1; i < count; ++i) result += ' ' + value_text(param, param.value);
  return result;
}

std::string attribute_of(const muster_param& param, int count) {
  const std::string initial = default_of(param, count);
  std::string about = param.help;
  about += std::string("; ") + expectation(param, std::max(1, count));
  if (!initial.empty()) about += "; default " + initial;
  return fmt::format("      <xs:attribute name=\"{}\"{}{}>{}{}</xs:attribute>\n", param.name,
                     param.flags & MUSTER_REQUIRED ? " use=\"required\"" : "",
                     initial.empty() ? "" : " default=\"" + xml_escaped(initial) + '"', documentation(about),
                     type_of(param, count));
}

std::string attribute(const char* name, const char* type, const std::string& about, bool required = false) {
  return fmt::format("      <xs:attribute name=\"{}\" type=\"{}\"{}>{}</xs:attribute>\n", name, type,
                     required ? " use=\"required\"" : "", documentation(about));
}

std::string element(const std::string& name, const std::string& about, const std::string& content) {
  return "    <xs:element name=\"" + name + "\">" + documentation(about) + "<xs:complexType>\n" + content +
         "    </xs:complexType></xs:element>\n";
}

std::string standard_element(const Element& declared) {
  std::string content;
  if (!*declared.file_of) content += attribute("name", "name", "its name, by which others refer to it");
  for (const auto& one : declared.attributes) content += attribute_of(one.param, one.count);
  return element(declared.name, declared.help, content);
}

// Attributes of all revisions of a plugin; where they differ, as the newest has them.
std::string plugin_element(const Library& library) {
  const auto& revisions = library.plugins();
  std::string content = attribute("name", "name", "the instance's name; by default the plugin's") +
                        attribute("every", "xs:positiveInteger", "it steps every so many ticks") +
                        attribute("library", "xs:string", "its file, where it is not on the path of plugins") +
                        attribute("revision", "xs:positiveInteger", "the number after the slash in its id");
  std::set<std::string> known(reserved_attributes.begin(), reserved_attributes.end());
  for (auto plugin = revisions.rbegin(); plugin != revisions.rend(); ++plugin) {
    for (std::uint32_t i = 0; i < plugin->param_count; ++i) {
      muster_param param = plugin->params[i];
      if (plugin != revisions.rbegin()) param.flags &= ~std::uint32_t{MUSTER_REQUIRED};
      if (known.insert(param.name).second) content += attribute_of(param, 1);
    }
  }
  const muster_plugin& newest = revisions.back();
  return element(std::string(library.id()),
                 newest.summary + (newest.manual ? std::string(".\n") + newest.manual : std::string()), content);
}

// In <at> it has that one's time.
std::string swap_element(bool in_at) {
  return element(
      "swap", "exchanges the plugin of an instance during the run",
      "      <xs:group ref=\"plugins\" minOccurs=\"0\"/>\n" +
          (in_at ? "" : attribute("at", "time", "when, in s", true)) +
          attribute("instance", "xs:string", "the instance's name", true) +
          attribute("plugin", "xs:string", "the new plugin, whose attributes stand beside; or an element inside") +
          "      <xs:anyAttribute namespace=\"##local\" processContents=\"skip\"/>\n");
}

// Its rows may join a run.
bool joins(const Standard& standard, const Element& element) {
  return !*element.file_of && std::any_of(standard.sets.begin(), standard.sets.end(), [&](const auto& set) {
    return std::string(set.name) == element.set && set.kind == SetKind::live;
  });
}

std::string at_element(const Standard& standard) {
  const std::string set =
      element("set", "sets a number",
              attribute("path", "xs:string", "of a plugin or of the world: control.goal2d/x, door/d1/state", true) +
                  attribute("value", "xs:string", "as the attribute of that name is written", true));
  const std::string leave =
      element("leave", "a robot leaves, with its radio, or a station",
              attribute("robot", "name", "which robot") + attribute("station", "name", "which station"));
  const std::string removed =
      element("remove", "a plugin is removed", attribute("instance", "xs:string", "the instance's name", true));
  std::string joining;
  for (const auto& declared : standard.elements) {
    if (joins(standard, declared)) joining += standard_element(declared);
  }
  return element("at", "what happens at a time or on a condition: plugins change first, then the others in their order",
                 "      <xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">\n" + set + leave + joining +
                     swap_element(true) + removed + "      <xs:group ref=\"plugins\"/>\n      </xs:choice>\n" +
                     attribute("t", "time", "when, in s") +
                     attribute("when", "xs:string", "each time that this begins to hold: TABLE/COLUMN below NUMBER"));
}

std::string record_element() {
  return element("record", "a table that muster run --out writes",
                 attribute("table", "xs:string", "set/row/quantity, or set/*/quantity for all rows", true) +
                     attribute("every", "xs:positiveInteger", "every so many ticks"));
}

// No two rows of a set have one name.
std::string unique_names(const Standard& standard) {
  std::map<std::string, std::string> of_set;
  for (const auto& element : standard.elements) {
    if (*element.file_of) continue;
    std::string& elements = of_set[element.set];
    elements += (elements.empty() ? "" : "|") + std::string(element.name);
    if (joins(standard, element)) elements += "|at/" + std::string(element.name);
  }
  std::string result;
  for (const auto& [set, elements] : of_set)
    result += fmt::format(
        "    <xs:unique name=\"names_of_{0}\"><xs:selector xpath=\"{1}\"/><xs:field xpath=\"@name\"/></xs:unique>\n",
        set, elements);
  return result;
}

}  // namespace

std::string schema_text(const Standard& standard, const std::vector<std::shared_ptr<Library>>& plugins) {
  std::string elements, instances;
  for (const auto& declared : standard.elements) elements += standard_element(declared);
  for (const auto& library : plugins) instances += plugin_element(*library);
  if (plugins.empty()) instances = "    <xs:sequence/>\n";
  // A real is written in decimal: XSD has INF and NaN beside, and a plus sign.
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<!-- World files of muster, as `muster schema` writes it from the declarations of elements and plugins. -->\n"
         "<xs:schema xmlns:xs=\"http://www.w3.org/2001/XMLSchema\">\n"
         "  <xs:simpleType name=\"real\"><xs:restriction base=\"xs:double\">"
         "<xs:pattern value=\"-?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][+\\-]?[0-9]+)?\"/></xs:restriction></xs:simpleType>\n"
         "  <xs:simpleType name=\"name\"><xs:restriction base=\"xs:string\">"
         "<xs:pattern value=\"[A-Za-z0-9_.\\-]+\"/></xs:restriction></xs:simpleType>\n"
         "  <xs:simpleType name=\"time\"><xs:restriction base=\"real\"><xs:minInclusive "
         "value=\"0\"/></xs:restriction></xs:simpleType>\n"
         "  <xs:simpleType name=\"tick\"><xs:restriction base=\"real\"><xs:minInclusive "
         "value=\"1e-9\"/></xs:restriction></xs:simpleType>\n"
         "  <xs:group name=\"plugins\"><xs:choice>\n" +
         instances + "  </xs:choice></xs:group>\n  <xs:element name=\"world\">" +
         documentation("a world: robots, radios, walls, and the plugins that run them") +
         "<xs:complexType>\n    <xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">\n" + elements +
         at_element(standard) + swap_element(false) + record_element() +
         "    <xs:group ref=\"plugins\"/>\n    </xs:choice>\n" +
         attribute("name", "xs:string", "its name; by default that of its folder") +
         attribute("dt", "tick", "the tick in s; default 0.01") +
         attribute("until", "time", "the end of the run in s", true) +
         attribute("seed", "xs:nonNegativeInteger", "seed of all random numbers; default 1") + "  </xs:complexType>\n" +
         unique_names(standard) + "  </xs:element>\n</xs:schema>\n";
}

}  // namespace muster::cli
