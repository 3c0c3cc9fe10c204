// physics.simbody: the engine on the blackboard.
#include <algorithm>
#include <cstring>
#include <muster/ground_drives.hpp>
#include <muster/parallel.hpp>
#include <muster/plugin.hpp>
#include <optional>

#include "description/starts.hpp"
#include "description/world_robots.hpp"
#include "plugins/scene_rows.hpp"
#include "world.hpp"

namespace {

using namespace muster;
using description::Model;
using description::WorldRobots;

struct PhysicsSimbody {
  static constexpr auto id = "physics.simbody/9";
  static constexpr auto summary =
      "rigid robots on wheels or legs, among walls and each other: friction, slip, torque limits, weight transfer";
  static constexpr auto manual =
      "Bodies and wheels from the robot's URDF, a Simbody multibody system; the ground is flat, at z = 0. Wheels touch "
      "it\n"
      "in a point with Coulomb's isotropic friction, spheres of the body slide on it. Motors turn the wheels as asked, "
      "within\n"
      "the drive's torque and speed. The acceleration along the ground is bounded by friction times 9.81 m/s2.\n"
      "Robots touch walls, closed doors and each other with their collision shapes: Coulomb's friction of\n"
      "`body_friction`, and impacts by the `restitution` of their model (plastic by default). A mesh touches as the "
      "box\n"
      "around it, a cylinder as a prism of 16 sides, exact where it is nearest.\n"
      "Where a robot is near others or walls and would go more than 1 cm in a step, the step is divided. `leg_step` is "
      "for "
      "robots that\n"
      "walk, whose feet slip on springs, and for who may meet them within a tick; others go on in steps of `step`. "
      "Robots that\n"
      "may not meet within a tick are moved apart from each other, on as many threads as the run has.\n"
      "integrator: midpoint is second order, on velocities; twist is the mean over its last step (its velocity that of "
      "the mass centre, as the origin goes with it). rk3 (fixed step), "
      "rkm and\n"
      "cpodes (adaptive) are Simbody's own on rolling constraints, as reference: no slip, no lift, no torque limit, no "
      "walls and\n"
      "no other robots.\n"
      "Legs of robots that walk are half circles, springs and dampers along the ground's normal (rigid_legs: rigid, "
      "an\n"
      "approximation for slow gaits); their controllers turn them as asked within the torque of their motors. Legs of\n"
      "two robots do not touch each other.\n"
      "Robots with rotors that can touch nothing in a step fly by Runge and Kutta's fourth order; robot/*/rotors are "
      "their\n"
      "rotors as they turn.\n"
      "Limbs hang on hinges, sliders and balls without a motor, with limits, damping and friction, and touch as the "
      "body does;\n"
      "robot/*/limbs are these as they hang.\n"
      "The front wheels of a car stand as robot/*/steering has it and roll freely; they and the rollers of a mecanum "
      "wheel\n"
      "hold the ground along one direction only.\n"
      "A robot without a drive is pushed by others; all its shapes have body_friction on the ground.\n"
      "Not modelled: wheels as discs on the ground (they stand on it as spheres would), rolling resistance,\n"
      "downwash and ground effect of rotors.";
  static constexpr auto phase = MUSTER_PHYSICS;
  static constexpr bool keeps_only_caches = true;
  static constexpr auto abilities = description::abilities_of_simbody;
  static constexpr Param params[] = {
      real("step", 0.001, 1e-6, 0.1, "s", "longest step inside a tick"),
      real("leg_step", 0.1, 1e-6, 0.1, "s", "as step, of robots that walk and who may meet them"),
      choice("integrator", "midpoint|rk3|rkm|cpodes", "what steps the bodies"),
      real("body_friction", 0.3, 0, 10, "", "between robots, and of robots with walls"),
      flag("rigid_legs", false, "whatever their model says: for slow gaits")};

