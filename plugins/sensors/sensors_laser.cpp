// Lasers that sweep their plane: walls, doors, the ground and other robots.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <sstream>

#include "body_frame.hpp"
#include "description/world_robots.hpp"
#include "fan.hpp"
#include "plugins/periods.hpp"
#include "plugins/scene_rows.hpp"
#include "plugins/table_rows.hpp"
#include "robot_solids.hpp"
#include "scene/slabs.hpp"
#include "sweep.hpp"

namespace {

using namespace muster;
using description::WorldRobots;
using Eigen::Isometry3d;

std::string seconds_text(double seconds) {
  char digits[32];
  return std::string(digits, std::to_chars(digits, digits + sizeof digits, seconds).ptr) + " s";
}

struct SensorsLaser {
  static constexpr auto id = "sensors.laser/3";
  static constexpr auto summary = "what the lasers on robots see: walls, doors, the ground, other robots";
  static constexpr auto manual =
      "Each <sensor> with a <ray> of a robot's model scans at its rate, or once a tick where that is slower; a scan "
      "is\n"
      "one message in scan/*/message, of one instant, and its rays are exact: the first place at which one enters a\n"
      "wall (as thick as it is, with its open doors), the ground, or another robot's body and wheels. To a range r\n"
      "white Gaussian noise is added, of standard deviation `noise` and, independently, `share` r; then it is rounded\n"
      "to the laser's resolution. Ranges above its max_range are infinite, below its min_range minus infinity\n"
      "(REP 117). A scan says where the robot's odometry had it, not where it was. Not seen are the robot itself,\n"
      "legs, limbs, level floors other than the ground, and meshes of the world. Wheels are seen as they stand at 0.\n"
      "Further errors, none by default: `biases` tabulates what is added at a range, in straight lines between its "
      "rows\n"
      "and even beyond them. With a width `beam` a reading is the mean of nine rays across it, of those that hit, so "
      "that\n"
      "at an edge it lies between two surfaces. A beam is lost (infinite) with probability\n"
      "drop + drop_far (r/max_range)^2. With `sweep` a scan takes that long from its first ray to its last: each ray "
      "is\n"
      "cast from where the robot is at its time (others are where the tick leaves them), the scan is sent when the "
      "last\n"
      "is there, and its time and odometry are those of its start.";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {real("noise", 0, 0, 10, "m", "standard deviation of a range").free(),
                                     real("share", 0, 0, 1, "", "standard deviation of a range, of that range").free(),
                                     file("biases", "a table range[m],bias[m] of what is added at a range, rising"),
                                     real("beam", 0, 0, 0.5, "rad", "full width of a beam; 0: a ray"),
                                     real("drop", 0, 0, 1, "", "share of beams that is lost"),
                                     real("drop_far", 0, 0, 1, "", "further share of them at the largest range"),
                                     real("sweep", 0, 0, 1e3, "s", "from a scan's first ray to its last")};

  // What is added to a range.
  struct RangeBias {
    static constexpr const char* columns = "range[m] bias[m] .";
    double range, bias;
  };

  explicit SensorsLaser(Setup& s)
      : noise(s.value("noise")),
        share(s.value("share")),
        beam(s.value("beam")),
        drop(s.value("drop")),
        drop_far(s.value("drop_far")),
        sweep(s.value("sweep")),
        stream(s.stream("laser")),
        robots(s, description::Meshes::import),
        pose(s.read<Pose>("robot/*/pose")),
        odometry(s.read_if_any<Odometry>("robot/*/odometry")),
        wall(s.read<Wall>("wall/*/shape")),
        door(s.read<Door>("door/*/shape")),
        state(s.read<DoorState>("door/*/state")),
        scan(s.write<Scan>("scan/*/message", MUSTER_SENSED)),
        model(s.write<description::Model>("robot/*/laser_model")) {
    if (!s.text("biases").empty()) {
      biases = s.file<RangeBias>("biases");
      places.emplace(s, "biases");
    }
    if (s.param("sweep") > 0) sweeps = s.write<Sweeps>("robot/*/laser_sweeps");
    for (std::size_t row = 1; row <= robots.size(); ++row) {
      const auto* robot = robots.of(static_cast<double>(row));
      if (robot) solids.emplace(robot, solids_of(*robot));
    }
    for (const auto& [robot, shapes] : solids)
      for (const auto& sensor : robot->sensors) reach = std::max(reach, sensor.laser.max_range);
    warn_of_none(s);
    warn_of_noise(s);
  }

