// Lasers that sweep their plane: walls, doors, the ground and other robots.
#include <cmath>
#include <cstring>
#include <map>

#include "description/world_robots.hpp"
#include "fan.hpp"
#include "plugins/periods.hpp"
#include "plugins/scene_rows.hpp"
#include "scene/slabs.hpp"

namespace {

using namespace muster;
using description::WorldRobots;
using Eigen::Isometry3d;

Isometry3d frame_of(const Pose& p) {
  return Eigen::Translation3d(p.x, p.y, p.z) * Eigen::Quaterniond(p.qw, p.qx, p.qy, p.qz);
}

struct SensorsLaser {
  static constexpr auto id = "sensors.laser/1";
  static constexpr auto summary = "what the lasers on robots see: walls, doors, the ground, other robots";
  static constexpr auto manual =
      "Each <sensor> with a <ray> of a robot's model scans at its rate, or once a tick where that is slower; a scan "
      "is\n"
      "one message in scan/*/message, of one instant, and its rays are exact: the first place at which one enters a\n"
      "wall (as thick as it is, with its open doors), the ground, or another robot's body and wheels. To a range r\n"
      "white Gaussian noise is added, of standard deviation `noise` and, independently, `share` r; then it is rounded\n"
      "to the laser's resolution. Ranges above its max_range are infinite, below its min_range minus infinity\n"
      "(REP 117). A scan says where the robot's odometry had it, not where it was. Not seen are the robot itself,\n"
      "legs, limbs, level floors other than the ground, and meshes of the world. Wheels are seen as they stand at 0.";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {real("noise", 0, 0, 10, "m", "standard deviation of a range").free(),
                                     real("share", 0, 0, 1, "", "standard deviation of a range, of that range").free()};

  explicit SensorsLaser(Setup& s)
      : noise(s.value("noise")),
        share(s.value("share")),
        stream(s.stream("laser")),
        robots(s, description::Meshes::import),
        pose(s.read<Pose>("robot/*/pose")),
        odometry(s.read_if_any<Odometry>("robot/*/odometry")),
        wall(s.read<Wall>("wall/*/shape")),
        door(s.read<Door>("door/*/shape")),
        state(s.read<DoorState>("door/*/state")),
        scan(s.write<Scan>("scan/*/message", MUSTER_SENSED)),
        model(s.write<description::Model>("robot/*/laser_model")) {
    for (std::size_t row = 1; row <= robots.size(); ++row) {
      const auto* robot = robots.of(static_cast<double>(row));
      if (robot) solids.emplace(robot, solids_of(*robot));
    }
  }

  void step(const Step& k) const {
    for (std::size_t i = 0; i < k[model].size(); ++i) k[model][i] = {WorldRobots::model_of(k.last(model)[i].model, i)};
    std::vector<Solid> walls;
    bool has_walls = false;
    std::size_t sent = 0;
    for (std::size_t i = 0; i < k[model].size(); ++i) {
      const auto* robot = robots.of(k[model][i].model);
      if (!robot || !k.alive("robot", i)) continue;
      for (std::size_t n = 0; n < robot->sensors.size(); ++n) {
        const description::Sensor& sensor = robot->sensors[n];
        if (!is_to_scan(k, sensor)) continue;
        if (!has_walls) walls = walls_of(k);
        has_walls = true;
        send(k, sent++, i, n, sensor, seen(k, i, frame_of(k[pose][i]) * sensor.pose, sensor.laser, walls));
      }
    }
  }

 private:
  static bool is_to_scan(const Step& k, const description::Sensor& sensor) {
    return sensor.laser.max_range > 0 && (k.tick() == 0 || is_due(k.time(), k.dt(), 1 / sensor.rate));
  }

  std::vector<double> seen(const Step& k, std::size_t self, const Isometry3d& laser_pose,
                           const description::Laser& laser, const std::vector<Solid>& walls) const {
    // Includes hits that noise may bring within its range.
    Fan fan(laser, laser.max_range + 6 * deviation(k, laser.max_range));
    const Isometry3d world = laser_pose.inverse();
    for (const Solid& solid : walls) fan.meet(solid, world);
    fan.meet_ground(laser_pose.translation().z(), -world.linear().col(2));
    for (std::size_t other = 0; other < k[pose].size(); ++other) {
      const auto* robot = robots.of(k[model][other].model);
      if (!robot || other == self || !k.alive("robot", other)) continue;
      const Isometry3d body = world * frame_of(k[pose][other]);
      for (const Solid& solid : solids.at(robot)) fan.meet(solid, body);
    }
    return fan.ranges();
  }

