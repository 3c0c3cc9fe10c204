// Parses a URDF's text as XML, or reports place and reason of the fault.
#include <algorithm>

#include "description/urdf_check.hpp"

namespace muster::description {

using tinyxml2::XMLElement;

namespace {

constexpr std::size_t max_tag = 64u << 10;  // bytes; tinyxml2 takes quadratic time in the attributes of a tag

int line_at(const std::string& text, std::size_t position) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(position), '\n'));
}

bool starts(const std::string& text, std::size_t at, const char* what) {
  return text.compare(at, std::char_traits<char>::length(what), what) == 0;
}

std::size_t skip_to(const std::string& text, std::size_t from, const char* end) {
  return std::min(text.find(end, from), text.size());
}

// Calls `visit` with the place of each '<' except those in comments and character data, whose size does not matter; it
// returns where to continue.
template <class Visit>
void for_each_tag(const std::string& text, const Visit& visit) {
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
    if (starts(text, at, "<!--")) {
      at = skip_to(text, at, "-->");
    } else if (starts(text, at, "<![CDATA[")) {
      at = skip_to(text, at, "]]>");
    } else {
      at = visit(at);
    }
  }
}

void scan_tags(const Source& source, const std::string& text) {
  if (text.find('\0') != std::string::npos) source.fail(1, "is not text; expected UTF-8 XML");
  for_each_tag(text, [&](std::size_t at) {
    if (starts(text, at, "<!"))
      source.fail(line_at(text, at), "has a document type declaration; entities are not supported");
    if (skip_to(text, at, ">") - at > max_tag) source.fail(line_at(text, at), "a tag is longer than 65536 bytes");
    return at;
  });
}

// The '>' that ends the tag at `at`, or the text's end; a quoted value may contain one, too.
std::size_t end_of_tag(const std::string& text, std::size_t at) {
  char quote = 0;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (quote ? c == quote : c == '"' || c == '\'') quote = quote ? '\0' : c;
    if (!quote && c == '>') break;
  }
  return at;
}

// Checks that each closing tag closes the element opened last. For a mismatch the parser only reports where some
// element begins, and it accepts those behind the root in silence.
void check_pairs(const Source& source, const std::string& text) {
  struct Open {
    std::string name;
    std::size_t at;
  };
  std::vector<Open> open;
  for_each_tag(text, [&](std::size_t at) {
    if (starts(text, at, "<?")) return skip_to(text, at, "?>");
    const bool closes = starts(text, at, "</");
    const std::size_t from = at + (closes ? 2 : 1), end = end_of_tag(text, at);
    const std::string name = text.substr(from, text.find_first_of(" \t\r\n/>", from) - from);
    if (closes && open.empty()) source.fail(line_at(text, at), "is not XML: </" + name + "> closes nothing");
    if (closes && open.back().name != name) {
      // An element inside which another one's end comes is itself not closed; of several the first is told.
      const auto same = std::find_if(open.rbegin(), open.rend(), [&](const Open& each) { return each.name == name; });
      if (same != open.rend()) {
        const Open& first = *same.base();
        source.fail(line_at(text, first.at), "is not XML: <" + first.name + "> is not closed where </" + name +
                                                 "> comes, in line " + std::to_string(line_at(text, at)) +
                                                 "; expected \"/>\" at the end of the tag <" + first.name +
                                                 " ...>, or </" + first.name + ">");
      }
      const auto& [last, start] = open.back();
      source.fail(line_at(text, at), "is not XML: </" + name + "> does not match <" + last + "> of line " +
                                         std::to_string(line_at(text, start)) + "; expected </" + last + ">");
    }
    if (closes) {
      open.pop_back();
    } else if (text[end - 1] != '/') {
      open.push_back({name, at});
    }
    return end;
  });
  if (open.empty()) return;
  const auto& [last, start] = open.back();
  source.fail(line_at(text, start),
              "is not XML: <" + last + "> is not closed; expected </" + last + "> before the end of the file");
}

