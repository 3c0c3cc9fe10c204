#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Eigenvalues>
#include <filesystem>
#include <mutex>
#include <stdexcept>

#include "description/file_text.hpp"
#include "description/mesh.hpp"
#include "description/urdf_check.hpp"

namespace muster::description {

namespace {

constexpr std::size_t max_file = 16u << 20;  // bytes

// urdfdom reports by console_bridge, which is global to the process: this captures its messages and restores the
// previous handler.
class Listener : public console_bridge::OutputHandler {
 public:
  Listener() : lock_(mutex()), before_(console_bridge::getOutputHandler()) { console_bridge::useOutputHandler(this); }
  ~Listener() override { console_bridge::useOutputHandler(before_); }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && first_error_.empty()) first_error_ = text;
  }
  const std::string& first_error() const { return first_error_; }

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  std::unique_lock<std::mutex> lock_;
  console_bridge::OutputHandler* before_;
  std::string first_error_;
};

Eigen::Vector3d vector(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Eigen::Isometry3d frame(const urdf::Pose& pose) {
  const auto& q = pose.rotation;
  return Eigen::Translation3d(vector(pose.position)) * Eigen::Quaterniond(q.w, q.x, q.y, q.z);
}

class Converter {
 public:
  Converter(const Source& source, const Outline& outline, const urdf::ModelInterface& model, Meshes meshes)
      : source_(source), outline_(outline), model_(model), meshes_(meshes) {}

  Robot convert() {
    robot_.name = model_.getName();
    robot_.file = source_.file;
    add_link(outline_.root);
    for (const std::string& name : outline_.order) add_joint(name);
    return std::move(robot_);
  }

 private:
  void add_link(const std::string& name) {
    const auto from = model_.getLink(name);
    const int line = outline_.link_lines.at(name);
    index_[name] = robot_.links.size();
    Link link;
    link.name = name;
    if (!from->inertial && outline_.with_inertial.count(name)) {
      source_.fail(line, "link '" + name + "': urdfdom dropped its <inertial>");
    }
    if (from->inertial) link.mass = mass(*from->inertial, name, line);
    for (const auto& collision : from->collision_array) {
      if (!collision || !collision->geometry)
        source_.fail(line, "link '" + name + "': urdfdom dropped a collision shape");
      const bool is_mesh = collision->geometry->type == urdf::Geometry::MESH;
      if (is_mesh && meshes_ == Meshes::skip) continue;
      link.shapes.push_back(shape(collision->origin, *collision->geometry, name, line));
    }
    if (meshes_ == Meshes::visual) link.visuals = visuals(*from, name, line);
    robot_.links.push_back(std::move(link));
  }

  std::vector<Shape> visuals(const urdf::Link& from, const std::string& name, int line) {
    std::vector<Shape> result;
    try {
      for (const auto& visual : from.visual_array) {
        if (visual && visual->geometry) result.push_back(shape(visual->origin, *visual->geometry, name, line));
      }
    } catch (const std::runtime_error& wrong) {
      robot_.warnings.emplace_back(wrong.what());
      result.clear();
    }
    return result;
  }

  // In the inertial frame a link's inertia is given about its centre of mass.
  Mass mass(const urdf::Inertial& from, const std::string& name, int line) const {
    if (!(from.mass > 0)) source_.fail(line, "link '" + name + "': mass is not above 0");
    Eigen::Matrix3d inertia;
    inertia << from.ixx, from.ixy, from.ixz, from.ixy, from.iyy, from.iyz, from.ixz, from.iyz, from.izz;
    const Eigen::Vector3d principal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia).eigenvalues();
    if (!(principal[0] > 0)) source_.fail(line, "link '" + name + "': inertia is not positive definite");
    // No body has a principal moment above the sum of the others; a thin plate reaches it, so rounded figures get some
    // slack.
    if (principal[2] > (principal[0] + principal[1]) * (1 + 1e-3)) {
      source_.fail(line, "link '" + name + "': inertia breaks the triangle inequality; no body has such moments");
    }
    return in_parent(frame(from.origin), {from.mass, Eigen::Vector3d::Zero(), inertia});
  }

  Shape shape(const urdf::Pose& origin, const urdf::Geometry& from, const std::string& name, int line) {
    Shape result;
    result.pose = frame(origin);
    const auto positive = [&](double length, const char* what) {
      if (!(length > 0)) source_.fail(line, "link '" + name + "': " + what + " is not above 0");
      return length;
    };
    if (from.type == urdf::Geometry::BOX) {
      const auto& box = static_cast<const urdf::Box&>(from);
      positive(std::min({box.dim.x, box.dim.y, box.dim.z}), "an edge of a box");
      result.geometry = Box{vector(box.dim)};
    } else if (from.type == urdf::Geometry::SPHERE) {
      result.geometry = Sphere{positive(static_cast<const urdf::Sphere&>(from).radius, "the radius of a sphere")};
    } else if (from.type == urdf::Geometry::CYLINDER) {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(from);
      result.geometry = Cylinder{positive(cylinder.radius, "the radius of a cylinder"),
                                 positive(cylinder.length, "the length of a cylinder")};
    } else {
      result.geometry = mesh(static_cast<const urdf::Mesh&>(from), name, line);
    }
    return result;
  }

  Mesh mesh(const urdf::Mesh& from, const std::string& name, int line) {
    const std::string folder = std::filesystem::absolute(source_.file).parent_path().string();
    const std::string what = "link '" + name + "': mesh '" + from.filename + "' ";
    try {
      Mesh result = read_mesh(folder, from.filename, vector(from.scale));
      Eigen::AlignedBox3d bounds;
      for (const auto& vertex : result.vertices) bounds.extend(vertex);
      const double largest = bounds.sizes().maxCoeff();
      if (largest > 100 || largest < 1e-3) {
        robot_.warnings.push_back(source_.file + ":" + std::to_string(line) + ": " + what + "is " +
                                  print_number(largest) + " m large; is its scale right?");
      }
      return result;
    } catch (const std::runtime_error& error) {
      source_.fail(line, what + error.what());
    }
  }

  void add_joint(const std::string& name) {
    const auto from = model_.getJoint(name);
    const int line = outline_.joint_lines.at(name);
    Joint joint;
    joint.name = name;
    joint.kind = kind(from->type);
    const JointLaw& law = law_of(joint.kind);
    joint.parent = index_.at(from->parent_link_name);
    add_link(from->child_link_name);
    joint.child = robot_.links.size() - 1;
    joint.origin = frame(from->parent_to_joint_origin_transform);
    if (law.has_axis) {
      joint.axis = vector(from->axis);
      if (!(joint.axis.norm() > 1e-9)) source_.fail(line, "joint '" + name + "': axis has no length");
      joint.axis.normalize();
    }
    if (from->limits) set_limits(*from->limits, joint, line);
    if (from->dynamics) set_dynamics(*from->dynamics, joint, line);
    robot_.joints.push_back(joint);
  }

  void set_limits(const urdf::JointLimits& limits, Joint& joint, int line) {
    const auto fail = [&](const char* what) { source_.fail(line, "joint '" + joint.name + "': " + what); };
    if (limits.lower > limits.upper) fail("lower limit is above the upper one");
    if (limits.effort < 0 || limits.velocity < 0) fail("effort and velocity limits must not be below 0");
    if (law_of(joint.kind).has_limits) {
      joint.lower = limits.lower;
      joint.upper = limits.upper;
    } else if (limits.lower != 0 || limits.upper != 0) {
      robot_.warnings.push_back(source_.file + ":" + std::to_string(line) + ": joint '" + joint.name + "': a " +
                                law_of(joint.kind).name + " joint has no lower and upper limit; they are left out");
    }
    if (limits.effort > 0) joint.max_effort = limits.effort;
    if (limits.velocity > 0) joint.max_speed = limits.velocity;
  }

  void set_dynamics(const urdf::JointDynamics& dynamics, Joint& joint, int line) const {
    if (dynamics.damping < 0 || dynamics.friction < 0) {
      source_.fail(line, "joint '" + joint.name + "': damping and friction must not be below 0");
    }
    joint.damping = dynamics.damping;
    joint.friction = dynamics.friction;
  }

  static JointKind kind(int type) {
    switch (type) {
      case urdf::Joint::REVOLUTE:
        return JointKind::revolute;
      case urdf::Joint::CONTINUOUS:
        return JointKind::continuous;
      case urdf::Joint::PRISMATIC:
        return JointKind::prismatic;
      case urdf::Joint::FLOATING:
        return JointKind::floating;
      case urdf::Joint::PLANAR:
        return JointKind::planar;
      default:
        return JointKind::fixed;
    }
  }

  const Source& source_;
  const Outline& outline_;
  const urdf::ModelInterface& model_;
  const Meshes meshes_;
  std::map<std::string, std::size_t> index_;
  Robot robot_;
};

