// The backends of physics, their claims, and robots that start in motion in them.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <optional>

#include "description/robot.hpp"
#include "tests/run_world.hpp"

namespace muster::test {

using Attributes = std::map<std::string, std::string>;

struct Backend {
  std::string name, plugin;
  Attributes attributes;
  bool has_step = false;  // shorter than the tick
  Attributes smooth{};    // bodies without friction
  // Abilities.
  bool height = false;             // falls and lands
  bool slip = false;               // friction is bounded
  bool torque = false;             // motors are
  bool round_friction = false;     // bounded alike in every direction
  bool load_transfer = false;      // friction's bound includes the weight that friction itself shifts
  bool rotors = false;             // lift and turn a robot
  bool bouncing = false;           // off the surface that it lands on
  bool bounces_on_wheels = false;  // too
  std::string pendulum{};          // the joint that may carry one: "hip" or "axle" (of a wheel without balance)
  bool limbs = false;              // on hinges and balls that no motor turns
  bool pushed = false;             // robots that nothing drives
  int order = 0;                   // of convergence; 0: the solver's own error hides it
  double coarsest_of_order = 0;    // the step from which it shows [s]
  int flight_order = 0;            // of convergence in the air
  // Tolerances.
  double fall = 0;       // after 1 s of it [m]
  double rest = 0;       // drift in 2 s [m], [rad]
  double arc = 0;        // of the radius, relative
  double course = 0;     // at the end of 4 s of S-bends in ticks of 10 ms [m]
  double ramp = 0;       // of 1 m of speeding up [m]
  double climb = 0;      // of 5 m in 1 s, by rotors that speed up from rest [m]
  double spin = 0;       // of the momentum of tumbling for 2 s, relative
  double collision = 0;  // of the momentum of two that meet in the air, relative
  double bounce = 0;     // after a fall of 0.3 m [m/s]
  double parting = 0;    // at most, of two that meet without bouncing [m/s]
  double apex = 0;       // of the heights of a bouncing body, relative
  double slide = 0;      // of a box's sliding distance and of a ball's speed after it, relative
  double force = 0;      // of a robot's sliding distance, and of an acceleration at the limit of torque, relative
  double swing = 0;      // of a pendulum's period, relative
};
inline void PrintTo(const Backend& backend, std::ostream* out) { *out << backend.name; }

// Search path of plugins.
Options search(int workers = 1);

// The one that MUSTER_BACKEND names, with its claims (given_backend.cpp); null if it is not set.
std::optional<Backend> given_backend();

// All backends; and those of them that were built, with the given one.
std::vector<Backend> table();
std::vector<Backend> backends();
inline std::string test_name(const testing::TestParamInfo<Backend>& info) { return info.param.name; }

InstanceDeclaration instance(const Backend& backend, const Attributes& more = {});

// No steps shorter than the tick.
Attributes whole_ticks(const Backend& backend);

struct State {
  Pose pose;
  Twist twist;
  double distance(double x, double y) const { return std::hypot(pose.x - x, pose.y - y); }
  double speed() const { return std::hypot(twist.vx, twist.vy, twist.vz); }
};

State state(const Simulation& run, const std::string& robot = "a");

template <class Row>
bool same_bits(const Row& a, const Row& b) {
  return std::memcmp(&a, &b, sizeof(Row)) == 0;
}

inline const std::string models = MUSTER_SOURCE_DIR "/plugins/robots/models/";
constexpr double gravity = 9.81, radius = 0.05, half_base = 0.105;
inline const std::string one = "<robot name='a' at='0 0 0'",
                         two = one + " heading='0.3'/><robot name='b' at='3 1 0' heading='2'/>";

// Courses: S-bends, from rolling already, and one so hard that wheels may slip: the solver's memory matters.
inline const Attributes bends = {{"v", "0.25"}, {"dv", "0.15"}, {"dw", "0.8"}},
                        rolling = {{"forward", "0.25"}, {"left", "5"}, {"right", "5"}},
                        wild = {{"v", "0.4"}, {"dv", "0.3"}, {"a", "0.2"}, {"dw", "3"}};

// A Hummingbird in the air, and its rotors' commands.
std::string bird(const std::string& name, const std::string& at);
std::string lift(double rate, double swing = 0);
// One takes off from the ground, one flies beside a Scarab that drives.
inline const std::string air =
    bird("a", "0 0 0.06") + bird("b", "3 0 4") + "<robot name='c' at='0 4 0'/>" + lift(470, 20);

// Robots as <conformance.start> hands them to the backend, after the first tick.
class Started : public Simulation {
 public:
  Started(const Folder& folder, int workers, InstanceDeclaration backend);
};

class Physics {
 protected:
  Started started(const Backend& backend, const std::string& robots, const Attributes& start, const Attributes& course,
                  double dt = 0.01, int workers = 1, const Attributes& more = {}) const;
  static void run_for(Simulation& run, int ticks);
  // `begun`: a run on so many workers. Straight on, on three, restored half way and remade in between.
  void expect_same_bits(const std::function<Started(int)>& begun, int half) const;

  const Folder folder;
};

class EachBackend : public Physics, public testing::TestWithParam<Backend> {
 protected:
  Started run(const std::string& robots, const Attributes& start, const Attributes& course, int workers = 1) const {
    return started(GetParam(), robots, start, course, 0.01, workers);
  }
};

}  // namespace muster::test