  // A deviation in millimetres: readings would be noise alone.
  void warn_of_noise(const Setup& s) const {
    const double given = s.param("noise");
    if (reach > 0 && given > reach)
      s.warn("self", "attribute \"noise\": " + in_words(given) + " m is more than the laser's range of " +
                         in_words(reach) + " m; are these millimetres? " + in_words(given) + " mm are " +
                         in_words(given / 1000) + " m");
  }

  static std::string in_words(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
  }

  // Robots are there, and none of them has a laser.
  void warn_of_none(const Setup& s) const {
    bool has_laser = robots.size() == 0;
    for (const auto& [robot, shapes] : solids) has_laser |= !robot->sensors.empty();
    if (!has_laser)
      s.warn("self",
             "no robot's model has a laser, so that scan/*/message stays empty; expected a model with one, such as "
             "scarab, or a file of fittings with <sensor>");
  }

  void step(const Step& k) const {
    for (std::size_t i = 0; i < k[model].size(); ++i) k[model][i] = {WorldRobots::model_of(k.last(model)[i].model, i)};
    check_biases(k);
    if (sweeps) return go_on(k);
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
        send(k, sent++, i, n, sensor, begun(k, i, sensor),
             seen(k, i, frame_of(k[pose][i]) * sensor.pose, sensor.laser, walls));
      }
    }
  }

 private:
  static bool is_to_scan(const Step& k, const description::Sensor& sensor) {
    return sensor.laser.max_range > 0 && (k.tick() == 0 || is_due(k.time(), k.dt(), 1 / sensor.rate));
  }

  // Scans that take their time: the rays whose turn came since the last tick.
  void go_on(const Step& k) const {
    const std::vector<Solid> walls = walls_of(k);
    std::size_t sent = 0;
    for (std::size_t i = 0; i < k[model].size(); ++i) {
      const auto* robot = robots.of(k[model][i].model);
      const Sweeps& last = k.last(*sweeps)[i];
      const bool knows = last.of == static_cast<double>(i + 1);
      const Pose& now = k[pose][i];
      k[*sweeps][i] = {static_cast<double>(i + 1), now.x, now.y, now.z, now.qw, now.qx, now.qy, now.qz, 0};
      if (!robot || !k.alive("robot", i)) continue;
      const Isometry3d to = frame_of(now);
      const Isometry3d from = knows ? frame_of({last.x, last.y, last.z, last.qw, last.qx, last.qy, last.qz}) : to;
      auto scans = sweeps_of(knows ? k.last_bytes(*sweeps, i, Sweeps::scans_column) : "", robot->sensors.size());
      for (std::size_t n = 0; n < scans.size(); ++n) {
        const description::Sensor& sensor = robot->sensors[n];
        if (sensor.laser.max_range > 0 && k[sweep] > 1 / sensor.rate)
          throw BadInput("attribute \"sweep\": the laser " + sensor.name + " scans every " +
                         seconds_text(1 / sensor.rate) + "; expected at most that");
        // A scan that ends as the next begins has its last rays first.
        cast(k, i, sensor, scans[n], from, to, walls);
        sent += is_sent(k, sent, i, n, sensor, scans[n]);
        if (!is_to_scan(k, sensor)) continue;
        scans[n] = begun(k, i, sensor);
        cast(k, i, sensor, scans[n], from, to, walls);
        sent += is_sent(k, sent, i, n, sensor, scans[n]);
      }
      k.put_bytes(*sweeps, i, Sweeps::scans_column, bytes_of(scans));
    }
  }

  void cast(const Step& k, std::size_t self, const description::Sensor& sensor, Sweep& scan_so_far,
            const Isometry3d& from, const Isometry3d& to, const std::vector<Solid>& walls) const {
    if (scan_so_far.is_on == 0) return;
    const description::Laser& laser = sensor.laser;
    const auto rays = static_cast<std::size_t>(laser.samples);
    for (std::size_t ray = scan_so_far.ranges.size(); ray < rays; ++ray) {
      const double way = rays > 1 ? static_cast<double>(ray) / static_cast<double>(rays - 1) : 0;
      const double left = k.time() - (scan_so_far.t + way * k[sweep]);  // since its turn [s]
      if (left < -1e-9 * k.dt()) return;
      description::Laser one = laser;
      one.samples = 1;
      one.min_angle = one.max_angle = laser.min_angle + static_cast<double>(ray) * laser.step();
      const Isometry3d at = between(from, to, 1 - std::clamp(left / k.dt(), 0.0, 1.0)) * sensor.pose;
      scan_so_far.ranges.push_back(seen(k, self, at, one, walls)[0]);
    }
  }

  bool is_sent(const Step& k, std::size_t row, std::size_t robot, std::size_t number, const description::Sensor& sensor,
               Sweep& done) const {
    if (done.is_on == 0 || done.ranges.size() < static_cast<std::size_t>(sensor.laser.samples)) return false;
    send(k, row, robot, number, sensor, done, done.ranges);
    done = {};
    return true;
  }

  Sweep begun(const Step& k, std::size_t robot, const description::Sensor& sensor) const {
    const auto believed = k[odometry];
    const bool knows = robot < believed.size();
    return {1,
            k.time(),
            periods_in(k.time(), 1 / sensor.rate),
            knows ? believed[robot].x : null(),
            knows ? believed[robot].y : null(),
            knows ? believed[robot].yaw : null(),
            {}};
  }

  // Of beams: the mean of rays across each, of those that hit.
  std::vector<double> seen(const Step& k, std::size_t self, const Isometry3d& laser_pose,
                           const description::Laser& laser, const std::vector<Solid>& walls) const {
    if (k[beam] == 0) return rays_seen(k, self, laser_pose, laser, walls);
    constexpr int across = 9;
    std::vector<double> sum(static_cast<std::size_t>(laser.samples), 0), hits = sum;
    for (int j = 0; j < across; ++j) {
      description::Laser beside = laser;
      const double off = k[beam] * ((j + 0.5) / across - 0.5);
      beside.min_angle += off;
      beside.max_angle += off;
      const auto ranges = rays_seen(k, self, laser_pose, beside, walls);
      for (std::size_t i = 0; i < sum.size(); ++i) {
        if (!(ranges[i] <= reach_with_errors(k, laser))) continue;
        sum[i] += ranges[i];
        ++hits[i];
      }
    }
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] = hits[i] > 0 ? sum[i] / hits[i] : std::numeric_limits<double>::infinity();
    return sum;
  }

  std::vector<double> rays_seen(const Step& k, std::size_t self, const Isometry3d& laser_pose,
                                const description::Laser& laser, const std::vector<Solid>& walls) const {
    Fan fan(laser, reach_with_errors(k, laser));
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
            const Sweep& start, std::vector<double> ranges) const {
    const description::Laser& laser = sensor.laser;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const double range = ranges[i];
      ranges[i] = told(range + error(k, robot, number, i, range), laser);
      if (is_lost(k, robot, number, i, range / laser.max_range)) ranges[i] = std::numeric_limits<double>::infinity();
    }
    std::string payload(ranges.size() * sizeof(double), '\0');
    std::memcpy(payload.data(), ranges.data(), payload.size());
    const Eigen::Vector3d at = sensor.pose.translation();
    const Eigen::Quaterniond turned(sensor.pose.linear());
    k.send(scan, row, payload) = {static_cast<double>(robot),
                                  static_cast<double>(number),
                                  start.id,
                                  start.t,
                                  start.x,
                                  start.y,
                                  start.yaw,
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

  // Includes hits that noise or a bias may bring within its range.
  double reach_with_errors(const Step& k, const description::Laser& laser) const {
    return laser.max_range + 6 * deviation(k, laser.max_range) + most_shortened(k);
  }

  double deviation(const Step& k, double range) const {
    return k.expected() ? 0 : std::hypot(k[noise], k[share] * range);
  }

  double error(const Step& k, std::size_t robot, std::size_t sensor, std::size_t ray, double range) const {
    if (!std::isfinite(range)) return 0;
    const double bias = bias_at(k, range);
    if (deviation(k, range) == 0) return bias;
    return bias + deviation(k, range) * stream.of(k.key("robot", robot)).of(sensor).normal(k.tick(), ray);
  }

  bool is_lost(const Step& k, std::size_t robot, std::size_t sensor, std::size_t ray, double share_of_range) const {
    const double lost = k[drop] + k[drop_far] * share_of_range * share_of_range;
    if (k.expected() || !(lost > 0) || !std::isfinite(lost)) return false;
    return stream.of(k.key("robot", robot)).of(sensor).of(1).uniform(k.tick(), ray) < lost;
  }

  void check_biases(const Step& k) const {
    if (!biases) return;
    const auto rows = k[*biases];
    for (std::size_t i = 1; i < rows.size(); ++i) {
      if (!(rows[i].range > rows[i - 1].range))
        throw BadInput(places->at(i, "range") + "the range does not rise: " + in_words(rows[i].range) + " m after " +
                       in_words(rows[i - 1].range) + " m; expected each above the one before");
    }
    if (k.tick() == 0 && reach > 0 && !rows.empty() && rows[rows.size() - 1].range > beyond * reach)
      k.event("warning: " + places->at(rows.size() - 1, "range") + "a range of " +
              in_words(rows[rows.size() - 1].range) + " m, and no laser here reaches further than " + in_words(reach) +
              " m; expected metres; are these millimetres?");
  }

  static constexpr double beyond = 3;  // times the reach of a laser, up to which a calibration may go

  double bias_at(const Step& k, double range) const {
    if (!biases || k[*biases].empty()) return 0;
    const auto rows = k[*biases];
    const auto* after =
        std::lower_bound(rows.begin(), rows.end(), range, [](const RangeBias& row, double r) { return row.range < r; });
    if (after == rows.begin()) return after->bias;
    const RangeBias& from = *(after - 1);
    if (after == rows.end()) return from.bias;
    return from.bias + (after->bias - from.bias) * (range - from.range) / (after->range - from.range);
  }

  // By how much a bias may shorten a range [m].
  double most_shortened(const Step& k) const {
    double least = 0;
    if (biases)
      for (const RangeBias& row : k[*biases]) least = std::min(least, row.bias);
    return -least;
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

  static std::vector<Solid> solids_of(const description::Robot& robot) {
    const auto shapes = seen_of(robot);
    return {shapes.begin(), shapes.end()};
  }

  Value noise, share, beam, drop, drop_far, sweep;
  Stream stream;
  WorldRobots robots;
  In<Pose> pose;
  In<Odometry> odometry;
  In<Wall> wall;
  In<Door> door;
  In<DoorState> state;
  std::optional<In<RangeBias>> biases;
  std::optional<TableRows> places;    // of them
  double reach = 0;                   // of the lasers [m]
  std::optional<Out<Sweeps>> sweeps;  // of scans that take their time
  Out<Scan> scan;
  Out<description::Model> model;
  std::map<const description::Robot*, std::vector<Solid>> solids;
};

}  // namespace

MUSTER_PLUGIN_IS(SensorsLaser)
