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
No backend states accelerations, and velocities are means over a backend's own steps, so acceleration is the second
difference of the place over the last two steps of this instance: the one that, constant in the turning body's axes,
leads through these three places. That is exact at rest, in straight and in circular motion and in free fall, and
otherwise a mean over two steps; impacts last as long. A reading is of the middle one of the three, so it is told one
step after its `t`, with the angular rate and the gravity of then. The first comes two steps after the start.
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

  // The body at the last step and the one before, its turn rate at the last, and the walks of the biases. `of`: 1 + the
  // robot's row; a robot that joins as a copy of another starts anew. steps: how many of the two are known.
  struct Before {
    static constexpr const char* columns =
        "of steps x[m] y[m] z[m] qw qx qy qz x0[m] y0[m] z0[m] q0w q0x q0y q0z wx[rad/s] wy[rad/s] wz[rad/s] "
        "walk1[m/s2] walk2[m/s2] walk3[m/s2] walk4[rad/s] walk5[rad/s] walk6[rad/s]";
    double of, steps;
    Pose last, earlier;
    double w[3], walk[6];
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
      if (!knows || last.steps < 2 || !k.alive("robot", robot) || !is_to_tell(k)) continue;
      k[reading][i] = read(k, robot, last, k[before][i].walk);
    }
  }

 private:
  bool is_to_tell(const Step& k) const { return k[rate] <= 0 || is_due(k.time(), k.dt(), 1 / k[rate]); }
  double period(const Step& k) const { return k[rate] > 0 ? std::max(k.dt(), 1 / k[rate]) : k.dt(); }

  Before now(const Step& k, std::size_t robot, const Before& last) const {
    const Twist& t = k[twist][robot];
    Before result{static_cast<double>(robot + 1),
                  std::min(2.0, last.steps + 1),
                  k[pose][robot],
                  last.last,
                  {t.wx, t.wy, t.wz},
                  {}};
    for (unsigned axis = 0; axis < 6; ++axis) {
      const double deviation = k[axis < 3 ? accel.walk : gyro.walk] * std::sqrt(k.dt());
      result.walk[axis] = last.walk[axis] + drawn(k, robot, axis, deviation);
    }
    return result;
  }

  Imu read(const Step& k, std::size_t robot, const Before& known, const double* walk) const {
    const Pose& next = k[pose][robot];
    const Quaterniond attitude = attitude_of(known.last);
    const Vector3d bent = (place(k, next) - place(k, known.last)) - (place(k, known.last) - place(k, known.earlier));
    const Vector3d acceleration =
        unrolled(attitude.conjugate() * bent, turn_between(attitude, attitude_of(next))) / (k.dt() * k.dt());
    const Vector3d force = acceleration + attitude.conjugate() * Vector3d(0, 0, k[gravity]);
    const Matrix3d to_sensor =
        (Eigen::AngleAxisd(k[angles[2]], Vector3d::UnitZ()) * Eigen::AngleAxisd(k[angles[1]], Vector3d::UnitY()) *
         Eigen::AngleAxisd(k[angles[0]], Vector3d::UnitX()))
            .toRotationMatrix()
            .transpose();
    const Vector3d turning(known.w[0], known.w[1], known.w[2]);
    const Vector3d f = told(k, robot, accel, 0, to_sensor * force, walk);
    const Vector3d w = told(k, robot, gyro, 3, to_sensor * (attitude.conjugate() * turning), walk + 3);
    return {k.time() - k.dt(), f.x(), f.y(), f.z(), w.x(), w.y(), w.z()};
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

  Vector3d place(const Step& k, const Pose& body) const {
    return Vector3d(body.x, body.y, body.z) + attitude_of(body) * Vector3d(k[mount[0]], k[mount[1]], k[mount[2]]);
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
