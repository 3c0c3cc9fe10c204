#include "description/mjcf.hpp"

#include <algorithm>
#include <cmath>

#include "description/file_text.hpp"
#include "description/urdf_inertia.hpp"

namespace muster::description {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using mjcf::Values;
using tinyxml2::XMLElement;

namespace {

// Attributes of MuJoCo 2.2 that change nothing here: names, looks and solvers; those that do, but are not taken.
const std::vector<std::string> looks = {"name", "class",    "group",  "rgba",  "material",
                                        "user", "priority", "solmix", "margin"};

class Reader {
 public:
  Reader(const Source& source, const XMLElement& root, Meshes meshes, Outline& outline)
      : source_(source), root_(root), values_(source, root), meshes_(meshes), outline_(outline) {
    for (const auto* asset = root.FirstChildElement("asset"); asset; asset = asset->NextSiblingElement("asset")) {
      for (const auto* mesh = asset->FirstChildElement("mesh"); mesh; mesh = mesh->NextSiblingElement("mesh"))
        if (const char* name = mesh->Attribute("name")) mesh_assets_[name] = mesh;
    }
  }

  Robot read() {
    robot_.name = root_.Attribute("model") ? root_.Attribute("model") : "robot";
    robot_.file = source_.file;
    refuse_includes(root_);
    const Values::Element body{&the_body(), ""};
    // The robot's frame is on the ground below the body's, its axes are those of the world.
    Isometry3d frame = values_.frame(body);
    frame.translation().x() = frame.translation().y() = 0;
    add_root(body, frame);
    read_actuators();
    mjcf::warn_of_angles(source_, values_, root_, robot_.warnings);
    note_rest();
    warn();
    return std::move(robot_);
  }

 private:
  // A file put together from several.
  void refuse_includes(const XMLElement& element) {
    for (const auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement()) {
      if (child->Name() == std::string("include")) {
        source_.fail(child->GetLineNum(),
                     "<include> is not read; save the file as one with MuJoCo: compile " + source_.file + " OUT.xml");
      }
      refuse_includes(*child);
    }
  }

  // Of a <body> and all that it carries.
  static int joints_of(const XMLElement& body) {
    int result = 0;
    for (const auto* child = body.FirstChildElement(); child; child = child->NextSiblingElement()) {
      const std::string kind = child->Name();
      if (kind == "joint" || kind == "freejoint") ++result;
      if (kind == "body") result += joints_of(*child);
    }
    return result;
  }

  // Bodies beside the robot, which is the one that has most joints; where several have as many, it is not known.
  void refuse_scenery(const XMLElement& world) const {
    std::vector<const XMLElement*> bodies;
    for (const auto* one = world.FirstChildElement("body"); one; one = one->NextSiblingElement("body"))
      bodies.push_back(one);
    std::stable_sort(bodies.begin(), bodies.end(),
                     [](const auto* a, const auto* b) { return joints_of(*a) > joints_of(*b); });
    if (joints_of(*bodies[0]) == joints_of(*bodies[1])) return;
    const auto in_words = [](const XMLElement& body) {
      return body.Attribute("name") ? "'" + std::string(body.Attribute("name")) + "'" : "the <body>";
    };
    std::string rest;
    for (std::size_t i = 1; i < bodies.size(); ++i) {
      const int joints = joints_of(*bodies[i]);
      rest += (i == 1 ? "" : ", ") + in_words(*bodies[i]) + " (line " + std::to_string(bodies[i]->GetLineNum()) + ", " +
              (joints == 0   ? "no joints"
               : joints == 1 ? "one joint"
                             : std::to_string(joints) + " joints") +
              ")";
    }
    source_.fail(
        bodies[1]->GetLineNum(),
        "<worldbody> has " + std::to_string(bodies.size()) + " bodies; a model is one robot: expected " +
            in_words(*bodies[0]) + " alone; take out " + rest +
            (bodies.size() == 2 ? ", and put it into the world as" : ", and put them into the world, each as") +
            " a <mesh> or a <robot> of its own");
  }

