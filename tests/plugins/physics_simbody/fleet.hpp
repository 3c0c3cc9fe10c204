// Scarabs to drive, in tests and benchmarks.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "world.hpp"

namespace muster::simbody {

inline const description::Robot& scarab() {
  static const description::Robot robot =
      description::read_robot(MUSTER_SOURCE_DIR "/plugins/robots/models/scarab.urdf");
  return robot;
}

inline const description::Robot& hummingbird() {
  static const description::Robot robot =
      description::read_robot(MUSTER_SOURCE_DIR "/plugins/robots/models/hummingbird.urdf");
  return robot;
}

inline double yaw(const RobotState& s) { return 2 * std::atan2(s.pose[6], s.pose[3]); }

// Rates of forward speed v and turn rate w, and of their slopes.
inline Command command(double v, double w, double dv = 0, double dw = 0) {
  const auto& drive = *scarab().drive;
  return {drive.left_rate(v, w), drive.right_rate(v, w), drive.left_rate(dv, dw), drive.right_rate(dv, dw)};
}

// A robot that already rolls at its command's rates.
inline RobotState rolling(double x, double y, double heading, double v, double w) {
  RobotState s = at_rest(x, y, heading);
  s.twist = {v * std::cos(heading), v * std::sin(heading), 0, 0, 0, w};
  const Command c = command(v, w);
  s.rate = {c.left, c.right};
  return s;
}

// Some robots and the engine that moves them.
class Fleet {
 public:
  explicit Fleet(std::vector<RobotState> start, const description::Robot& model = scarab(),
                 Integrator integrator = Integrator::midpoint, double step = 1e-3)
      : states(std::move(start)), model_(model), integrator_(integrator), step_(step) {
    remake();
  }

  void remake() {
    std::vector<NamedRobot> robots;
    for (std::size_t i = 0; i < states.size(); ++i)
      robots.push_back({std::string("r").append(std::to_string(i)), &model_});
    engine_ = make_engine(robots, integrator_, step_);
    engine_->set_surroundings(slabs(walls_, {}), friction_);
  }

  // `friction` between bodies, and of bodies with walls.
  Fleet& among(std::vector<scene::Wall> walls, double friction) {
    walls_ = std::move(walls);
    friction_ = friction;
    remake();
    return *this;
  }
  const std::vector<scene::Wall>& walls() const { return walls_; }

  void tick(double dt, const std::vector<Command>& commands) { engine_->step(dt, commands, states); }

  // From time 0 to `until` in ticks of dt; v and w as a function of time, linear over a tick.
  void drive(double until, double dt, const std::function<Command(double)>& rates) {
    const int ticks = static_cast<int>(std::lround(until / dt));
    for (int k = 0; k < ticks; ++k) {
      const Command a = rates(k * dt), b = rates((k + 1) * dt);
      tick(dt,
           std::vector<Command>(states.size(), {a.left, a.right, (b.left - a.left) / dt, (b.right - a.right) / dt}));
    }
  }

  std::vector<RobotState> states;

 private:
  const description::Robot& model_;
  Integrator integrator_;
  double step_;
  std::vector<scene::Wall> walls_;
  double friction_ = 0.3;
  std::unique_ptr<Engine> engine_;
};

}  // namespace muster::simbody
