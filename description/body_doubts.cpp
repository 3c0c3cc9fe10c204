#include "description/body_doubts.hpp"

#include <algorithm>
#include <cmath>

#include "description/file_text.hpp"
#include "description/urdf_inertia.hpp"

namespace muster::description {

using Eigen::Vector3d;

namespace {

constexpr double body_farthest = 20;         // m, of a laser from its robot's origin
constexpr double body_longest_range = 1000;  // m, of a laser
constexpr double body_off_centre = 10;       // times the shapes' size, of the centre of mass from them
constexpr double body_strongest = 50;        // times the torque that slips
constexpr double body_turn = 6.283185307179586;
constexpr double body_gravity = 9.81;
constexpr double body_touching = 0.3;  // wheel radii above the ground: what is lower comes to it when the robot tilts
constexpr double body_outside = 0.01;  // m beyond the support, where no rounding puts a centre of mass

std::string edges_text(const Eigen::Vector3d& edges) {
  return print_number(edges.x()) + " x " + print_number(edges.y()) + " x " + print_number(edges.z()) + " m";
}

// The points of a shape that can touch the ground first, in the robot's frame.
std::vector<Eigen::Vector3d> low_points(const Shape& shape) {
  std::vector<Eigen::Vector3d> points;
  if (const auto* sphere = std::get_if<Sphere>(&shape.geometry))
    return {shape.pose.translation() - Eigen::Vector3d(0, 0, sphere->radius)};
  if (const auto* mesh = std::get_if<Mesh>(&shape.geometry)) {
    for (const Eigen::Vector3d& vertex : mesh->vertices) points.push_back(shape.pose * vertex);
    return points;
  }
  if (const auto* box = std::get_if<Box>(&shape.geometry)) {
    for (int corner = 0; corner < 8; ++corner)
      points.push_back(shape.pose * Eigen::Vector3d((corner & 1 ? 0.5 : -0.5) * box->size.x(),
                                                    (corner & 2 ? 0.5 : -0.5) * box->size.y(),
                                                    (corner & 4 ? 0.5 : -0.5) * box->size.z()));
    return points;
  }
  const auto& cylinder = std::get<Cylinder>(shape.geometry);
  constexpr int around = 16;
  for (int i = 0; i < 2 * around; ++i) {
    const double angle = body_turn * i / around, side = i < around ? 0.5 : -0.5;
    points.push_back(shape.pose * Eigen::Vector3d(cylinder.radius * std::cos(angle), cylinder.radius * std::sin(angle),
                                                  side * cylinder.length));
  }
  return points;
}

class BodyDoubts {
 public:
  BodyDoubts(const Source& source, bool is_mjcf, Robot& robot) : source_(source), is_mjcf_(is_mjcf), robot_(robot) {}

  // A shape beyond all robots. It comes first and alone: what else is told of such a body follows from it.
  bool is_in_millimetres() {
    const Link* first = nullptr;
    std::size_t others = 0;
    for (const Link& link : robot_.links) {
      if (!is_oversized(link.shapes)) continue;
      if (first)
        ++others;
      else
        first = &link;
    }
    if (!first) return false;
    const Shape& shape = *std::max_element(
        first->shapes.begin(), first->shapes.end(), [](const Shape& a, const Shape& b) {  // a mesh's reader warns of it
          const auto size = [](const Shape& s) {
            return std::holds_alternative<Mesh>(s.geometry) ? 0 : bounds(s).sizes().maxCoeff();
          };
          return size(a) < size(b);
        });
    const Vector3d edges = bounds(shape).sizes();
    const std::string count = std::to_string(others);
    robot_.warnings.insert(
        robot_.warnings.begin(),
        source_.file + ":" + std::to_string(first->line) + ": link '" + first->name + "': a shape of " +
            edges_text(edges) +
            (others == 0 ? ""
                         : ", and " + count + (others == 1 ? " other link is" : " other links are") + " as large") +
            "; are these millimetres? expected metres, here " + edges_text(edges / 1000) +
            ", and all origins, radii and distances of the model alike");
    return true;
  }

  void centres_of_links() {
    for (const Link& link : robot_.links) {
      Eigen::AlignedBox3d all;
      for (const Shape& shape : link.shapes) all.extend(bounds(shape));
      if (link.mass.mass <= 0 || all.isEmpty()) continue;
      const double off = all.exteriorDistance(link.mass.centre);
      if (off > 1 && off > body_off_centre * all.sizes().norm())
        warn(link.line, "link '" + link.name + "': its centre of mass is " + print_number(off) +
                            " m off its collision shapes; are these millimetres?");
    }
  }

  void lasers() {
    for (const Sensor& sensor : robot_.sensors) {
      const double off = sensor.pose.translation().norm();
      if (off > body_farthest)
        warn(0, "sensor '" + sensor.name + "': it is mounted " + print_number(off) +
                    " m from the robot's origin; are these millimetres?");
      if (sensor.laser.max_range > body_longest_range)
        warn(0, "sensor '" + sensor.name + "': a range of " + print_number(sensor.laser.max_range) +
                    " m; are these millimetres?");
    }
  }