  const XMLElement& the_body() {
    const auto* world = root_.FirstChildElement("worldbody");
    if (!world) source_.fail(root_.GetLineNum(), "has no <worldbody>; expected one with the robot's <body>");
    const auto* body = world->FirstChildElement("body");
    if (!body) source_.fail(world->GetLineNum(), "<worldbody> has no <body>; expected that of the robot");
    if (const auto* second = body->NextSiblingElement("body")) {
      refuse_scenery(*world);
      const char* name = second->Attribute("name");
      source_.fail(second->GetLineNum(),
                   "<worldbody> has a second <body>; a model is one robot: expected one <body>, and " +
                       (name ? "'" + std::string(name) + "'" : std::string("the other")) +
                       " as a <mesh> or a <robot> of its own in the world");
    }
    for (const auto* child = world->FirstChildElement(); child; child = child->NextSiblingElement()) {
      const std::string name = child->Name();
      if (name != "body" && name != "light" && name != "camera")
        not_taken_.insert("<" + name + "> of <worldbody> (a world has ground and walls of its own)");
    }
    return *body;
  }

  static std::string name_of(const XMLElement& element, const std::string& otherwise) {
    return element.Attribute("name") ? element.Attribute("name") : otherwise;
  }

  void add_root(const Values::Element& body, const Isometry3d& frame) {
    const auto* joint = body.xml->FirstChildElement("joint");
    const bool is_free = body.xml->FirstChildElement("freejoint") ||
                         (joint && values_.text({joint, ""}, "type").value_or("hinge") == "free");
    if (!is_free && joint) {
      source_.fail(joint->GetLineNum(),
                   "the robot's <body> has a <joint> to the world; expected a <freejoint>, or none");
    }
    if (!is_free) {
      robot_.warnings.push_back(place(*body.xml) +
                                "the robot's <body> is fixed to the world in MuJoCo; here it moves freely");
    }
    add_body(body, frame, "");
  }

  // The link of a body, whose frame is at `frame` in the link; and those that it carries.
  void add_body(const Values::Element& body, const Isometry3d& frame, const std::string& around) {
    only_attributes(
        source_, *body.xml,
        {"name", "childclass", "mocap", "pos", "quat", "axisangle", "euler", "xyaxes", "zaxis", "gravcomp", "user"});
    if (body.xml->Attribute("gravcomp")) not_taken_.insert("gravcomp of <body>");
    const std::string child_class = body.xml->Attribute("childclass") ? body.xml->Attribute("childclass") : around;
    const std::string name = name_of(*body.xml, "body_" + std::to_string(robot_.links.size()));
    if (outline_.link_lines.count(name)) source_.fail(body.xml->GetLineNum(), "has a second <body> '" + name + "'");
    const std::size_t index = robot_.links.size();
    outline_.link_lines[name] = body.xml->GetLineNum();
    Link link;
    link.name = name;
    link.line = body.xml->GetLineNum();
    take_shapes(*body.xml, child_class, frame, link);
    robot_.links.push_back(std::move(link));
    for (const auto* child = body.xml->FirstChildElement(); child; child = child->NextSiblingElement()) {
      const std::string kind = child->Name();
      if (kind == "body") add_child({child, child_class}, index, frame);
      const bool is_read =
          kind == "body" || kind == "geom" || kind == "joint" || kind == "freejoint" || kind == "inertial";
      const bool is_seen = kind == "site" || kind == "camera" || kind == "light";
      if (!is_read && !is_seen) not_taken_.insert("<" + kind + ">");
    }
  }

