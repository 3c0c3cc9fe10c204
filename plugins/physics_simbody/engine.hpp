// Interface of an engine: integrators, step lengths, and one step of all robots.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "description/robot.hpp"
#include "scene/slabs.hpp"
#include "state.hpp"

namespace muster::simbody {

enum class Integrator {
  midpoint = 1,  // our own second-order stepper: friction, torque limits
  rk3,           // Simbody's, on rolling constraints: wheels never slip nor lift, motors have no torque limit
  rkm,
  cpodes
};

// Calls the function for every index below a count, on any threads and in any order, and returns when all are done. Of
// several exceptions it rethrows that of the lowest index.
using Each = std::function<void(std::size_t, const std::function<void(std::size_t)>&)>;
void one_by_one(std::size_t count, const std::function<void(std::size_t)>& call);

class Engine {
 public:
  virtual ~Engine() = default;
  // Steps from t to t + dt [s]; one command and one state a robot, in the order of the robots. The result does not
  // depend on how `each` schedules the calls. Throws std::runtime_error naming the robot whose motion is no longer
  // finite.
  virtual void step(double dt, const std::vector<Command>& commands, std::vector<RobotState>& states,
                    const Each& each = one_by_one) = 0;

  // Sets the walls from now on, and Coulomb's friction between bodies and with walls. Simbody's own integrators have no
  // obstacles and ignore it.
  virtual void set_surroundings(const std::vector<scene::Slab>& /*walls*/, double /*friction*/) {}
};

struct NamedRobot {
  std::string name;
  const description::Robot* description;
};

enum class LegModel {
  as_described = 1,
  rigid  // in spite of the description: an approximation for slow gaits
};

// The longest steps inside a tick [s]: of walking robots and those that may meet them within it, and of all.
struct Steps {
  Steps(double all) : of_all(all), of_legs(all) {}
  Steps(double all, double legs) : of_all(all), of_legs(legs) {}

  double of_all, of_legs;
};

}  // namespace muster::simbody
