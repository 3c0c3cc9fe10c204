// physics.ode: ODE on the blackboard.
#include <muster/plugin.hpp>
#include <optional>

#include "plugins/rigid_backend.hpp"
#include "world.hpp"

namespace {

using namespace muster;

// State of the wheels in ODE, see ode::HungBody: the left one, then the right one.
struct Hinged {
  static constexpr const char* columns =
      "left_x[m] left_y[m] left_z[m] left_qw left_qx left_qy left_qz left_vx[m/s] left_vy[m/s] left_vz[m/s] "
      "left_wx[rad/s] left_wy[rad/s] left_wz[rad/s] right_x[m] right_y[m] right_z[m] right_qw right_qx right_qy "
      "right_qz "
      "right_vx[m/s] right_vy[m/s] right_vz[m/s] right_wx[rad/s] right_wy[rad/s] right_wz[rad/s]";
  std::array<ode::HungBody, 2> wheel;
};

// State of the limbs in ODE, in the order of the robot's model.
struct Hung {
  static constexpr const char* columns =
      "x1[m] y1[m] z1[m] qw1 qx1 qy1 qz1 vx1[m/s] vy1[m/s] vz1[m/s] wx1[rad/s] wy1[rad/s] wz1[rad/s] "
      "x2[m] y2[m] z2[m] qw2 qx2 qy2 qz2 vx2[m/s] vy2[m/s] vz2[m/s] wx2[rad/s] wy2[rad/s] wz2[rad/s] "
      "x3[m] y3[m] z3[m] qw3 qx3 qy3 qz3 vx3[m/s] vy3[m/s] vz3[m/s] wx3[rad/s] wy3[rad/s] wz3[rad/s] "
      "x4[m] y4[m] z4[m] qw4 qx4 qy4 qz4 vx4[m/s] vy4[m/s] vz4[m/s] wx4[rad/s] wy4[rad/s] wz4[rad/s]";
  std::array<ode::HungBody, Limbs::most> limb;
};

struct PhysicsOde {
  static constexpr auto id = "physics.ode/2";
  static constexpr auto summary = "the ODE engine: rigid robots on flat ground, walls and robots as obstacles";
  static constexpr auto manual =
      "Bodies and wheels from the robot's URDF, hinged; the ground is flat, at z = 0. Wheels touch it as spheres, "
      "with\n"
      "ODE's friction pyramid along the world's axes: up to 1.41 times Coulomb's bound between them. Spheres of the "
      "body\n"
      "slide. Motors turn the wheels as asked, within the drive's torque and speed. Walls, closed doors and other "
      "robots\n"
      "are obstacles (obstacles=\"false\": the ground alone is), where meshes, cylinders and wheels count as boxes.\n"
      "solver: exact is dWorldStep; quick is dWorldQuickStep with `iterations`: with 50 at a step of 1 ms what Gazebo\n"
      "uses. exact is of second order. robot/*/hinged is what wheels are off their hinges by: ODE goes on from it.\n"
      "Rotors are forces on the body, of first order. "
      "self/complaints counts ODE's messages, such as a contact that its exact solver could not settle.\n"
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
      choice("solver", "exact|quick", "dWorldStep or dWorldQuickStep"),
      integer("iterations", 50, 1, 100000, "of the quick solver in a step; only with solver=\"quick\""),
      real("over_relaxation", 1.3, 0.1, 1.99, "", "of the quick solver; only with solver=\"quick\""),
      real("erp", 0.2, 0, 1, "", "share of an error of joints and contacts that a step takes back"),
      real("cfm", 1e-10, 0, 1, "", "softness of joints and contacts, as ODE defines it"),
      real("friction", 0.3, 0, 10, "", "of bodies with walls, robots and ground; wheels have their model's"),
      flag("obstacles", true, "walls and other robots stop a robot")};

  explicit PhysicsOde(Setup& s)
      : step_size(s.value("step")),
        solver(s.value("solver")),
        iterations(s.value("iterations")),
        over_relaxation(s.value("over_relaxation")),
        erp(s.value("erp")),
        cfm(s.value("cfm")),
        friction(s.value("friction")),
        obstacles(s.value("obstacles")),
        shuffle(s.stream("ode_quickstep")),
        backend(s, abilities),
        hinged(s.write<Hinged>("robot/*/hinged")) {
    if (backend.robots().any_has_limbs()) hung = s.write<Hung>("robot/*/hung");
    if (backend.robots().any_mecanum()) rear_hinged = s.write<Hinged>("robot/*/rear_hinged");
  }

  void step(const Step& k) {
    for (std::size_t i = 0; i < backend.rows(k); ++i) {  // robots that left keep their state
      k[hinged][i] = k.last(hinged)[i];
      if (rear_hinged) k[*rear_hinged][i] = k.last(*rear_hinged)[i];
      if (hung) k[*hung][i] = k.last(*hung)[i];
    }
    const auto advance = [&](ode::World& world, const auto& commands, auto& states) {
      const auto seed = static_cast<unsigned long>(shuffle.uniform(k.tick()) * 0x1p32);
      backend.complain(k, world.step(k.dt(), commands, states, seed),
                       "ODE complains of a step; self/complaints counts how often it does");
    };
    const auto read = [&](std::size_t row, ode::RobotState& s) {
      s.hinged = k.last(hinged)[row].wheel;
      if (rear_hinged) s.rear_hinged = k.last(*rear_hinged)[row].wheel;
      if (hung) s.hung = k.last(*hung)[row].limb;
    };
    const auto write = [&](std::size_t row, const ode::RobotState& s) {
      k[hinged][row].wheel = s.hinged;
      if (rear_hinged) k[*rear_hinged][row].wheel = s.rear_hinged;
      if (hung) k[*hung][row].limb = s.hung;
    };
    backend.step(k, settings(k), advance, read, write);
  }

  ode::Settings settings(const Step& k) const {
    return {k[step_size], k[solver] != 0,   static_cast<int>(k[iterations]), k[over_relaxation], k[erp], k[cfm],
            k[friction],  k[obstacles] != 0};
  }

  Value step_size, solver, iterations, over_relaxation, erp, cfm, friction, obstacles;
  Stream shuffle;
  rigid::Backend<ode::World, ode::Settings, ode::RobotState> backend;
  Out<Hinged> hinged;
  std::optional<Out<Hung>> hung;           // where a robot has limbs
  std::optional<Out<Hinged>> rear_hinged;  // where a robot has rollers
};

}  // namespace

MUSTER_PLUGIN_IS(PhysicsOde)