  void take_shapes(const XMLElement& body, const std::string& child_class, const Isometry3d& frame, Link& link) {
    Mass from_shapes;
    bool all_weighed = true;
    for (const auto* one = body.FirstChildElement("geom"); one; one = one->NextSiblingElement("geom")) {
      auto attributes = looks;
      attributes.insert(
          attributes.end(),
          {"type",   "contype", "conaffinity", "condim",       "size",   "mass",     "density",    "friction",
           "solref", "solimp",  "gap",         "shellinertia", "fromto", "pos",      "quat",       "axisangle",
           "euler",  "xyaxes",  "zaxis",       "hfield",       "mesh",   "fitscale", "fluidshape", "fluidcoef"});
      only_attributes(source_, *one, attributes);
      const mjcf::Geom geom = read_geom(source_, values_, {one, child_class}, meshes_, mesh_assets_, not_taken_);
      if (geom.mass)
        from_shapes = from_shapes + in_parent(frame, *geom.mass);
      else
        all_weighed = false;
      for (Shape shape : geom.shapes) {
        shape.pose = frame * shape.pose;
        if (geom.collides) link.shapes.push_back(shape);
        if (meshes_ == Meshes::visual) link.visuals.push_back(std::move(shape));
      }
    }
    const auto* inertial = body.FirstChildElement("inertial");
    if (inertial && !values_.takes_inertia_from_shapes()) {
      link.mass = in_parent(frame, given_mass({inertial, child_class}, link));
    } else if (!all_weighed) {
      source_.fail(body.GetLineNum(), "<body> '" + link.name + "' has a mesh and no <inertial>; expected one");
    } else {
      link.mass = from_shapes;
    }
  }

  Mass given_mass(const Values::Element& inertial, const Link& link) {
    only_attributes(source_, *inertial.xml,
                    {"pos", "quat", "axisangle", "euler", "xyaxes", "zaxis", "mass", "diaginertia", "fullinertia"});
    Mass mass;
    mass.mass = values_.number(inertial, "mass", 0);
    if (!(mass.mass > 0)) values_.fail(inertial, "has no mass above 0");
    if (const auto full = values_.numbers(inertial, "fullinertia", 6)) {
      const auto& f = *full;  // xx yy zz xy xz yz
      mass.inertia << f[0], f[3], f[4], f[3], f[1], f[5], f[4], f[5], f[2];
    } else if (values_.text(inertial, "diaginertia")) {
      mass.inertia = values_.vector(inertial, "diaginertia", Vector3d::Zero()).asDiagonal();
    } else {
      values_.fail(inertial, "has neither diaginertia nor fullinertia");
    }
    std::vector<std::string> warnings;
    try {
      check_inertia(mass, values_.frame(inertial), {}, warnings);
    } catch (const std::runtime_error& wrong) {
      source_.fail(inertial.xml->GetLineNum(), "body '" + link.name + "': " + wrong.what());
    }
    for (const std::string& warning : warnings)
      robot_.warnings.push_back(place(*inertial.xml) + "body '" + link.name + "': " + warning);
    return in_parent(values_.frame(inertial), mass);
  }

  void add_child(const Values::Element& body, std::size_t parent, const Isometry3d& parent_frame) {
    const std::string child_class =
        body.xml->Attribute("childclass") ? body.xml->Attribute("childclass") : body.child_class;
    const Isometry3d frame = values_.frame(body);
    const std::string name = name_of(*body.xml, "body_" + std::to_string(robot_.links.size()));
    Joint joint;
    joint.name = name + "_joint";
    joint.parent = parent;
    const auto* own = body.xml->FirstChildElement("joint");
    if (own && own->NextSiblingElement("joint")) {
      source_.fail(own->NextSiblingElement("joint")->GetLineNum(),
                   "<body> '" + name + "' has a second <joint>; a link has one here: expected a <body> between them");
    }
    if (const auto* loose = body.xml->FirstChildElement("freejoint"))
      source_.fail(loose->GetLineNum(),
                   "<freejoint> of a <body> that another carries; MuJoCo has it below <worldbody> only");
    Vector3d anchor = Vector3d::Zero();
    if (own) take_joint({own, child_class}, joint, anchor);
    joint.origin = parent_frame * frame * Eigen::Translation3d(anchor);
    joint.child = robot_.links.size();
    if (outline_.joint_lines.count(joint.name))
      source_.fail(own ? own->GetLineNum() : body.xml->GetLineNum(), "has a second joint '" + joint.name + "'");
    outline_.joint_lines[joint.name] = own ? own->GetLineNum() : body.xml->GetLineNum();
    robot_.joints.push_back(joint);
    add_body(body, Isometry3d(Eigen::Translation3d(-anchor)), child_class);
  }