  void send(const Step& k, std::size_t row, std::size_t robot, std::size_t number, const description::Sensor& sensor,
            std::vector<double> ranges) const {
    const description::Laser& laser = sensor.laser;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      ranges[i] = told(ranges[i] + error(k, robot, number, i, ranges[i]), laser);
    }
    std::string payload(ranges.size() * sizeof(double), '\0');
    std::memcpy(payload.data(), ranges.data(), payload.size());
    const auto believed = k[odometry];
    const bool knows = robot < believed.size();
    const Eigen::Vector3d at = sensor.pose.translation();
    const Eigen::Quaterniond turned(sensor.pose.linear());
    k.send(scan, row, payload) = {static_cast<double>(robot),
                                  static_cast<double>(number),
                                  periods_in(k.time(), 1 / sensor.rate),
                                  k.time(),
                                  knows ? believed[robot].x : null(),
                                  knows ? believed[robot].y : null(),
                                  knows ? believed[robot].yaw : null(),
                                  at.x(),
                                  at.y(),
                                  at.z(),
                                  turned.w(),
                                  turned.x(),
                                  turned.y(),
                                  turned.z(),
                                  laser.min_angle,
                                  laser.step(),
                                  laser.min_range,
                                  laser.max_range,
                                  0};
  }

  static double told(double range, const description::Laser& laser) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    if (laser.resolution > 0 && std::isfinite(range)) range = laser.resolution * std::round(range / laser.resolution);
    if (range < laser.min_range) return -infinite;
    return range > laser.max_range ? infinite : range;
  }

  double deviation(const Step& k, double range) const {
    return k.expected() ? 0 : std::hypot(k[noise], k[share] * range);
  }

  double error(const Step& k, std::size_t robot, std::size_t sensor, std::size_t ray, double range) const {
    if (!std::isfinite(range) || deviation(k, range) == 0) return 0;
    return deviation(k, range) * stream.of(k.key("robot", robot)).of(sensor).normal(k.tick(), ray);
  }

  std::vector<Solid> walls_of(const Step& k) const {
    std::vector<Solid> result;
    const auto walls = scene_walls(k[wall]);
    for (const scene::Slab& slab : scene::slabs(walls, scene_doors(k[door], k[state], k[wall]))) {
      Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
      turned.topLeftCorner<2, 2>() << slab.cos_yaw, -slab.sin_yaw, slab.sin_yaw, slab.cos_yaw;
      description::Shape shape;
      shape.pose.linear() = turned;
      shape.pose.translation() = Eigen::Vector3d(slab.x, slab.y, slab.z);
      shape.geometry = description::Box{{slab.length, slab.thickness, slab.height}};
      result.emplace_back(shape);
    }
    return result;
  }

  // A robot's body and its wheels, which are round and independent of their angle.
  static std::vector<Solid> solids_of(const description::Robot& robot) {
    std::vector<Solid> result;
    for (const auto& shape : rigid_shapes(robot, 0)) result.emplace_back(shape);
    if (!robot.drive) return result;
    for (const description::Follower& wheel : robot.drive->wheels()) {
      const description::Joint& joint = robot.joints[wheel.joint];
      const Isometry3d hub = *frame_on_body(robot, joint.parent) * joint.origin;
      for (description::Shape shape : rigid_shapes(robot, joint.child)) {
        shape.pose = hub * shape.pose;
        result.emplace_back(shape);
      }
    }
    return result;
  }

  Value noise, share;
  Stream stream;
  WorldRobots robots;
  In<Pose> pose;
  In<Odometry> odometry;
  In<Wall> wall;
  In<Door> door;
  In<DoorState> state;
  Out<Scan> scan;
  Out<description::Model> model;
  std::map<const description::Robot*, std::vector<Solid>> solids;
};

}  // namespace

MUSTER_PLUGIN_IS(SensorsLaser)