// Requires a mass of every moving link: without one no engine can move it.
void check_moving_masses(const Source& source, const Outline& outline, const Robot& robot) {
  for (const Joint& joint : robot.joints) {
    if (joint.kind == JointKind::fixed || rigid_mass(robot, joint.child).mass > 0) continue;
    const std::string& link = robot.links[joint.child].name;
    source.fail(outline.link_lines.at(link),
                "link '" + link + "' moves by joint '" + joint.name + "' but has no <inertial>");
  }
}

urdf::ModelInterfaceSharedPtr parse(const Source& source, const std::string& text) {
  const Listener listener;
  auto model = urdf::parseURDF(text);
  if (!model || !listener.first_error().empty()) source.fail(1, "is not URDF: " + listener.first_error());
  return model;
}

}  // namespace

Robot read_robot(const std::string& path, Meshes meshes) {
  const Source source{path};
  const std::string text = read_file(path, max_file);
  tinyxml2::XMLDocument document;
  parse_urdf(source, text, document);
  const tinyxml2::XMLElement& root = *document.RootElement();
  required(source, root, "name");
  const Outline outline = check_urdf(source, root);
  const auto model = parse(source, text);
  Robot robot = Converter(source, outline, *model, meshes).convert();
  check_moving_masses(source, outline, robot);
  for (const auto* sensor = root.FirstChildElement("sensor"); sensor; sensor = sensor->NextSiblingElement("sensor")) {
    read_sensor(source, *sensor, robot);
  }
  for (const auto* muster = root.FirstChildElement("muster"); muster; muster = muster->NextSiblingElement("muster")) {
    read_muster(source, *muster, robot);
  }
  warn_of_blind_lasers(source, root, robot);
  return robot;
}

}  // namespace muster::description