  // A wheel's cylinder that does not lie about the axle: no engine rolls on it, but its size and picture are wrong.
  void wheels() {
    constexpr double aligned = 0.996, alike = 0.1;  // cosine of 5 degrees; of the radius
    const DifferentialDrive& drive = *robot_.drive;
    for (std::size_t index = 0; index < robot_.joints.size(); ++index) {
      const Joint& joint = robot_.joints[index];
      if (joint.kind != JointKind::continuous && drive.side_of(index) < 0) continue;
      const Link& link = robot_.links[joint.child];
      const Shape* wrong = nullptr;
      for (const Shape& shape : link.shapes) {
        const auto* cylinder = std::get_if<Cylinder>(&shape.geometry);
        const Vector3d axis = shape.pose.linear().col(2);
        if (!cylinder || std::abs(axis.dot(joint.axis)) > aligned) {
          wrong = nullptr;  // the tyre, and what else is there may lie as it likes
          break;
        }
        const double front = drive.steering ? drive.steering->radius : drive.wheel_radius;
        for (const double wheel : {drive.wheel_radius, front})
          if (std::abs(cylinder->radius - wheel) < alike * wheel) wrong = &shape;
      }
      if (wrong) turned(link, joint, *wrong);
    }
  }

  // Two wheels alike carry half of the robot each, at most.
  void torque() {
    const DifferentialDrive& drive = *robot_.drive;
    const double slips = drive.friction * whole_mass(robot_).mass * body_gravity * drive.wheel_radius;
    if (slips > 0 && drive.max_torque > body_strongest * slips)
      warn(0, "the drive's max_torque=\"" + print_number(drive.max_torque) + "\" is more than " +
                  print_number(body_strongest) + " times what its wheels can pass to the ground, " +
                  print_number(std::round(slips * 100) / 100) + " N m; are these N mm?");
  }

  // The centre of mass lies beyond all that touches the ground, in some direction.
  void support() {
    const DifferentialDrive& drive = *robot_.drive;
    if (body_shapes(robot_).empty()) return;  // what carries it is not described
    std::vector<Eigen::Vector3d> touch;
    double ground = 0;
    for (const auto& wheel : drive.wheels()) {
      const auto place = frame_on_body(robot_, robot_.joints[wheel.joint].parent);
      if (!place) return;  // on a kingpin or an arm
      const Eigen::Vector3d middle = *place * robot_.joints[wheel.joint].origin.translation();
      touch.push_back(middle - Eigen::Vector3d(0, 0, drive.wheel_radius));
      ground = touch.size() == 1 ? touch.back().z() : std::min(ground, touch.back().z());
    }
    const double low = ground + body_touching * drive.wheel_radius;
    for (const Shape& shape : whole_shapes(robot_)) {
      for (const Eigen::Vector3d& point : low_points(shape))
        if (point.z() < low) touch.push_back(point);
    }
    const Eigen::Vector3d centre = whole_mass(robot_).centre;
    constexpr int directions = 64;
    for (int i = 0; i < directions; ++i) {
      const double angle = body_turn * i / directions;
      const Eigen::Vector3d way(std::cos(angle), std::sin(angle), 0);
      const bool is_beyond = std::all_of(
          touch.begin(), touch.end(), [&](const Eigen::Vector3d& at) { return way.dot(centre - at) > body_outside; });
      if (!is_beyond) continue;
      return warn(0, "at rest the robot tips: its centre of mass, at x = " + print_number(rounded(centre.x())) +
                         " m, y = " + print_number(rounded(centre.y())) +
                         " m, lies beyond all that touches the ground; expected a caster or a wheel there");
    }
  }

 private:
  void turned(const Link& link, const Joint& joint, const Shape& cylinder) {
    const auto text = [](const Vector3d& v) {
      const auto clean = [](double c) { return print_number(std::abs(c) < 1e-3 ? 0 : std::round(c * 1000) / 1000); };
      return clean(v.x()) + ' ' + clean(v.y()) + ' ' + clean(v.z());
    };
    // Roll and pitch that lay z along the axle, and the other way round where the roll would be below 0.
    const Vector3d way = joint.axis.y() > 0 ? Vector3d(-joint.axis) : joint.axis;
    const double roll = std::asin(std::clamp(-way.y(), -1.0, 1.0));
    const double pitch = std::hypot(way.x(), way.z()) < 1e-9 ? 0 : std::atan2(way.x(), way.z());
    const Vector3d middle = cylinder.pose.translation();
    warn(link.line,
         "link '" + link.name + "': its collision cylinder lies along " + text(cylinder.pose.linear().col(2)) +
             ", and its joint '" + joint.name + "' turns about " + text(joint.axis) +
             ", so that the wheel stands on end; expected " +
             (is_mjcf_ ? "its <geom> turned, such as by euler=\"90 0 0\" (degrees)"
                       : "<origin " + (middle.norm() > 0 ? "xyz=\"" + text(middle) + "\" " : "") + "rpy=\"" +
                             print_exactly(roll) + " " + print_exactly(pitch) + " 0\"/> in its <collision>"));
  }

  static double rounded(double metres) { return std::round(metres * 1000) / 1000; }

  // Line 0: of the file as a whole.
  void warn(int line, const std::string& what) {
    robot_.warnings.push_back(source_.file + (line > 0 ? ":" + std::to_string(line) : "") + ": " + what);
  }

  const Source& source_;
  const bool is_mjcf_;
  Robot& robot_;
};

}  // namespace

void warn_of_body(const Source& source, bool is_mjcf, bool has_shapes, Robot& robot) {
  BodyDoubts doubts(source, is_mjcf, robot);
  if (doubts.is_in_millimetres()) return;
  doubts.centres_of_links();
  doubts.lasers();
  if (!robot.drive) return;
  doubts.wheels();
  doubts.torque();
  if (has_shapes) doubts.support();
}

}  // namespace muster::description
