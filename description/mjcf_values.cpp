#include <cmath>

#include "description/file_text.hpp"
#include "description/mjcf.hpp"

namespace muster::description::mjcf {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using tinyxml2::XMLElement;

Values::Values(const Source& source, const XMLElement& root) : source_(source) {
  classes_["main"];
  for (const auto* compiler = root.FirstChildElement("compiler"); compiler;
       compiler = compiler->NextSiblingElement("compiler")) {
    const auto text_of = [&](const char* name) { return compiler->Attribute(name) ? compiler->Attribute(name) : ""; };
    const std::string angle = text_of("angle"), euler = text_of("eulerseq"), inertia = text_of("inertiafromgeom");
    if (!angle.empty()) in_degrees_ = angle != "radian", states_angle_ = true;
    if (!euler.empty()) euler_ = euler;
    if (!inertia.empty()) inertia_from_shapes_ = inertia == "true";
    if (compiler->Attribute("meshdir")) mesh_folder_ = text_of("meshdir");
    if (std::string(text_of("coordinate")) == "global")
      source.fail(compiler->GetLineNum(), "<compiler> coordinate=\"global\" is not read; expected \"local\"");
  }
  for (const auto* one = root.FirstChildElement("default"); one; one = one->NextSiblingElement("default"))
    take_class(*one, "main");
}

// A class begins as the one around it.
void Values::take_class(const XMLElement& element, const std::string& parent) {
  const std::string name = element.Attribute("class") ? element.Attribute("class") : parent;
  if (name != parent) classes_[name] = classes_[parent];
  Class& own = classes_[name];
  for (const auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement()) {
    if (child->Name() == std::string("default")) continue;
    for (const auto* attribute = child->FirstAttribute(); attribute; attribute = attribute->Next())
      own[child->Name()][attribute->Name()] = attribute->Value();
  }
  for (const auto* child = element.FirstChildElement("default"); child; child = child->NextSiblingElement("default"))
    take_class(*child, name);
}

void Values::fail(const Element& element, const std::string& what) const {
  source_.fail(element.xml->GetLineNum(), std::string("<") + element.xml->Name() + "> " + what);
}

std::optional<std::string> Values::text(const Element& element, const char* attribute) const {
  if (const char* own = element.xml->Attribute(attribute)) return std::string(own);
  const char* declared = element.xml->Attribute("class");
  const std::string name = declared ? declared : element.child_class.empty() ? "main" : element.child_class;
  const auto found = classes_.find(name);
  if (found == classes_.end()) {
    std::vector<std::string> names;
    for (const auto& [known, ignored] : classes_) names.push_back(known);
    fail(element, "has a class '" + name + "' that no <default> has" + nearest(name, names));
  }
  const auto kind = found->second.find(element.xml->Name());
  if (kind == found->second.end()) return std::nullopt;
  const auto value = kind->second.find(attribute);
  return value == kind->second.end() ? std::nullopt : std::optional(value->second);
}

std::optional<std::vector<double>> Values::numbers(const Element& element, const char* attribute, std::size_t count,
                                                   std::size_t least) const {
  const auto given = text(element, attribute);
  if (!given) return std::nullopt;
  auto values = parse_numbers(*given);
  if (!values || values->size() > count || values->size() < (least > 0 ? least : count)) {
    const std::string numbers =
        least > 0 && least < count ? std::to_string(least) + " to " + std::to_string(count) : std::to_string(count);
    fail(element, std::string(attribute) + "=\"" + *given + "\" is wrong; expected " + numbers +
                      (count == 1 ? " number" : " numbers"));
  }
  return values;
}

double Values::number(const Element& element, const char* attribute, double otherwise) const {
  const auto values = numbers(element, attribute, 1);
  return values ? values->front() : otherwise;
}

Vector3d Values::vector(const Element& element, const char* attribute, const Vector3d& otherwise) const {
  const auto values = numbers(element, attribute, 3);
  return values ? Vector3d((*values)[0], (*values)[1], (*values)[2]) : otherwise;
}

// Small letters turn about the axes as they have been turned so far, capital ones about those at the start.
Matrix3d Values::turn_by_euler(const Element& element, const std::vector<double>& angles) const {
  Matrix3d result = Matrix3d::Identity();
  if (euler_.size() != 3) fail(element, "has euler=, but eulerseq=\"" + euler_ + "\" has not three letters");
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t axis = std::string("xyzXYZ").find(euler_[i]);
    if (axis == std::string::npos)
      fail(element, "has euler=, but eulerseq=\"" + euler_ + "\" has other letters than xyzXYZ");
    const Matrix3d one =
        Eigen::AngleAxisd(angle(angles[i]), Vector3d::Unit(static_cast<Eigen::Index>(axis % 3))).toRotationMatrix();
    result = axis < 3 ? Matrix3d(result * one) : Matrix3d(one * result);
  }
  return result;
}

Matrix3d Values::turn(const Element& element) const {
  const auto no_length = [&](const char* what) { fail(element, std::string(what) + " has no length"); };
  if (const auto q = numbers(element, "quat", 4)) {
    const Quaterniond turned((*q)[0], (*q)[1], (*q)[2], (*q)[3]);
    if (!(turned.norm() > 0)) no_length("quat");
    return turned.normalized().toRotationMatrix();
  }
  if (const auto e = numbers(element, "euler", 3)) return turn_by_euler(element, *e);
  if (const auto a = numbers(element, "axisangle", 4)) {
    const Vector3d axis((*a)[0], (*a)[1], (*a)[2]);
    if (!(axis.norm() > 0)) no_length("axisangle");
    return Eigen::AngleAxisd(angle((*a)[3]), axis.normalized()).toRotationMatrix();
  }
  if (const auto a = numbers(element, "xyaxes", 6)) {
    const Vector3d x = Vector3d((*a)[0], (*a)[1], (*a)[2]).normalized();
    Vector3d y((*a)[3], (*a)[4], (*a)[5]);
    y = (y - x * x.dot(y)).normalized();
    Matrix3d result;
    result << x, y, x.cross(y);
    return result;
  }
  if (const auto z = numbers(element, "zaxis", 3))
    return Quaterniond::FromTwoVectors(Vector3d::UnitZ(), Vector3d((*z)[0], (*z)[1], (*z)[2])).toRotationMatrix();
  return Matrix3d::Identity();
}

Eigen::Isometry3d Values::frame(const Element& element) const {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translation() = vector(element, "pos", Vector3d::Zero());
  result.linear() = turn(element);
  return result;
}

}  // namespace muster::description::mjcf