  void take_joint(const Values::Element& element, Joint& joint, Vector3d& anchor) {
    only_attributes(source_, *element.xml, {"name",        "class",       "type",           "group",
                                            "pos",         "axis",        "springdamper",   "limited",
                                            "solreflimit", "solimplimit", "solreffriction", "solimpfriction",
                                            "stiffness",   "range",       "margin",         "ref",
                                            "springref",   "armature",    "damping",        "frictionloss",
                                            "user"});
    joint.name = name_of(*element.xml, joint.name);
    const std::string type = values_.text(element, "type").value_or("hinge");
    anchor = values_.vector(element, "pos", Vector3d::Zero());
    for (const char* one : {"stiffness", "springdamper", "ref", "armature"}) {
      const auto text = values_.text(element, one);
      if (text && parse_number(*text).value_or(1) != 0) not_taken_.insert(std::string(one) + " of <joint>");
    }
    const auto range = values_.numbers(element, "range", 2);
    const std::string limited = values_.text(element, "limited").value_or("auto");
    const bool is_limited = limited == "true" || (limited == "auto" && range && (*range)[0] < (*range)[1]);
    if (limited == "true" && !range) values_.fail(element, "is limited and has no range");
    if (type == "hinge") {
      joint.kind = is_limited ? JointKind::revolute : JointKind::continuous;
    } else if (type == "slide") {
      joint.kind = JointKind::prismatic;
    } else if (type == "ball") {
      joint.kind = JointKind::ball;
      if (is_limited) not_taken_.insert("range of <joint type=\"ball\">");
    } else {
      values_.fail(element, "type=\"" + type + "\" is wrong here; expected hinge, slide or ball" +
                                nearest(type, {"hinge", "slide", "ball"}));
    }
    if (law_of(joint.kind).has_axis) {
      joint.axis = values_.vector(element, "axis", Vector3d::UnitZ());
      if (!(joint.axis.norm() > 1e-9)) values_.fail(element, "axis has no length");
      joint.axis.normalize();
    }
    if (is_limited && law_of(joint.kind).has_limits) {
      const bool turns = joint.kind == JointKind::revolute;
      joint.lower = turns ? values_.angle((*range)[0]) : (*range)[0];
      joint.upper = turns ? values_.angle((*range)[1]) : (*range)[1];
      if (turns) warn_of_radians(element, joint, (*range)[0], (*range)[1]);
    }
    joint.damping = values_.number(element, "damping", 0);
    joint.friction = values_.number(element, "frictionloss", 0);
    if (joint.damping < 0 || joint.friction < 0) values_.fail(element, "damping and frictionloss must not be below 0");
  }

  // Degrees are MuJoCo's default, and a range within a turn of radians that has decimals is seldom meant in them.
  void warn_of_radians(const Values::Element& element, const Joint& joint, double lower, double upper) {
    constexpr double turn = 6.283185307179586, degree = turn / 360;
    const bool has_decimals = lower != std::round(lower) || upper != std::round(upper);
    if (!values_.is_degrees_by_default() || !has_decimals || std::max(std::abs(lower), std::abs(upper)) > turn) return;
    robot_.warnings.push_back(place(*element.xml) + "joint '" + joint.name + "': its range of " + print_number(lower) +
                              " to " + print_number(upper) +
                              " is in degrees, MuJoCo's default; are these radians? expected range=\"" +
                              print_number(lower / degree) + ' ' + print_number(upper / degree) +
                              "\", or <compiler angle=\"radian\"/> of all angles");
  }

