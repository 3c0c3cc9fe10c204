#include "description/urdf_links.hpp"

#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <set>
#include <stdexcept>

#include "description/file_text.hpp"
#include "description/mesh.hpp"
#include "description/urdf_inertia.hpp"

namespace muster::description {
namespace {

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

constexpr const char package_scheme[] = "package://";

bool is_in_package(const std::string& mesh) { return mesh.rfind(package_scheme, 0) == 0; }

// NAME of package://NAME/FILE.
std::string package_of(const std::string& mesh) {
  const std::size_t from = sizeof package_scheme - 1;
  return mesh.substr(from, mesh.find('/', from) - from);
}

// The folder that holds the package: the declared one, or the one above if that is the package itself.
std::string package_root(const std::string& packages, const std::string& name) {
  namespace fs = std::filesystem;
  if (packages.empty()) {
    throw std::runtime_error(
        "is in a ROS package; expected packages=\"DIR\" of the <robot> in the world, where "
        "DIR holds the folder '" +
        name + "'");
  }
  fs::path root = fs::absolute(packages).lexically_normal();
  if (!root.has_filename()) root = root.parent_path();
  if (fs::is_directory(root / name)) return root.string();
  if (root.filename() == name) return root.parent_path().string();
  throw std::runtime_error("is in the ROS package '" + name + "', of which there is no folder in packages=\"" +
                           packages + "\"");
}

class Converter {
 public:
  Converter(const Source& source, const Outline& outline, const urdf::ModelInterface& model, Meshes meshes,
            const std::string& packages)
      : source_(source), outline_(outline), model_(model), meshes_(meshes), packages_(packages) {}

  Robot convert() {
    robot_.name = model_.getName();
    robot_.file = source_.file;
    add_link(outline_.root);
    for (const std::string& name : outline_.order) add_joint(name);
    if (!undrawn_.empty()) {
      robot_.warnings.push_back(source_.file + ": the meshes of package '" + *undrawn_.begin() +
                                "' are not drawn, since the <robot> in the world has no packages=\"DIR\"; collision "
                                "shapes are drawn in their place");
    }
    return std::move(robot_);
  }

 private:
  void add_link(const std::string& name) {
    const auto from = model_.getLink(name);
    const int line = outline_.link_lines.at(name);
    index_[name] = robot_.links.size();
    Link link;
    link.name = name;
    link.line = line;
    if (!from->inertial && outline_.mass_lines.count(name)) {
      source_.fail(line, "link '" + name + "': urdfdom dropped its <inertial>");
    }
    bool has_all_shapes = true;
    for (const auto& collision : from->collision_array) {
      if (!collision || !collision->geometry)
        source_.fail(line, "link '" + name + "': urdfdom dropped a collision shape");
      const bool is_mesh = collision->geometry->type == urdf::Geometry::MESH;
      if (is_mesh && meshes_ == Meshes::skip) {
        has_all_shapes = false;
        continue;
      }
      link.shapes.push_back(shape(collision->origin, *collision->geometry, name, line));
    }
    if (from->inertial)
      link.mass = mass(*from->inertial, name, line, has_all_shapes ? link.shapes : std::vector<Shape>());
    if (meshes_ == Meshes::visual) link.visuals = visuals(*from, name, line);
    robot_.links.push_back(std::move(link));
  }

  std::vector<Shape> visuals(const urdf::Link& from, const std::string& name, int line) {
    std::vector<Shape> result;
    try {
      for (const auto& visual : from.visual_array) {
        if (!visual || !visual->geometry) continue;
        const std::string package = undeclared_package(*visual->geometry);
        if (package.empty())
          result.push_back(shape(visual->origin, *visual->geometry, name, line));
        else
          undrawn_.insert(package);
      }
    } catch (const std::runtime_error& wrong) {
      robot_.warnings.emplace_back(wrong.what());
      result.clear();
    }
    return result;
  }

  // The package of a mesh where the world declares no folder for packages; else "".
  std::string undeclared_package(const urdf::Geometry& from) const {
    if (from.type != urdf::Geometry::MESH || !packages_.empty()) return "";
    const std::string& file = static_cast<const urdf::Mesh&>(from).filename;
    return is_in_package(file) ? package_of(file) : "";
  }

