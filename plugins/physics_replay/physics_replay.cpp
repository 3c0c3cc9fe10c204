// physics.replay: measured poses drive the bodies, so that everything else runs on the real course.
#include <cstdio>
#include <muster/plugin.hpp>
#include <optional>

#include "description/world_robots.hpp"
#include "plugins/table_times.hpp"
#include "track.hpp"

namespace {

using namespace muster;
using description::Model;
using description::WorldRobots;

struct Measured {
  static constexpr const char* columns = "t[s] robot:robot x[m] y[m] z[m]? yaw[rad]? qw? qx? qy? qz?";
  double t, robot, x, y, z, yaw, qw, qx, qy, qz;
};

struct PhysicsReplay {
  static constexpr auto id = "physics.replay/2";
  static constexpr auto summary = "measured poses drive the bodies, interpolated";
  static constexpr auto manual =
      "The file's columns are t[s],robot,x[m],y[m], z[m] (else the height stays), and yaw[rad] or qw,qx,qy,qz; others "
      "are not\n"
      "read. Between samples a body is carried evenly, by the shorter way round; before the first and after the last "
      "it stands;\n"
      "a robot that the file does not name stays where it is. twist is the mean over the step. Wheels turn as the "
      "motion\n"
      "says, without slip. Commands have no effect.";
  static constexpr auto phase = MUSTER_PHYSICS;
  static constexpr bool keeps_only_caches = true;
  static constexpr auto cannot_hold = "anything but the measured course: commands have no effect";
  static constexpr Param params[] = {file("file", "measured poses").required()};

  struct Course {
    replay::Track track;
    bool has_height = false;  // false: the height stays
  };

  explicit PhysicsReplay(Setup& s)
      : robots(s, description::Meshes::skip),
        times(s, "file"),
        measured(s.file<Measured>("file")),
        pose(s.write<Pose>("robot/*/pose")),
        twist(s.write<Twist>("robot/*/twist")),
        wheels(s.write<Wheels>("robot/*/wheels")),
        model(s.write<Model>("robot/*/body")) {
    if (robots.any_mecanum()) rear_wheels = s.write<Wheels>("robot/*/rear_wheels");
  }

  void read(const Step& k) {
    const auto rows = k[measured];
    courses.resize(k[pose].size());
    std::vector<Measured> last(courses.size());
    std::vector<std::size_t> first(courses.size());  // row
    std::vector<double> second(courses.size());      // [s]
    bool is_jumping = false;                         // told once
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Measured& m = rows[i];
      const auto robot = static_cast<std::size_t>(m.robot);
      if (robot >= courses.size()) continue;
      Course& course = courses[robot];
      const auto fail = [&](const char* what) {
        throw BadInput(times.rows().at(i) + "robot '" + std::string(k.name("robot", robot)) + "': " + what);
      };
      const auto warn = [&](const std::string& what) {
        k.event("warning: " + times.rows().at(i) + "robot '" + std::string(k.name("robot", robot)) + "': " + what);
      };
      if (course.track.empty()) course.has_height = !is_null(m.z), first[robot] = i;
      if (second[robot] <= rows[first[robot]].t) second[robot] = m.t;  // as long as it is that of the first
      if (course.has_height == is_null(m.z)) fail("z is given in some rows only");
      const auto turn = turn_of(m);
      if (!turn) fail(why_no_turn(m).c_str());
      if (const double jump = std::hypot(m.x - last[robot].x, m.y - last[robot].y), time = m.t - last[robot].t;
          !course.track.empty() && time > 0 && jump > fastest * time && !is_jumping) {
        is_jumping = true;
        warn("it moves by " + print(jump) + " m in " + print(time) + " s");
      }
      last[robot] = m;
      if (!course.track.append({m.t, {m.x, m.y, course.has_height ? m.z : 0}, *turn})) refuse_time(k, i, rows);
    }
    for (std::size_t i = 0; i < courses.size(); ++i) {
      if (!courses[i].track.empty())
        times.warn_of(k, {rows[first[i]].t, second[i], last[i].t, first[i]},
                      "the rows of robot '" + std::string(k.name("robot", i)) + "' are", "it never moves");
    }
    is_read = true;
  }

  [[noreturn]] void refuse_time(const Step& k, std::size_t row, Rows<const Measured> rows) const {
    std::size_t before = row - 1;
    while (rows[before].robot != rows[row].robot) --before;
    throw BadInput(times.rows().at(row, "t") + "robot '" +
                   std::string(k.name("robot", static_cast<std::size_t>(rows[row].robot))) +
                   "': time does not rise: " + print(rows[row].t) + " s after " + print(rows[before].t) +
                   " s; expected its rows in the order of time, each once");
  }

