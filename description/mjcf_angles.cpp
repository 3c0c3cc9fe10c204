// Turns of a MuJoCo model that look like those of the other unit, degrees or radians.
#include <algorithm>
#include <cmath>

#include "description/file_text.hpp"
#include "description/mjcf.hpp"

namespace muster::description::mjcf {

using tinyxml2::XMLElement;

namespace {

constexpr double turn = 6.283185307179586, degree = turn / 360;
// An angle this near to a multiple of an eighth of a turn in radians is one, cut short: 0.785, 1.57, 3.1416.
constexpr double rounded = 0.002;

bool looks_like_radians(double angle) {
  constexpr double eighth = turn / 8;
  const double eighths = std::round(angle / eighth);
  return angle != std::round(angle) && eighths != 0 && std::abs(eighths) <= 16 &&
         std::abs(angle - eighths * eighth) < rounded;
}

// "left_wheel" of the body around an element; "" beyond all.
std::string body_around(const XMLElement& element) {
  for (const auto* each = element.Parent(); each; each = each->Parent()) {
    const auto* body = each->ToElement();
    if (body && body->Name() == std::string("body") && body->Attribute("name"))
      return std::string(" of body '") + body->Attribute("name") + "'";
  }
  return "";
}

class Angles {
 public:
  Angles(const Source& source, bool in_degrees) : source_(source), in_degrees_(in_degrees) {}

  void look(const XMLElement& element) {
    for (const char* attribute : {"euler", "axisangle"}) {
      const char* given = element.Attribute(attribute);
      if (const auto values = given ? parse_numbers(given) : std::nullopt) check(element, attribute, *values);
    }
    for (const auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement()) look(*child);
  }

  // What looks like radians is said once: a file has one unit.
  void tell(std::vector<std::string>& warnings) const {
    if (!first_.empty())
      warnings.push_back(
          first_ + (more_ ? (more_ == 1 ? "; so is 1 more" : "; so are " + std::to_string(more_) + " more") : ""));
    warnings.insert(warnings.end(), beyond_.begin(), beyond_.end());
  }

 private:
  void check(const XMLElement& element, const std::string& attribute, const std::vector<double>& values) {
    const std::size_t from = attribute == "euler" ? 0 : values.size() - std::min<std::size_t>(values.size(), 1);
    const auto any = [&](const auto& is) {
      return std::any_of(values.begin() + static_cast<std::ptrdiff_t>(from), values.end(), is);
    };
    // The angles in the unit that the file has.
    std::string meant;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double other = i < from      ? values[i]
                           : in_degrees_ ? std::round(values[i] / degree * 10) / 10
                                         : values[i] * degree;
      meant += (meant.empty() ? "" : " ") + print_number(other);
    }
    const std::string begin = source_.file + ":" + std::to_string(element.GetLineNum()) + ": <" + element.Name() + ">" +
                              body_around(element) + ": " + attribute + "=\"" + element.Attribute(attribute.c_str()) +
                              "\" ";
    if (in_degrees_ && any(looks_like_radians)) {
      if (first_.empty())
        first_ = begin + "is in degrees, MuJoCo's default, and looks like radians; expected " + attribute + "=\"" +
                 meant + "\", or <compiler angle=\"radian\"/> of all angles";
      else
        ++more_;
    }
    if (!in_degrees_ && any([](double angle) { return std::abs(angle) > turn; }))
      beyond_.push_back(begin +
                        "is beyond a whole turn in radians, which the file has (angle=\"radian\"); are these "
                        "degrees? expected " +
                        attribute + "=\"" + meant + "\", or <compiler angle=\"degree\"/> of all angles");
  }

  const Source& source_;
  const bool in_degrees_;
  std::string first_;
  std::size_t more_ = 0;
  std::vector<std::string> beyond_;
};

}  // namespace

void warn_of_angles(const Source& source, const Values& values, const XMLElement& root,
                    std::vector<std::string>& warnings) {
  Angles angles(source, values.angle(1) != 1);
  angles.look(root);
  angles.tell(warnings);
}

}  // namespace muster::description::mjcf