  explicit PhysicsSimbody(Setup& s)
      : step_size(s.value("step")),
        leg_step(s.value("leg_step")),
        integrator(s.value("integrator")),
        body_friction(s.value("body_friction")),
        rigid_legs(s.value("rigid_legs")),
        robots(s, description::Meshes::import),
        flies(robots.any_quadrotor()),
        drive(s.read<Drive>("robot/*/drive")),
        wall(s.read<Wall>("wall/*/shape")),
        door(s.read<Door>("door/*/shape")),
        door_state(s.read<DoorState>("door/*/state")),
        pose(s.write<Pose>("robot/*/pose")),
        twist(s.write<Twist>("robot/*/twist")),
        wheels(s.write<Wheels>("robot/*/wheels")),
        model(s.write<Model>("robot/*/body")),
        memory(s.write<simbody::Memory>("robot/*/contact")) {
    robots.require(abilities, s);
    if (robots.any_walks()) {
      gait = s.read<Gait>("robot/*/gait");
      legs = s.write<Legs>("robot/*/legs");
    }
    if (robots.any_has_limbs()) limbs = s.write<Limbs>("robot/*/limbs");
    if (robots.any_steers()) steering = s.read_if_any<SteeringAngle>("robot/*/steering");
    if (robots.any_mecanum()) {
      rear_drive = s.read_if_any<Drive>("robot/*/rear_drive");
      rear_wheels = s.write<Wheels>("robot/*/rear_wheels");
    }
    if (flies) {
      rotor_drive = s.read<RotorDrive>("robot/*/rotor_drive");
      rotors = s.write<Rotors>("robot/*/rotors");
    }
    made.step = s.param("step");
    made.leg_step = s.param("leg_step");
    made.integrator = s.param("integrator");
    made.rigid_legs = s.param("rigid_legs");
    for (std::size_t row = 0; row < robots.size(); ++row) {
      made.rows.push_back(row);
      made.models.push_back(WorldRobots::model_of(0, row));
    }
    make_engine([&](std::size_t row) { return s.host()->row_name(s.host(), "robot", static_cast<uint32_t>(row)); });
  }

  // Inputs from which an engine is built.
  struct Made {
    double step = 0, leg_step = 0, integrator = 0, rigid_legs = 0;
    std::vector<std::size_t> rows;
    std::vector<double> models;
    bool operator!=(const Made& b) const {
      return step != b.step || leg_step != b.leg_step || integrator != b.integrator || rigid_legs != b.rigid_legs ||
             rows != b.rows || models != b.models;
    }
  };

  template <class NameOf>
  void make_engine(NameOf name_of) {
    std::vector<simbody::NamedRobot> named;
    for (std::size_t i = 0; i < made.rows.size(); ++i) {
      const std::string name(name_of(made.rows[i]));
      const description::Robot* robot = robots.of(made.models[i]);
      if (!robot) throw BadInput("robot '" + name + "' has no model; expected the attribute model in the world file");
      named.push_back({name, robot});
    }
    try {
      engine = simbody::make_engine(named, static_cast<simbody::Integrator>(static_cast<int>(made.integrator) + 1),
                                    {made.step, made.leg_step},
                                    made.rigid_legs != 0 ? simbody::LegModel::rigid : simbody::LegModel::as_described);
    } catch (const std::runtime_error& wrong) {
      throw BadInput(wrong.what());
    }
    surroundings = {};
  }

  // Surroundings of the robots, as set in the engine.
  struct Surroundings {
    std::vector<double> cells;
    bool told = false;
    std::vector<double> seen;  // in this step
  };

  void tell_surroundings(const Step& k) {
    std::vector<double>& cells = surroundings.seen;
    cells.assign(1, k[body_friction]);
    const auto append = [&](const auto& rows) {
      const auto* data = reinterpret_cast<const double*>(rows.begin());
      cells.insert(cells.end(), data, data + rows.size() * sizeof(*rows.begin()) / sizeof(double));
    };
    append(k[wall]);
    append(k[door]);
    append(k[door_state]);
    const bool same = cells.size() == surroundings.cells.size() &&
                      !std::memcmp(cells.data(), surroundings.cells.data(), cells.size() * sizeof(double));
    if (same && surroundings.told) return;
    engine->set_surroundings(scene::slabs(scene_walls(k[wall]), scene_doors(k[door], k[door_state], k[wall])),
                             k[body_friction]);
    surroundings.cells = cells;
    surroundings.told = true;
  }

