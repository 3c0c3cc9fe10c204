#include <algorithm>

#include "description/body_doubts.hpp"
#include "description/file_text.hpp"
#include "description/mjcf.hpp"
#include "description/urdf_check.hpp"
#include "description/urdf_inertia.hpp"
#include "description/urdf_links.hpp"

namespace muster::description {

namespace {

constexpr std::size_t max_file = 16u << 20;  // bytes

// Requires a mass of every moving link: without one no engine can move it.
void check_moving_masses(const Source& source, const Outline& outline, const Robot& robot) {
  for (const Joint& joint : robot.joints) {
    if (joint.kind == JointKind::fixed || rigid_mass(robot, joint.child).mass > 0) continue;
    const std::string& link = robot.links[joint.child].name;
    source.fail(outline.link_lines.at(link),
                "link '" + link + "' moves by joint '" + joint.name + "' but has no <inertial>");
  }
}

// A body that has a shape and weighs nothing: its links, but for wheels and limbs, have no <inertial> among them.
void warn_of_weightless_body(const Source& source, const Outline& outline, Robot& robot) {
  const bool has_mass =
      std::any_of(robot.links.begin(), robot.links.end(), [](const Link& l) { return l.mass.mass > 0; });
  if (!has_mass || rigid_mass(robot, 0).mass > 0) return;  // nothing has a mass: a robot to look at
  std::vector<bool> is_body(robot.links.size(), false);
  is_body[0] = true;
  for (const Joint& joint : robot.joints)
    is_body[joint.child] = joint.kind == JointKind::fixed && is_body[joint.parent];
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const Link& link = robot.links[i];
    if (!is_body[i] || link.shapes.empty()) continue;
    robot.warnings.push_back(source.file + ":" + std::to_string(outline.link_lines.at(link.name)) + ": link '" +
                             link.name +
                             "' has a collision shape and no <inertial>, so that the robot's body weighs nothing; " +
                             expected_mass(link.shapes));
    return;
  }
}

// Reads what stands beside links and joints: of the URDF itself, and of the file of fittings.
void read_extensions(const Source& source, const tinyxml2::XMLElement& root, Robot& robot) {
  for (const auto* sensor = root.FirstChildElement("sensor"); sensor; sensor = sensor->NextSiblingElement("sensor")) {
    read_sensor(source, *sensor, robot);
  }
  for (const auto* muster = root.FirstChildElement("muster"); muster; muster = muster->NextSiblingElement("muster")) {
    read_muster(source, *muster, robot);
  }
}

void check_fittings(const Source& source, const tinyxml2::XMLElement& root) {
  const std::vector<std::string> known = {"sensor", "gazebo", "muster"};
  for (const auto* element = root.FirstChildElement(); element; element = element->NextSiblingElement()) {
    const std::string name = element->Name();
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    source.fail(element->GetLineNum(), "<" + name + "> does not belong into fittings; expected <sensor>, <gazebo> or " +
                                           "<muster>" + nearest(name, known));
  }
}

}  // namespace

Robot read_robot(const std::string& path, Meshes meshes, const UrdfSetting& setting) {
  const Source source{path}, fittings{setting.fittings};
  const std::string text = read_file(path, max_file);
  tinyxml2::XMLDocument document, more;
  parse_xml(source, text, document);
  const bool is_mjcf = document.RootElement()->Name() == std::string("mujoco");
  if (!is_mjcf) document.Clear(), parse_urdf(source, text, document);
  const tinyxml2::XMLElement& root = *document.RootElement();
  Outline outline;
  Robot robot =
      is_mjcf ? read_mjcf(source, root, meshes, outline) : from_urdf(source, root, text, meshes, setting, outline);
  check_moving_masses(source, outline, robot);
  warn_of_weightless_body(source, outline, robot);
  snap_axes(source, outline, robot);
  if (!setting.fittings.empty()) {
    parse_urdf(fittings, read_file(setting.fittings, max_file), more);
    check_fittings(fittings, *more.RootElement());
    read_extensions(fittings, *more.RootElement(), robot);
  }
  if (!is_mjcf) read_extensions(source, root, robot);  // a <sensor> of MuJoCo is another
  if (more.RootElement()) read_gazebo(fittings, *more.RootElement(), robot);
  if (!is_mjcf) read_gazebo(source, root, robot);
  derive_drive(source, root, robot);
  if (!is_mjcf) warn_of_undriven(source, root, robot);
  if (more.RootElement()) warn_of_doubts(fittings, *more.RootElement(), robot);
  if (!is_mjcf) warn_of_doubts(source, root, robot);
  if (more.RootElement()) warn_of_blind_lasers(fittings, *more.RootElement(), robot);
  if (!is_mjcf) warn_of_blind_lasers(source, root, robot);
  warn_of_body(source, is_mjcf, meshes != Meshes::skip, robot);
  return robot;
}

}  // namespace muster::description