  // What an actuator can do is that of its joint: a drive takes it from there.
  void read_actuators() {
    const auto* all = root_.FirstChildElement("actuator");
    for (const auto* one = all ? all->FirstChildElement() : nullptr; one; one = one->NextSiblingElement()) {
      const std::string kind = one->Name(), name = one->Attribute("joint") ? one->Attribute("joint") : "";
      const Values::Element element{one, ""};
      const auto joint =
          std::find_if(robot_.joints.begin(), robot_.joints.end(), [&](const Joint& j) { return j.name == name; });
      if (name.empty()) {
        not_taken_.insert("<" + kind + "> of <actuator> without a joint");
        continue;
      }
      if (joint == robot_.joints.end()) {
        std::vector<std::string> names;
        for (const Joint& j : robot_.joints) names.push_back(j.name);
        values_.fail(element, "joint '" + name + "' is not known" + nearest(name, names));
      }
      const auto gears = values_.numbers(element, "gear", 6, 1);
      const double gear = std::abs(gears ? gears->front() : 1);
      if (const auto force = values_.numbers(element, "forcerange", 2))
        joint->max_effort = gear * std::max(std::abs((*force)[0]), std::abs((*force)[1]));
      const auto control = values_.numbers(element, "ctrlrange", 2);
      const double most = control ? std::max(std::abs((*control)[0]), std::abs((*control)[1])) : 0;
      if (kind == "velocity" && most > 0 && gear > 0) joint->max_speed = most / gear;
      if (kind == "motor" && most > 0) joint->max_effort = std::min(joint->max_effort, gear * most);
      if (kind != "velocity" && kind != "motor")
        not_taken_.insert("the law of <" + kind + "> of <actuator> (a drive turns wheels at rates)");
    }
  }

  void note_rest() {
    for (const auto* one = root_.FirstChildElement(); one; one = one->NextSiblingElement()) {
      const std::string name = one->Name();
      for (const char* known : {"tendon", "equality", "contact", "sensor", "keyframe", "custom"})
        if (name == known) not_taken_.insert("<" + name + ">");
      if (name == "option") note_option(*one);
      for (const char* mass : {"settotalmass", "boundmass", "boundinertia"})
        if (name == "compiler" && one->Attribute(mass)) not_taken_.insert(std::string(mass) + " of <compiler>");
    }
  }

  // Physics of the file beyond the robot; its solver's own settings are of MuJoCo alone.
  void note_option(const XMLElement& option) {
    constexpr double earth = 9.81;
    const char* gravity = option.Attribute("gravity");
    const auto values = parse_numbers(gravity ? gravity : "");
    const bool is_earth = values && values->size() == 3 && std::abs((*values)[0]) + std::abs((*values)[1]) < 1e-9 &&
                          std::abs((*values)[2] + earth) < 0.02;
    const auto* flag = option.FirstChildElement("flag");
    const bool is_off = flag && flag->Attribute("gravity") && flag->Attribute("gravity") == std::string("disable");
    if ((gravity && !is_earth) || is_off)
      not_taken_.insert(std::string("gravity") + (gravity && !is_off ? "=\"" + std::string(gravity) + '"' : "") +
                        " of <option> (a world has 9.81 m/s2 downwards)");
    if (option.Attribute("timestep"))
      not_taken_.insert("timestep of <option> (expected step=\"" + std::string(option.Attribute("timestep")) +
                        "\" of the physics in the world)");
    for (const char* one : {"wind", "density", "viscosity", "magnetic"})
      if (option.Attribute(one)) not_taken_.insert(std::string(one) + " of <option>");
  }

  std::string place(const XMLElement& element) const {
    return source_.file + ":" + std::to_string(element.GetLineNum()) + ": ";
  }

  void warn() {
    if (not_taken_.empty()) return;
    std::string list;
    for (const std::string& one : not_taken_) list += (list.empty() ? "" : ", ") + one;
    robot_.warnings.push_back(place(root_) + "of this MuJoCo model are not taken: " + list);
  }

  const Source& source_;
  const XMLElement& root_;
  const Values values_;
  const Meshes meshes_;
  Outline& outline_;
  std::map<std::string, const XMLElement*> mesh_assets_;
  mjcf::NotTaken not_taken_;
  Robot robot_;
};

}  // namespace

Robot read_mjcf(const Source& source, const XMLElement& root, Meshes meshes, Outline& outline) {
  return Reader(source, root, meshes, outline).read();
}

}  // namespace muster::description