std::string words(const tinyxml2::XMLDocument& document) {
  switch (document.ErrorID()) {
    case tinyxml2::XML_ERROR_PARSING_ELEMENT:
      return "a tag is wrong or cut off; expected <NAME ATTRIBUTE=\"VALUE\"> or <NAME ATTRIBUTE=\"VALUE\"/>";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute is wrong; expected NAME=\"VALUE\", each once in a tag";
    case tinyxml2::XML_ERROR_PARSING_TEXT:
      return "a text is not closed; expected a tag after it";
    case tinyxml2::XML_ERROR_PARSING_CDATA:
      return "<![CDATA[ is not closed; expected ]]>";
    case tinyxml2::XML_ERROR_PARSING_COMMENT:
      return "a comment is not closed; expected -->";
    case tinyxml2::XML_ERROR_PARSING_DECLARATION:
      return "a declaration <? ?> is not closed, or not at the start of the file";
    default:
      return document.ErrorName();
  }
}

// A file that xacro has still to expand has elements of its namespace, or ${...} and $(...) in attributes. The
// namespace alone is left in files that it has written.
void refuse_xacro(const Source& source, const XMLElement& element) {
  const auto refuse = [&](const std::string& what) {
    source.fail(element.GetLineNum(),
                "is xacro, not URDF: it has " + what + "; run xacro first: xacro " + source.file + " > OUT.urdf");
  };
  if (starts(element.Name(), 0, "xacro:")) refuse(std::string("<") + element.Name() + ">");
  for (const auto* attribute = element.FirstAttribute(); attribute; attribute = attribute->Next()) {
    const std::string value = attribute->Value();
    for (const auto& [opens, closes] : {std::pair{"${", '}'}, std::pair{"$(", ')'}}) {
      const std::size_t at = value.find(opens);
      if (at == std::string::npos) continue;
      const std::size_t end = value.find(closes, at);
      refuse("\"" + value.substr(at, end == std::string::npos ? end : end - at + 1) + "\"");
    }
  }
  for (const auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement())
    refuse_xacro(source, *child);
}

// Of a file with another root element than <robot>: one of those that <robot> has in it may stand alone.
std::string other_root(const std::string& name) {
  if (name.empty()) return "is not URDF; expected <robot>";
  if (name == "sdf") return "is SDF, not URDF; expected <robot> with its <link> and <joint>: export the model as URDF";
  const std::vector<std::string> inside = {"muster", "sensor", "gazebo", "link", "joint", "transmission"};
  const bool is_inside = std::find(inside.begin(), inside.end(), name) != inside.end();
  return "<" + name + "> is the root element of this file, which is no URDF; expected <robot name=\"...\">" +
         (is_inside ? " around <" + name + ">" : "");
}

}  // namespace

void parse_xml(const Source& source, const std::string& text, tinyxml2::XMLDocument& document) {
  scan_tags(source, text);
  const tinyxml2::XMLError error = document.Parse(text.data(), text.size());
  const int line = std::max(1, document.ErrorLineNum());
  if (error == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED) source.fail(line, "elements are nested deeper than 100");
  if (error == tinyxml2::XML_ERROR_EMPTY_DOCUMENT) source.fail(1, "is empty; expected <robot>");
  const bool has_all_tags = error == tinyxml2::XML_SUCCESS || error == tinyxml2::XML_ERROR_PARSING ||
                            error == tinyxml2::XML_ERROR_MISMATCHED_ELEMENT;
  if (has_all_tags) check_pairs(source, text);
  const bool has_quotes = error == tinyxml2::XML_ERROR_PARSING_ATTRIBUTE &&
                          (text.find("=\u201C") != std::string::npos || text.find("=\u201D") != std::string::npos ||
                           text.find("=\u2019") != std::string::npos || text.find("=\u201E") != std::string::npos);
  if (has_quotes)
    source.fail(line,
                "is not XML: a value stands in typographic quotes, as word processors and web pages have them; "
                "expected straight ones: NAME=\"VALUE\"");
  if (error != tinyxml2::XML_SUCCESS) source.fail(line, "is not XML: " + words(document));
  if (!document.RootElement()) source.fail(1, "is not URDF; expected <robot>");
  if (const auto* second = document.RootElement()->NextSiblingElement())
    source.fail(second->GetLineNum(), "has a second root element");
}

void parse_urdf(const Source& source, const std::string& text, tinyxml2::XMLDocument& document) {
  parse_xml(source, text, document);
  const XMLElement* root = document.RootElement();
  if (!root || root->Name() != std::string("robot"))
    source.fail(root ? root->GetLineNum() : 1, other_root(root ? root->Name() : ""));
  refuse_xacro(source, *root);
}

}  // namespace muster::description
