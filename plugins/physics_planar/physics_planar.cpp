// physics.planar: kinematics for thousands of robots.
#include <cmath>
#include <muster/plugin.hpp>
#include <optional>

#include "description/world_robots.hpp"
#include "planar.hpp"
#include "plugins/periods.hpp"

namespace {

using namespace muster;
using description::Model;
using description::WorldRobots;

struct PhysicsPlanar {
  static constexpr auto id = "physics.planar/1";
  static constexpr auto summary = "robots on wheels that roll as asked: exact arcs in the plane";
  static constexpr auto manual =
      "Each step is the arc that the wheel rates at its middle make. The velocity follows as fast as `acceleration` "
      "allows, in\n"
      "any direction, so a robot that is asked to turn too hard drifts outwards; its wheels' rates are those of the "
      "body.\n"
      "Not modelled: masses, forces, slip of single wheels, anything above the plane; height and tilt stay as found.\n"
      "Robots drive through walls and each other; a world with walls gives a warning unless `through_walls` says so.";
  static constexpr auto phase = MUSTER_PHYSICS;
  static constexpr auto abilities =
      description::Ability::wheels | description::Ability::steering | description::Ability::mecanum;
  static constexpr auto cannot_hold = "changes of height, roll and pitch, and wheel slip";
  static constexpr Param params[] = {real("acceleration", 7.848, 1e-6, 1e6, "m/s2",
                                          "bound on the change of velocity; by default friction 0.8 times 9.81 m/s2"),
                                     flag("through_walls", false, "no wall is meant to stop a robot")};

  explicit PhysicsPlanar(Setup& s)
      : acceleration(s.value("acceleration")),
        robots(s, description::Meshes::skip),
        drive(s.read<Drive>("robot/*/drive")),
        pose(s.write<Pose>("robot/*/pose")),
        twist(s.write<Twist>("robot/*/twist")),
        wheels(s.write<Wheels>("robot/*/wheels")),
        model(s.write<Model>("robot/*/body")) {
    robots.require(abilities, s);
    if (robots.any_steers()) steering = s.read_if_any<SteeringAngle>("robot/*/steering");
    if (robots.any_mecanum()) {
      rear_drive = s.read_if_any<Drive>("robot/*/rear_drive");
      rear_wheels = s.write<Wheels>("robot/*/rear_wheels");
    }
    const bool any_walls = s.host()->rows(s.host(), "wall") > 0 && robots.size() > 0;
    if (any_walls && s.param("through_walls") == 0)
      s.warn("self",
             "walls stop no robot here: physics.planar drives through them; expected physics.simbody in its place, or "
             "through_walls=\"true\" where that is meant");
  }

  void step(const Step& k) const {
    const auto asked = k[drive];
    for (std::size_t i = 0; i < k[pose].size(); ++i) {
      planar::Body body{k.last(pose)[i], k.last(twist)[i], k.last(wheels)[i]};
      if (rear_wheels) body.rear = k.last(*rear_wheels)[i];
      k[model][i].model = WorldRobots::model_of(k.last(model)[i].model, i);
      if (k.alive("robot", i)) {
        const auto* motors = robots.drive_of(k[model][i].model);
        if (!motors) throw BadInput("robot '" + std::string(k.name("robot", i)) + "' has no model");
        planar::Asked of_robot{i < asked.size() ? asked[i] : Drive{0, 0, 0, 0}};
        if (steering && i < k[*steering].size()) of_robot.steering = k[*steering][i];
        if (rear_drive && i < k[*rear_drive].size()) of_robot.rear = k[*rear_drive][i];
        if (is_first_step(k.time(), k.dt())) warn_of_depth(k, i, body.pose);
        body = planar::stepped(body, of_robot, *motors, k[acceleration], k.dt());
      }
      k[pose][i] = body.pose;
      k[twist][i] = body.twist;
      k[wheels][i] = body.wheels;
      if (rear_wheels) k[*rear_wheels][i] = body.rear;
    }
  }

  // Where a robot starts below the ground: it stays there, for its height does not change.
  static void warn_of_depth(const Step& k, std::size_t i, const Pose& start) {
    constexpr double tolerance = 1e-3;  // m
    if (!(start.z < -tolerance)) return;
    const std::string name(k.name("robot", i));
    k.warn("robot/" + name, "robot '" + name + "' starts " + std::to_string(std::lround(-1000 * start.z)) +
                                " mm below the ground; expected a place (at) on it, z = 0 or above");
  }

  Value acceleration;
  WorldRobots robots;
  In<Drive> drive;
  Out<Pose> pose;
  Out<Twist> twist;
  Out<Wheels> wheels;
  Out<Model> model;
  std::optional<In<SteeringAngle>> steering;  // where a robot has any
  std::optional<In<Drive>> rear_drive;
  std::optional<Out<Wheels>> rear_wheels;
};

}  // namespace

MUSTER_PLUGIN_IS(PhysicsPlanar)
