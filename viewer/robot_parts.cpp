#include "robot_parts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>

namespace muster::viewer {
namespace {

using description::Robot;
using description::Shape;
using Eigen::Isometry3d;
using Eigen::Vector3d;

double rounded(double metres) { return std::round(metres * 1e5) / 1e5 + 0.0; }  // without -0

Json list_of(const Vector3d& v) { return Json(std::vector<double>{v.x(), v.y(), v.z()}); }

void add_pose(const Isometry3d& pose, Json& description) {
  const Eigen::Quaterniond turn(pose.linear());
  description["at"] = list_of(pose.translation());
  description["turn"] = std::vector<double>{turn.w(), turn.x(), turn.y(), turn.z()};
}

// The table and column that record the angle of a joint, where there are any.
struct Recorded {
  std::string quantity, column;
};

std::optional<Recorded> recorded(const Robot& robot, std::size_t joint) {
  const int side = robot.drive ? robot.drive->side_of(joint) : -1;
  if (side >= 0) return Recorded{"wheels", side == 0 ? "left" : "right"};
  if (!robot.legs) return {};
  for (std::size_t leg = 0; leg < description::LegDrive::count; ++leg) {
    if (robot.legs->legs[leg].joint == joint) return Recorded{"legs", "angle" + std::to_string(leg + 1)};
  }
  return {};
}

// A link's frame: on the body, or on a joint that turns.
struct Frame {
  int joint = -1;
  Isometry3d pose = Isometry3d::Identity();
};

Json shape_json(const Shape& shape) {
  Json result = Json::object();
  std::visit(
      [&](const auto& geometry) {
        using Kind = std::decay_t<decltype(geometry)>;
        if constexpr (std::is_same_v<Kind, description::Box>) {
          result["shape"] = "box";
          result["size"] = list_of(geometry.size);
        } else if constexpr (std::is_same_v<Kind, description::Sphere>) {
          result["shape"] = "sphere";
          result["radius"] = geometry.radius;
        } else if constexpr (std::is_same_v<Kind, description::Cylinder>) {
          result["shape"] = "cylinder";
          result["radius"] = geometry.radius;
          result["length"] = geometry.length;
        } else {
          result["shape"] = "mesh";
          add_triangles(geometry, result);
        }
      },
      shape.geometry);
  return result;
}

const std::vector<Shape>& looks_of(const description::Link& link) {
  return link.visuals.empty() ? link.shapes : link.visuals;
}

double size_of(const description::Link& link) {
  double result = 0;
  for (const Shape& shape : looks_of(link)) result = std::max(result, description::bounds(shape).volume());
  return result;
}

class Parts {
 public:
  explicit Parts(const Robot& robot) : robot_(robot), joints_(Json::array()), parts_(Json::array()) {}

  Json made() {
    std::vector<Frame> frames(robot_.links.size());
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) frames[robot_.joints[j].child] = frame_of(j, frames);
    double largest = 0;
    for (const auto& link : robot_.links) largest = std::max(largest, size_of(link));
    for (std::size_t l = 0; l < robot_.links.size(); ++l) {
      const bool is_main = size_of(robot_.links[l]) == largest;
      for (const Shape& shape : looks_of(robot_.links[l])) add_part(shape_json(shape), frames[l], shape.pose, is_main);
    }
    add_legs();
    Json result{{"radius", radius()}};
    result["joints"] = joints_;
    result["parts"] = parts_;
    return result;
  }

 private:
  Frame frame_of(std::size_t j, const std::vector<Frame>& frames) {
    const description::Joint& joint = robot_.joints[j];
    const Frame& parent = frames[joint.parent];
    const auto column = recorded(robot_, j);
    if (!column || parent.joint >= 0) return {parent.joint, parent.pose * joint.origin};
    Json turning{{"quantity", column->quantity}, {"column", column->column}, {"axis", list_of(joint.axis)}};
    add_pose(parent.pose * joint.origin, turning);
    joints_.push_back(turning);
    ++count_;
    if (column->quantity == "legs") legs_.push_back(count_ - 1);
    return {count_ - 1, Isometry3d::Identity()};
  }

  void add_part(Json part, const Frame& frame, const Isometry3d& pose, bool is_main) {
    add_pose(frame.pose * pose, part);
    if (frame.joint >= 0) part["joint"] = frame.joint;
    part["main"] = is_main;
    parts_.push_back(std::move(part));
  }

  void add_legs() {
    for (const int joint : legs_)
      add_part({{"shape", "leg"}, {"radius", robot_.legs->radius}}, {.joint = joint}, Isometry3d::Identity(), false);
  }

  double radius() const {
    const Eigen::AlignedBox3d box = description::bounds(robot_);
    return box.isEmpty() ? 0.15 : std::max(0.02, std::hypot(box.sizes().x(), box.sizes().y()) / 2);
  }

  const Robot& robot_;
  Json joints_, parts_;
  int count_ = 0;
  std::vector<int> legs_;
};

}  // namespace

void add_triangles(const description::Mesh& mesh, Json& description) {
  std::vector<double> vertices;
  std::vector<std::uint32_t> faces;
  for (const Vector3d& vertex : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) vertices.push_back(rounded(vertex[axis]));
  }
  for (const auto& face : mesh.faces) faces.insert(faces.end(), face.begin(), face.end());
  description["vertices"] = vertices;
  description["faces"] = faces;
}

Json parts_of(const Robot& robot) { return Parts(robot).made(); }

}  // namespace muster::viewer