  void step(const Step& k) {
    now.rows.clear(), now.models.clear(), starts.clear();
    now.step = k[step_size];
    now.leg_step = k[leg_step];
    now.integrator = k[integrator];
    now.rigid_legs = k[rigid_legs];
    for (std::size_t i = 0; i < k[pose].size(); ++i) {
      // 0 until it is there for the first time.
      const double before = k.last(model)[i].model;
      k[model][i].model = before == 0 && !k.alive("robot", i) ? 0 : WorldRobots::model_of(before, i);
      if (!k.alive("robot", i)) {
        stay(k, i);
        continue;
      }
      if (before == 0) starts.push_back(i);
      now.rows.push_back(i);
      now.models.push_back(k[model][i].model);
    }
    if (now != made) {
      made = now;
      make_engine([&](std::size_t row) { return k.name("robot", row); });
    }
    tell_surroundings(k);
    if (!starts.empty() && made.integrator == 0) warn_of_starts(k);
    move(k);
  }

  void warn_of_starts(const Step& k) const {
    std::vector<description::starts::Block> blocks;
    for (const scene::Slab& slab : scene::slabs(scene_walls(k[wall]), scene_doors(k[door], k[door_state], k[wall])))
      blocks.push_back(description::starts::block_of(slab));
    for (const auto& fault : description::starts::faults(
             k[pose].size(), [&](std::size_t i) { return k.last(pose)[i]; },
             [&](std::size_t i) { return k.alive("robot", i) ? robots.of(k[model][i].model) : nullptr; },
             [&](auto set, std::size_t row) { return k.name(set, row); }, blocks))
      if (std::find(starts.begin(), starts.end(), fault.robot) != starts.end())
        k.warn("robot/" + std::string(k.name("robot", fault.robot)), fault.message);
  }

  // A robot that left keeps its state.
  void stay(const Step& k, std::size_t row) const {
    k[pose][row] = k.last(pose)[row];
    k[twist][row] = k.last(twist)[row];
    k[wheels][row] = k.last(wheels)[row];
    k[memory][row] = k.last(memory)[row];
    if (legs) k[*legs][row] = k.last(*legs)[row];
    if (limbs) k[*limbs][row] = k.last(*limbs)[row];
    if (rear_wheels) k[*rear_wheels][row] = k.last(*rear_wheels)[row];
    if (flies) k[rotors][row] = k.last(rotors)[row];
  }

  void move(const Step& k) {
    const auto asked = k[drive];
    states.resize(made.rows.size());  // fields that no robot of the world has remain 0, in commands too
    commands.resize(made.rows.size());
    for (std::size_t i = 0; i < made.rows.size(); ++i) {
      const std::size_t row = made.rows[i];
      gather(k, row, states[i]);
      const Drive wheel_rates = row < asked.size() ? asked[row] : Drive{};
      commands[i].left = wheel_rates.left, commands[i].left_rate = wheel_rates.left_rate;
      commands[i].right = wheel_rates.right, commands[i].right_rate = wheel_rates.right_rate;
      if (rear_drive) {
        const Drive rear = row < k[*rear_drive].size() ? k[*rear_drive][row] : Drive{};
        commands[i].rear = {rear.left, rear.right}, commands[i].rear_rate = {rear.left_rate, rear.right_rate};
      }
      if (steering) {
        const SteeringAngle now_steered = row < k[*steering].size() ? k[*steering][row] : SteeringAngle{};
        commands[i].steering = now_steered.angle, commands[i].steering_rate = now_steered.rate;
      }
      if (gait) {
        std::copy_n(k[*gait][row].angle, 6, commands[i].leg_angle.begin());
        std::copy_n(k[*gait][row].rate, 6, commands[i].leg_rate.begin());
      }
      if (flies) {
        const RotorDrive r = row < k[rotor_drive].size() ? k[rotor_drive][row] : RotorDrive{};
        commands[i].rotors = {r.front, r.left, r.back, r.right};
      }
    }
    engine->step(k.dt(), commands, states, [&k](std::size_t count, const auto& part) { each(k, count, part); });
    for (std::size_t i = 0; i < made.rows.size(); ++i) spread(k, made.rows[i], states[i]);
  }