  static constexpr double fastest = 200;  // m/s; no robot is

  static std::string print(double value) {
    char text[32];
    return {text, static_cast<std::size_t>(std::snprintf(text, sizeof text, "%.6g", value))};
  }

  static std::string why_no_turn(const Measured& m) {
    const std::pair<const char*, double> parts[] = {{"qw", m.qw}, {"qx", m.qx}, {"qy", m.qy}, {"qz", m.qz}};
    std::string missing;
    for (const auto& [name, value] : parts)
      if (is_null(value)) missing += (missing.empty() ? "" : ", ") + std::string(name);
    const std::string what = "has neither yaw nor qw, qx, qy, qz of length 1: ";
    if (!missing.empty())
      return what + (missing == "qw, qx, qy, qz" ? "it has none of them; expected a column yaw[rad]"
                                                 : missing + " is missing");
    return what + "its length is " + print(std::sqrt(m.qw * m.qw + m.qx * m.qx + m.qy * m.qy + m.qz * m.qz));
  }

  static std::optional<Eigen::Quaterniond> turn_of(const Measured& m) {
    if (!is_null(m.qw) && !is_null(m.qx) && !is_null(m.qy) && !is_null(m.qz)) {
      const Eigen::Quaterniond q(m.qw, m.qx, m.qy, m.qz);
      if (std::abs(q.norm() - 1) > 1e-3) return std::nullopt;
      return q.normalized();
    }
    if (is_null(m.yaw)) return std::nullopt;
    return Eigen::Quaterniond(Eigen::AngleAxisd(m.yaw, Eigen::Vector3d::UnitZ()));
  }

  void step(const Step& k) {
    if (!is_read) read(k);
    for (std::size_t i = 0; i < k[pose].size(); ++i) {
      k[model][i].model = WorldRobots::model_of(k.last(model)[i].model, i);
      k[pose][i] = k.last(pose)[i];
      k[twist][i] = {0, 0, 0, 0, 0, 0};
      turn(k, wheels, i, 0, 0);
      if (rear_wheels) turn(k, *rear_wheels, i, 0, 0);
      if (i < courses.size() && !courses[i].track.empty() && k.alive("robot", i)) carry(k, i);
    }
  }

  void carry(const Step& k, std::size_t i) const {
    const Course& course = courses[i];
    const auto before = course.track.at(k.time() - k.dt()), now = course.track.at(k.time());
    const Eigen::Vector3d v = (now.place - before.place) / k.dt(), w = replay::turn_rate(before.turn, now.turn, k.dt());
    k[pose][i] = {now.place.x(), now.place.y(), course.has_height ? now.place.z() : k.last(pose)[i].z,
                  now.turn.w(),  now.turn.x(),  now.turn.y(),
                  now.turn.z()};
    k[twist][i] = {v.x(), v.y(), v.z(), w.x(), w.y(), w.z()};
    const auto* drive = robots.drive_of(k[model][i].model);
    if (!drive) return;
    const Eigen::Quaterniond heading = before.turn.slerp(0.5, now.turn);
    const double forward = v.dot(heading * Eigen::Vector3d::UnitX());
    if (drive->mecanum && rear_wheels) {
      const auto rates = drive->mecanum->rates({forward, v.dot(heading * Eigen::Vector3d::UnitY()), w.z()});
      turn(k, wheels, i, rates[0], rates[1]);
      turn(k, *rear_wheels, i, rates[2], rates[3]);
    } else {
      turn(k, wheels, i, drive->left_rate(forward, w.z()), drive->right_rate(forward, w.z()));
    }
  }

  static void turn(const Step& k, const Out<Wheels>& pair, std::size_t i, double left, double right) {
    const Wheels& last = k.last(pair)[i];
    k[pair][i] = {last.left + left * k.dt(), last.right + right * k.dt(), left, right};
  }

  WorldRobots robots;
  TableTimes times;
  In<Measured> measured;
  Out<Pose> pose;
  Out<Twist> twist;
  Out<Wheels> wheels;
  Out<Model> model;
  std::optional<Out<Wheels>> rear_wheels;  // if any robot has rollers
  std::vector<Course> courses;             // from the file alone, one for each robot
  bool is_read = false;
};

}  // namespace

MUSTER_PLUGIN_IS(PhysicsReplay)
