// physics.mujoco: MuJoCo on the blackboard.
#include <muster/plugin.hpp>

#include "plugins/rigid_backend.hpp"
#include "world.hpp"

namespace {

using namespace muster;

struct PhysicsMujoco {
  static constexpr auto id = "physics.mujoco/1";
  static constexpr auto summary = "the MuJoCo engine: rigid robots on flat ground, walls and robots as obstacles";
  static constexpr auto manual =
      "Trees of bodies from the robot's URDF or MJCF, in the coordinates of their joints; the ground is flat, at z = "
      "0.\n"
      "Wheels touch it as spheres, with Coulomb's friction in round cones. Spheres of the body slide. Motors turn the\n"
      "wheels as asked, within the drive's torque and speed. Walls, closed doors and other robots are obstacles\n"
      "(obstacles=\"false\": the ground alone is), where meshes, cylinders and wheels count as boxes.\n"
      "Constraints are as hard as MuJoCo has them, and aim at velocities at the end of a step in place of its "
      "springs.\n"
      "Of second order in the step, in the air of first. self/complaints counts MuJoCo's warnings.\n"
      "Not modelled: wheels as discs on the ground, rolling resistance, shapes other than boxes and spheres.";
  static constexpr auto phase = MUSTER_PHYSICS;
  static constexpr bool keeps_only_caches = true;
  static constexpr auto abilities =
      description::Ability::wheels | description::Ability::steering | description::Ability::mecanum |
      description::Ability::rotors | description::Ability::height | description::Ability::tilting |
      description::Ability::hinges | description::Ability::sliders | description::Ability::balls |
      description::Ability::bouncing | description::Ability::pushed;
  static constexpr Param params[] = {
      real("step", 0.001, 1e-6, 0.1, "s", "longest step inside a tick"),
      integer("iterations", 100, 1, 10000, "of MuJoCo's solver in a step, at most"),
      real("friction", 0.3, 0, 10, "", "of bodies with walls, robots and ground; wheels have their model's"),
      flag("obstacles", true, "walls and other robots stop a robot")};

  explicit PhysicsMujoco(Setup& s)
      : step_size(s.value("step")),
        iterations(s.value("iterations")),
        friction(s.value("friction")),
        obstacles(s.value("obstacles")),
        backend(s, abilities) {}

  void step(const Step& k) {
    const mujoco::Settings settings{k[step_size], static_cast<int>(k[iterations]), k[friction], k[obstacles] != 0};
    const auto advance = [&](mujoco::World& world, const auto& commands, auto& states) {
      const std::string warning = world.step(k.dt(), commands, states);
      backend.complain(k, warning.empty() ? 0 : 1,
                       "MuJoCo warns: " + warning + "; self/complaints counts the ticks in which it does");
    };
    const auto nothing_more = [](std::size_t, const mujoco::RobotState&) {};
    backend.step(k, settings, advance, nothing_more, nothing_more);
  }

  Value step_size, iterations, friction, obstacles;
  rigid::Backend<mujoco::World, mujoco::Settings, mujoco::RobotState> backend;
};

}  // namespace

MUSTER_PLUGIN_IS(PhysicsMujoco)
