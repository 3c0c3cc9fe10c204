// RDK hexapods to walk in tests.
#pragma once

#include "legs.hpp"
#include "plugins/robots/tripod_gait.hpp"
#include "scarabs.hpp"

namespace muster::simbody {

inline const description::Robot& rdk() {
  static const description::Robot robot = description::read_robot(MUSTER_SOURCE_DIR "/plugins/robots/models/rdk.urdf");
  return robot;
}

inline description::Robot rigid_rdk() {
  description::Robot robot = rdk();
  robot.legs->stiffness = std::numeric_limits<double>::infinity();
  robot.legs->damping = 0;
  return robot;
}

// Straight ahead from rest: legs take the full sweep as they are upright or straight up for the first time.
struct Walk {
  static constexpr double duty = 0.65, sweep = 1, begin = 0.25;
  double frequency;  // [Hz]

  // Of the first tripod's stance [cycles].
  double phase(double t) const { return 0.25 + frequency * std::max(0.0, t - begin); }
  double angle(double t, int tripod) const {
    const double own = phase(t) + 0.5 * tripod;
    return clock_angle(own, own < (tripod == 0 ? 0.5 : 1.0) ? 0 : sweep, duty);
  }
  Command over(double t, double dt) const {
    Command c{};
    for (std::size_t i = 0; i < 6; ++i) {
      const int tripod = rdk().legs->legs[i].tripod;
      c.leg_angle[i] = angle(t, tripod);
      c.leg_rate[i] = std::remainder(angle(t + dt, tripod) - c.leg_angle[i], whole_turn) / dt;
    }
    return c;
  }
  double stride() const { return stride_of(sweep, duty, rdk().legs->radius); }
};

// Walks to `until` in ticks of dt; calls after(t) at the end of each.
template <class After>
void walk(Fleet& fleet, const Walk& gait, double from, double until, double dt, After after) {
  for (long k = std::lround(from / dt); k < std::lround(until / dt); ++k) {
    const double t = static_cast<double>(k) * dt;
    fleet.tick(dt, std::vector<Command>(fleet.states.size(), gait.over(t, dt)));
    after(t + dt);
  }
}

// Height of a leg's lowest point over the ground [m].
inline double foot_height(const RobotState& s, std::size_t leg, const RobotModel& model) {
  const Eigen::Matrix3d turned = Eigen::Quaterniond(s.pose[3], s.pose[4], s.pose[5], s.pose[6]).toRotationMatrix();
  const Eigen::Vector3d up = turned.row(2);
  const double angle = s.leg_angle[leg], way = model.leg_drive.lowest_way(angle, up);
  return s.pose[2] + up.dot(model.legs[leg].hip + model.leg_drive.place(angle, way));
}

}  // namespace muster::simbody