  // In the inertial frame a link's inertia is given about its centre of mass.
  Mass mass(const urdf::Inertial& from, const std::string& name, int line, const std::vector<Shape>& shapes) {
    if (!(from.mass > 0))
      source_.fail(outline_.mass_lines.at(name),
                   "link '" + name + "': <mass value=\"" + print_number(from.mass) + "\"/>; " + expected_mass(shapes));
    Eigen::Matrix3d inertia;
    inertia << from.ixx, from.ixy, from.ixz, from.ixy, from.iyy, from.iyz, from.ixz, from.iyz, from.izz;
    Mass result{from.mass, Eigen::Vector3d::Zero(), inertia};
    std::vector<std::string> warnings;
    try {
      check_inertia(result, frame(from.origin), shapes, warnings);
    } catch (const std::runtime_error& wrong) {
      source_.fail(line, "link '" + name + "': " + wrong.what());
    }
    for (const std::string& warning : warnings)
      robot_.warnings.push_back(source_.file + ":" + std::to_string(line) + ": link '" + name + "': " + warning);
    return in_parent(frame(from.origin), result);
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

  // The scale with which a mesh of another size would be one of a robot's.
  static std::string meant_scale(const urdf::Mesh& from, double largest) {
    const double factor = largest > 1 ? 1e-3 : 1e3, size = largest * factor;
    if (size > 100 || size < 1e-3) return "is its scale right?";
    const auto scaled = [&](double own) { return print_number(own * factor); };
    return std::string(largest > 1 ? "is it in millimetres?" : "is it in metres?") + " expected <mesh filename=\"" +
           from.filename + "\" scale=\"" + scaled(from.scale.x) + ' ' + scaled(from.scale.y) + ' ' +
           scaled(from.scale.z) + "\"/>, with which it is " + print_number(size) + " m large";
  }

  Mesh mesh(const urdf::Mesh& from, const std::string& name, int line) {
    std::string folder = std::filesystem::absolute(source_.file).parent_path().string(), file = from.filename;
    const std::string what = "link '" + name + "': mesh '" + from.filename + "' ";
    try {
      if (is_in_package(file)) {
        folder = package_root(packages_, package_of(file));
        file = file.substr(sizeof package_scheme - 1);
      }
      Mesh result = read_mesh(folder, file, vector(from.scale));
      Eigen::AlignedBox3d bounds;
      for (const auto& vertex : result.vertices) bounds.extend(vertex);
      const double largest = bounds.sizes().maxCoeff();
      if (largest > 100 || largest < 1e-3) {
        robot_.warnings.push_back(source_.file + ":" + std::to_string(line) + ": " + what + "is " +
                                  print_number(largest) + " m large; " + meant_scale(from, largest));
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
      const double length = joint.axis.norm();
      joint.axis.normalize();
      constexpr double rounded = 1e-3;  // of a unit vector in three digits
      if (std::abs(length - 1) > rounded) {
        const Eigen::Vector3d& unit = joint.axis;
        robot_.warnings.push_back(
            source_.file + ":" + std::to_string(line) + ": joint '" + name + "': its axis has a length of " +
            print_number(length) + " where 1 is expected, and is divided by it; write <axis xyz=\"" +
            print_exactly(unit.x()) + " " + print_exactly(unit.y()) + " " + print_exactly(unit.z()) + "\"/>");
      }
    }
    if (from->limits) set_limits(*from->limits, joint, line);
    if (from->dynamics) set_dynamics(*from->dynamics, joint, line);
    robot_.joints.push_back(joint);
  }

  void set_limits(const urdf::JointLimits& limits, Joint& joint, int line) {
    const auto fail = [&](const char* what) { source_.fail(line, "joint '" + joint.name + "': " + what); };
    if (limits.lower > limits.upper) fail("lower limit is above the upper one; are they exchanged?");
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
  const std::string& packages_;
  std::set<std::string> undrawn_;  // packages of visual meshes without a folder declared
  std::map<std::string, std::size_t> index_;
  Robot robot_;
};

urdf::ModelInterfaceSharedPtr parse(const Source& source, const std::string& text) {
  const Listener listener;
  auto model = urdf::parseURDF(text);
  if (!model || !listener.first_error().empty()) source.fail(1, "is not URDF: " + listener.first_error());
  return model;
}

}  // namespace

Robot from_urdf(const Source& source, const tinyxml2::XMLElement& root, const std::string& text, Meshes meshes,
                const UrdfSetting& setting, Outline& outline) {
  required(source, root, "name");
  outline = check_urdf(source, root);
  const auto model = parse(source, text);
  return Converter(source, outline, *model, meshes, setting.packages).convert();
}

}  // namespace muster::description
