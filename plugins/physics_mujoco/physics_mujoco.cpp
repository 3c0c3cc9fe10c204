// physics.mujoco: MuJoCo on the blackboard.
#include <algorithm>
#include <cstring>
#include <muster/ground_drives.hpp>
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

struct Complained {
  static constexpr const char* columns = "count";
  double count;
};

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
      "Of first order in the step. self/complaints counts MuJoCo's warnings.\n"
      "Not modelled: wheels as discs on the ground, rolling resistance, shapes other than boxes and spheres.";
  static constexpr auto phase = MUSTER_PHYSICS;
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
        robots(s, description::Meshes::import),
        flies(robots.any_quadrotor()),
        drive(s.read<Drive>("robot/*/drive")),
        walls(s.read<Wall>("wall/*/shape")),
        doors(s.read<Door>("door/*/shape")),
        door_states(s.read<DoorState>("door/*/state")),
        pose(s.write<Pose>("robot/*/pose")),
        twist(s.write<Twist>("robot/*/twist")),
        wheels(s.write<Wheels>("robot/*/wheels")),
        model(s.write<Model>("robot/*/body")),
        complained(s.write<Complained>("self/complaints")) {
    robots.require(abilities, s);
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
    for (std::size_t row = 0; row < robots.size(); ++row) {
      made.rows.push_back(row);
      made.models.push_back(WorldRobots::model_of(0, row));
    }
    make([&](std::size_t row) { return s.host()->row_name(s.host(), "robot", static_cast<uint32_t>(row)); });
  }

  // Inputs from which the engine is built. Parameters come with the first step.
  struct Made {
    mujoco::Settings settings;
    std::vector<std::size_t> rows;
    std::vector<double> models;
    bool operator==(const Made& b) const { return settings == b.settings && rows == b.rows && models == b.models; }
  };

  mujoco::Settings settings(const Step& k) const {
    return {k[step_size], static_cast<int>(k[iterations]), k[friction], k[obstacles] != 0};
  }

  template <class NameOf>
  void make(NameOf name_of) {
    std::vector<mujoco::NamedRobot> named;
    for (std::size_t i = 0; i < made.rows.size(); ++i) {
      const std::string name(name_of(made.rows[i]));
      const description::Robot* robot = robots.of(made.models[i]);
      if (!robot) throw BadInput("robot '" + name + "' has no model; expected the attribute model in the world file");
      named.push_back({name, robot});
    }
    try {
      world = std::make_unique<mujoco::World>(named, made.settings);
    } catch (const std::runtime_error& wrong) {
      throw BadInput(wrong.what());
    }
    known_walls.clear();
  }

  void step(const Step& k) {
    Made now{settings(k), {}, {}};
    for (std::size_t i = 0; i < k[pose].size(); ++i) {
      k[pose][i] = k.last(pose)[i];  // robots that left keep their state
      k[twist][i] = k.last(twist)[i];
      k[wheels][i] = k.last(wheels)[i];
      if (flies) k[rotors][i] = k.last(rotors)[i];
      if (rear_wheels) k[*rear_wheels][i] = k.last(*rear_wheels)[i];
      if (limbs) k[*limbs][i] = k.last(*limbs)[i];
      k[model][i].model = WorldRobots::model_of(k.last(model)[i].model, i);
      if (!k.alive("robot", i)) continue;
      now.rows.push_back(i);
      now.models.push_back(k[model][i].model);
    }
    if (!(now == made)) {
      made = now;
      make([&](std::size_t row) { return k.name("robot", row); });
    }
    stand_walls(k);
    if (k.tick() == first_tick && made.settings.obstacles) warn_of_starts(k);
    move(k);
  }

  static constexpr uint64_t first_tick = 1;

  void warn_of_starts(const Step& k) const {
    std::vector<description::starts::Block> blocks;
    for (const scene::Slab& slab : scene::slabs(scene_walls(k[walls]), scene_doors(k[doors], k[door_states], k[walls])))
      blocks.push_back(description::starts::block_of(slab));
    for (const auto& fault : description::starts::faults(
             k[pose].size(), [&](std::size_t i) { return k.last(pose)[i]; },
             [&](std::size_t i) { return k.alive("robot", i) ? robots.of(k[model][i].model) : nullptr; },
             [&](auto set, std::size_t row) { return k.name(set, row); }, blocks))
      k.warn("robot/" + std::string(k.name("robot", fault.robot)), fault.message);
  }

  // Walls with the doors' states of this tick.
  void stand_walls(const Step& k) {
    std::vector<double> now{1};  // never empty: none are known yet
    const auto append = [&](const auto rows) {
      const std::size_t from = now.size(), count = rows.size() * sizeof(*rows.begin()) / sizeof(double);
      now.resize(from + count);
      if (count) std::memcpy(now.data() + from, rows.begin(), count * sizeof(double));
    };
    append(k[walls]), append(k[doors]), append(k[door_states]);
    const bool same = now.size() == known_walls.size() &&
                      std::memcmp(now.data(), known_walls.data(), now.size() * sizeof(double)) == 0;  // some are NaN
    if (same) return;
    world->set_walls(scene::slabs(scene_walls(k[walls]), scene_doors(k[doors], k[door_states], k[walls])));
    known_walls = now;
  }

  void move(const Step& k) {
    const auto asked = k[drive];
    states.resize(made.rows.size());
    commands.assign(made.rows.size(), {});
    for (std::size_t i = 0; i < made.rows.size(); ++i) {
      const std::size_t row = made.rows[i];
      states[i] = gather(k, row);
      if (row < asked.size()) {
        commands[i] = {asked[row].left, asked[row].right, asked[row].left_rate, asked[row].right_rate};
      }
      if (rear_drive && row < k[*rear_drive].size()) {
        const Drive& rear = k[*rear_drive][row];
        commands[i].rear = {rear.left, rear.right}, commands[i].rear_rate = {rear.left_rate, rear.right_rate};
      }
      if (steering && row < k[*steering].size()) {
        const SteeringAngle& now_steered = k[*steering][row];
        commands[i].steering = now_steered.angle, commands[i].steering_rate = now_steered.rate;
      }
      if (flies && row < k[rotor_drive].size()) {
        const RotorDrive& r = k[rotor_drive][row];
        commands[i].rotors = {r.front, r.left, r.back, r.right};
      }
    }
    report(k, world->step(k.dt(), commands, states));
    for (std::size_t i = 0; i < made.rows.size(); ++i) spread(k, made.rows[i], states[i]);
  }

  void report(const Step& k, const std::string& warning) const {
    const double before = k.last(complained)->count;
    k[complained]->count = before + (warning.empty() ? 0 : 1);
    if (before == 0 && !warning.empty())
      k.event("MuJoCo warns: " + warning + "; self/complaints counts the ticks in which it does");
  }

  mujoco::RobotState gather(const Step& k, std::size_t row) const {
    const Pose& p = k.last(pose)[row];
    const Twist& t = k.last(twist)[row];
    const Wheels& w = k.last(wheels)[row];
    mujoco::RobotState s{{p.x, p.y, p.z, p.qw, p.qx, p.qy, p.qz},
                         {t.vx, t.vy, t.vz, t.wx, t.wy, t.wz},
                         {w.left, w.right},
                         {w.left_rate, w.right_rate}};
    if (limbs) s.limbs = k.last(*limbs)[row];
    if (rear_wheels) {
      const Wheels& rear = k.last(*rear_wheels)[row];
      s.rear_angle = {rear.left, rear.right}, s.rear_rate = {rear.left_rate, rear.right_rate};
    }
    if (flies) {
      const Rotors& r = k.last(rotors)[row];
      s.rotors = {r.front, r.left, r.back, r.right};
    }
    return s;
  }

  void spread(const Step& k, std::size_t row, const mujoco::RobotState& s) const {
    const auto& p = s.pose;
    const auto& t = s.twist;
    k[pose][row] = {p[0], p[1], p[2], p[3], p[4], p[5], p[6]};
    k[twist][row] = {t[0], t[1], t[2], t[3], t[4], t[5]};
    k[wheels][row] = {s.angle[0], s.angle[1], s.rate[0], s.rate[1]};
    if (rear_wheels) k[*rear_wheels][row] = {s.rear_angle[0], s.rear_angle[1], s.rear_rate[0], s.rear_rate[1]};
    if (limbs) k[*limbs][row] = s.limbs;
    if (flies) k[rotors][row] = {s.rotors[0], s.rotors[1], s.rotors[2], s.rotors[3]};
  }

  Value step_size, iterations, friction, obstacles;
  WorldRobots robots;
  bool flies;  // some robots have rotors; otherwise their tables are not claimed
  In<Drive> drive;
  In<RotorDrive> rotor_drive{};
  In<Wall> walls;
  In<Door> doors;
  In<DoorState> door_states;
  Out<Pose> pose;
  Out<Twist> twist;
  Out<Wheels> wheels;
  Out<Rotors> rotors{};
  Out<Model> model;
  std::optional<Out<Limbs>> limbs;            // where a robot has any
  std::optional<In<SteeringAngle>> steering;  // where a robot has any
  std::optional<In<Drive>> rear_drive;        // where a robot has rollers
  std::optional<Out<Wheels>> rear_wheels;
  Out<Complained> complained;
  Made made;
  std::unique_ptr<mujoco::World> world;
  std::vector<double> known_walls;         // and doors, that stand in `world`
  std::vector<mujoco::RobotState> states;  // buffer, kept from step to step
  std::vector<mujoco::Command> commands;
};

}  // namespace

MUSTER_PLUGIN_IS(PhysicsMujoco)
