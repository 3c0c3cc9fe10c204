// Inertial measurement: specific force and angular rate of a place on a robot's body.
#include <algorithm>
#include <array>
#include <cmath>
#include <muster/plugin.hpp>
#include <muster/senses.hpp>

#include "bearer.hpp"
#include "plugins/periods.hpp"
#include "turn.hpp"

namespace {

using namespace muster;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

struct SensorsImu {
  static constexpr auto id = "sensors.imu/1";
  static constexpr auto summary = "accelerometer and gyroscope of a robot: specific force and angular rate";
  static constexpr auto manual =
      R"(At `rate` a robot's IMU reports robot/*/imu: its specific force (acceleration less gravity: at rest 9.81 m/s2
upwards) and its angular rate, in its own axes, which `roll`, `pitch` and `yaw` (about x, y, z of the body, in this
order) turn from the body's, at the place x, y, z of the body. The instance serves `robot`, or all robots that no other
instance names.
No backend states accelerations, so they follow from velocities: the acceleration that, constant in the body's turning
axes, makes the change of the place's velocity over the last step of this instance. That is exact at rest, in straight
and in circular motion and in free fall, and otherwise the mean over the step; impacts last as long as the step. Gravity
and the angular rate are those at its end. The first reading comes one step after the start.
A reading = (1 + scale) x truth + bias + noise, within +-range. The bias is the given constant plus a random walk, whose
standard deviation grows by `walk` times the root of time. White noise has standard deviation density x sqrt(rate of
readings), so that its Allan variance is density^2 / tau, and that of the walk walk^2 tau / 3. Each robot draws its own.
Not modelled: misalignment and cross-axis terms, temperature, vibration, quantisation, g-sensitivity of the gyroscope.)";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {
      bearer_param(),
      real("rate", 0, 0, 1e6, "Hz", "of readings, at most one a step; 0: each step"),
      real("x", 0, -1e3, 1e3, "m", "its place on the body, forward"),
      real("y", 0, -1e3, 1e3, "m", "to the left"),
      real("z", 0, -1e3, 1e3, "m", "up"),
      real("roll", 0, -6.3, 6.3, "rad", "its turn about the body's x"),
      real("pitch", 0, -6.3, 6.3, "rad", "then about y"),
      real("yaw", 0, -6.3, 6.3, "rad", "then about z"),
      real("gravity", 9.81, 0, 100, "m/s2", "at the place of the world"),
      real("accel_noise", 0, 0, 100, "m/s2/sqrt(Hz)", "density of white noise of specific force").free(),
      real("accel_walk", 0, 0, 100, "m/s2/sqrt(s)", "random walk of its bias").free(),
      real("accel_bias_x", 0, -100, 100, "m/s2", "constant part of its bias, along the sensor's x").free(),
      real("accel_bias_y", 0, -100, 100, "m/s2", "along y").free(),
      real("accel_bias_z", 0, -100, 100, "m/s2", "along z").free(),
      real("accel_scale", 0, -0.9, 9, "", "error of its scale, as a share").free(),
      real("accel_range", 1e6, 0, 1e6, "m/s2", "largest specific force that it can tell"),
      real("gyro_noise", 0, 0, 100, "rad/s/sqrt(Hz)", "density of white noise of angular rate").free(),
      real("gyro_walk", 0, 0, 100, "rad/s/sqrt(s)", "random walk of its bias").free(),
      real("gyro_bias_x", 0, -100, 100, "rad/s", "constant part of its bias, about the sensor's x").free(),
      real("gyro_bias_y", 0, -100, 100, "rad/s", "about y").free(),
      real("gyro_bias_z", 0, -100, 100, "rad/s", "about z").free(),
      real("gyro_scale", 0, -0.9, 9, "", "error of its scale, as a share").free(),
      real("gyro_range", 1e6, 0, 1e6, "rad/s", "largest angular rate that it can tell"),
  };

  // The body at the last step, and the walks of the biases. `of`: 1 + the robot's row; a robot that joins as a copy of
  // another starts anew.
  struct Before {
    static constexpr const char* columns =
        "of vx[m/s] vy[m/s] vz[m/s] wx[rad/s] wy[rad/s] wz[rad/s] qw qx qy qz walk1[m/s2] walk2[m/s2] walk3[m/s2] "
        "walk4[rad/s] walk5[rad/s] walk6[rad/s]";
    double of, v[3], w[3], q[4], walk[6];
  };

  // One half of the sensor.
  struct Part {
    Part(const Setup& s, const std::string& name)
        : density(s.value((name + "_noise").c_str())),
          walk(s.value((name + "_walk").c_str())),
          bias{s.value((name + "_bias_x").c_str()), s.value((name + "_bias_y").c_str()),
               s.value((name + "_bias_z").c_str())},
          scale(s.value((name + "_scale").c_str())),
          range(s.value((name + "_range").c_str())) {}
    Value density, walk, bias[3], scale, range;
  };

  explicit SensorsImu(Setup& s)
      : bearer(s),
        rate(s.value("rate")),
        gravity(s.value("gravity")),
        mount{s.value("x"), s.value("y"), s.value("z")},
        angles{s.value("roll"), s.value("pitch"), s.value("yaw")},
        accel(s, "accel"),
        gyro(s, "gyro"),
        stream(s.stream("imu")),
        pose(s.read<Pose>("robot/*/pose")),
        twist(s.read<Twist>("robot/*/twist")),
        reading(s.write<Imu>(bearer.table("imu"), MUSTER_SENSED | bearer.flags())),
        before(s.write<Before>(bearer.table("imu_before"), bearer.flags())) {}

  void step(const Step& k) const {
    for (std::size_t i = 0; i < k[reading].size(); ++i) {
      const std::size_t robot = bearer.robot_of(i);
      const Before& last = k.last(before)[i];
      const bool knows = last.of == static_cast<double>(robot + 1);
      k[reading][i] = knows ? k.last(reading)[i] : Imu{null(), null(), null(), null(), null(), null(), null()};
      k[before][i] = now(k, robot, knows ? last : Before{});
      if (!knows || !k.alive("robot", robot) || !is_to_tell(k)) continue;
      k[reading][i] = read(k, robot, last, k[before][i]);
    }
  }

 private:
  bool is_to_tell(const Step& k) const { return k[rate] <= 0 || is_due(k.time(), k.dt(), 1 / k[rate]); }
  double period(const Step& k) const { return k[rate] > 0 ? std::max(k.dt(), 1 / k[rate]) : k.dt(); }

  Before now(const Step& k, std::size_t robot, const Before& last) const {
    const Pose& p = k[pose][robot];
    const Twist& t = k[twist][robot];
    Before result{static_cast<double>(robot + 1), {t.vx, t.vy, t.vz}, {t.wx, t.wy, t.wz}, {p.qw, p.qx, p.qy, p.qz}, {}};
    for (unsigned axis = 0; axis < 6; ++axis)
      result.walk[axis] =
          last.walk[axis] + drawn(k, robot, axis, k[axis < 3 ? accel.walk : gyro.walk] * std::sqrt(k.dt()));
    return result;
  }

  Imu read(const Step& k, std::size_t robot, const Before& from, const Before& to) const {
    const Quaterniond at_first = attitude(from), at_last = attitude(to);
    const Vector3d place(k[mount[0]], k[mount[1]], k[mount[2]]);
    const Vector3d gain = velocity(to, at_last, place) - velocity(from, at_first, place);
    const Vector3d acceleration =
        mean_rotation(turn_between(at_first, at_last)).inverse() * (at_first.conjugate() * gain) / k.dt();
    const Vector3d force = acceleration + at_last.conjugate() * Vector3d(0, 0, k[gravity]);
    const Matrix3d to_sensor =
        (Eigen::AngleAxisd(k[angles[2]], Vector3d::UnitZ()) * Eigen::AngleAxisd(k[angles[1]], Vector3d::UnitY()) *
         Eigen::AngleAxisd(k[angles[0]], Vector3d::UnitX()))
            .toRotationMatrix()
            .transpose();
    const Vector3d f = told(k, robot, accel, 0, to_sensor * force, to.walk);
    const Vector3d w = told(k, robot, gyro, 3, to_sensor * (at_last.conjugate() * vector(to.w)), to.walk + 3);
    return {k.time(), f.x(), f.y(), f.z(), w.x(), w.y(), w.z()};
  }

  Vector3d told(const Step& k, std::size_t robot, const Part& part, unsigned first, const Vector3d& truth,
                const double* walk) const {
    const double most = k[part.range], deviation = k[part.density] / std::sqrt(period(k));
    Vector3d result;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const double error = k[part.bias[axis]] + walk[axis] + drawn(k, robot, 6 + first + axis, deviation);
      result[axis] = std::clamp((1 + k[part.scale]) * truth[axis] + error, -most, most);
    }
    return result;
  }

  double drawn(const Step& k, std::size_t robot, unsigned number, double deviation) const {
    if (k.expected() || deviation == 0) return 0;
    return deviation * stream.of(k.key("robot", robot)).normal(k.tick(), number);
  }

  static Vector3d vector(const double (&v)[3]) { return {v[0], v[1], v[2]}; }
  static Quaterniond attitude(const Before& at) { return Quaterniond(at.q[0], at.q[1], at.q[2], at.q[3]).normalized(); }
  static Vector3d velocity(const Before& body, const Quaterniond& attitude, const Vector3d& place) {
    return vector(body.v) + vector(body.w).cross(attitude * place);
  }

  Bearer bearer;
  Value rate, gravity;
  std::array<Value, 3> mount, angles;
  Part accel, gyro;
  Stream stream;
  In<Pose> pose;
  In<Twist> twist;
  Out<Imu> reading;
  Out<Before> before;
};

}  // namespace

MUSTER_PLUGIN_IS(SensorsImu)