  void gather(const Step& k, std::size_t row, simbody::RobotState& s) const {
    const Pose& p = k.last(pose)[row];
    const Twist& t = k.last(twist)[row];
    const Wheels& w = k.last(wheels)[row];
    s.pose = {p.x, p.y, p.z, p.qw, p.qx, p.qy, p.qz};
    s.twist = {t.vx, t.vy, t.vz, t.wx, t.wy, t.wz};
    s.angle = {w.left, w.right};
    s.rate = {w.left_rate, w.right_rate};
    s.memory = k.last(memory)[row];
    if (flies) {
      const Rotors& r = k.last(rotors)[row];
      s.rotors = {r.front, r.left, r.back, r.right};
    }
    if (limbs) s.limbs = k.last(*limbs)[row];
    if (rear_wheels) {
      const Wheels& rear = k.last(*rear_wheels)[row];
      s.rear_angle = {rear.left, rear.right}, s.rear_rate = {rear.left_rate, rear.right_rate};
    }
    if (!legs) return;
    const Legs& l = k.last(*legs)[row];
    std::copy_n(l.angle, 6, s.leg_angle.begin());
    std::copy_n(l.rate, 6, s.leg_rate.begin());
    std::copy_n(l.torque, 6, s.leg_torque.begin());
  }

  void spread(const Step& k, std::size_t row, const simbody::RobotState& s) const {
    const auto& p = s.pose;
    const auto& t = s.twist;
    k[pose][row] = {p[0], p[1], p[2], p[3], p[4], p[5], p[6]};
    k[twist][row] = {t[0], t[1], t[2], t[3], t[4], t[5]};
    k[wheels][row] = {s.angle[0], s.angle[1], s.rate[0], s.rate[1]};
    if (flies) k[rotors][row] = {s.rotors[0], s.rotors[1], s.rotors[2], s.rotors[3]};
    k[memory][row] = s.memory;
    if (limbs) k[*limbs][row] = s.limbs;
    if (rear_wheels) k[*rear_wheels][row] = {s.rear_angle[0], s.rear_angle[1], s.rear_rate[0], s.rear_rate[1]};
    if (!legs) return;
    Legs& l = k[*legs][row];
    std::copy_n(s.leg_angle.begin(), 6, l.angle);
    std::copy_n(s.leg_rate.begin(), 6, l.rate);
    std::copy_n(s.leg_torque.begin(), 6, l.torque);
  }

  Value step_size, leg_step, integrator, body_friction, rigid_legs;
  WorldRobots robots;
  bool flies;  // some robots have rotors; otherwise their tables are not claimed
  In<Drive> drive;
  In<RotorDrive> rotor_drive{};
  In<Wall> wall;
  In<Door> door;
  In<DoorState> door_state;
  Out<Pose> pose;
  Out<Twist> twist;
  Out<Wheels> wheels;
  Out<Rotors> rotors{};
  Out<Model> model;
  Out<simbody::Memory> memory;                // the engine's memory
  std::optional<In<SteeringAngle>> steering;  // if any robot steers
  std::optional<In<Drive>> rear_drive;        // if any has rollers
  std::optional<Out<Wheels>> rear_wheels;
  std::optional<In<Gait>> gait;  // if any robot walks
  std::optional<Out<Legs>> legs;
  std::optional<Out<Limbs>> limbs;  // where a robot has any
  std::vector<std::size_t> starts;  // robots that are there for the first time
  Made made, now;                   // inputs of the present engine; inputs in this step
  std::unique_ptr<simbody::Engine> engine;
  Surroundings surroundings;
  std::vector<simbody::RobotState> states;  // buffer, kept from step to step
  std::vector<simbody::Command> commands;
};

}  // namespace

MUSTER_PLUGIN_IS(PhysicsSimbody)
