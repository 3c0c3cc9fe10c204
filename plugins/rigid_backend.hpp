// A general engine of rigid bodies on the blackboard: the tables of its robots, and how they become its commands and
// states. An engine adds its parameters, and tables of what else it must remember.
#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <muster/ground_drives.hpp>
#include <muster/plugin.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "description/starts.hpp"
#include "description/world_robots.hpp"
#include "plugins/rigid_states.hpp"
#include "plugins/scene_rows.hpp"
#include "scene/slabs.hpp"

namespace muster::rigid {

struct Complained {
  static constexpr const char* columns = "count";
  double count;
};

// World: made of named robots and Settings, or a std::runtime_error; takes walls by set_walls(). State: a RobotState
// and what else the engine goes on from.
template <class World, class Settings, class State>
class Backend {
  using WorldRobots = description::WorldRobots;

 public:
  Backend(Setup& s, description::Ability abilities)
      : robots_(s, description::Meshes::import),
        flies_(robots_.any_quadrotor()),
        drive_(s.read<Drive>("robot/*/drive")),
        walls_(s.read<Wall>("wall/*/shape")),
        doors_(s.read<Door>("door/*/shape")),
        door_states_(s.read<DoorState>("door/*/state")),
        pose_(s.write<Pose>("robot/*/pose")),
        twist_(s.write<Twist>("robot/*/twist")),
        wheels_(s.write<Wheels>("robot/*/wheels")),
        model_(s.write<description::Model>("robot/*/body")),
        complained_(s.write<Complained>("self/complaints")) {
    robots_.require(abilities, s);
    if (robots_.any_has_limbs()) limbs_ = s.write<Limbs>("robot/*/limbs");
    if (robots_.any_steers()) steering_ = s.read_if_any<SteeringAngle>("robot/*/steering");
    if (robots_.any_mecanum()) {
      rear_drive_ = s.read_if_any<Drive>("robot/*/rear_drive");
      rear_wheels_ = s.write<Wheels>("robot/*/rear_wheels");
    }
    if (flies_) {
      rotor_drive_ = s.read<RotorDrive>("robot/*/rotor_drive");
      rotors_ = s.write<Rotors>("robot/*/rotors");
    }
    for (std::size_t row = 0; row < robots_.size(); ++row) {
      made_.rows.push_back(row);
      made_.models.push_back(WorldRobots::model_of(0, row));
    }
    make([&](std::size_t row) { return s.host()->row_name(s.host(), "robot", static_cast<uint32_t>(row)); });
  }

  const WorldRobots& robots() const { return robots_; }
  std::size_t rows(const Step& k) const { return k[pose_].size(); }  // of robots, those that left too

  // Steps the engine over a tick. advance(world, commands, states) does so; read(row, state) and write(row, state)
  // convey the engine's own tables before and after.
  template <class Advance, class Read, class Write>
  void step(const Step& k, const Settings& settings, const Advance& advance, const Read& read, const Write& write) {
    keep(k, settings);
    stand_walls(k);
    if (!starts_.empty() && made_.settings.obstacles) warn_of_starts(k);
    states_.clear();
    commands_.clear();
    for (const std::size_t row : made_.rows) {
      states_.push_back(gather(k, row));
      read(row, states_.back());
      commands_.push_back(asked(k, row));
    }
    advance(*world_, commands_, states_);
    for (std::size_t i = 0; i < made_.rows.size(); ++i) {
      spread(k, made_.rows[i], states_[i]);
      write(made_.rows[i], states_[i]);
    }
  }

  // Adds to self/complaints; the first one is an event.
  void complain(const Step& k, int count, const std::string& event) const {
    const double before = k.last(complained_)->count;
    k[complained_]->count = before + count;
    if (before == 0 && count > 0) k.event(event);
  }

 private:
  // Inputs from which the engine is built. Parameters come with the first step.
  struct Made {
    Settings settings;
    std::vector<std::size_t> rows;
    std::vector<double> models;
    bool operator==(const Made& b) const { return settings == b.settings && rows == b.rows && models == b.models; }
  };

  template <class NameOf>
  void make(NameOf name_of) {
    std::vector<NamedRobot> named;
    for (std::size_t i = 0; i < made_.rows.size(); ++i) {
      const std::string name(name_of(made_.rows[i]));
      const description::Robot* robot = robots_.of(made_.models[i]);
      if (!robot) throw BadInput("robot '" + name + "' has no model; expected the attribute model in the world file");
      named.push_back({name, robot});
    }
    try {
      world_ = std::make_unique<World>(named, made_.settings);
    } catch (const std::runtime_error& wrong) {
      throw BadInput(wrong.what());
    }
    known_walls_.clear();
  }

  void keep(const Step& k, const Settings& settings) {
    Made now{settings, {}, {}};
    starts_.clear();
    for (std::size_t i = 0; i < k[pose_].size(); ++i) {
      k[pose_][i] = k.last(pose_)[i];  // robots that left keep their state
      k[twist_][i] = k.last(twist_)[i];
      k[wheels_][i] = k.last(wheels_)[i];
      if (flies_) k[rotors_][i] = k.last(rotors_)[i];
      if (rear_wheels_) k[*rear_wheels_][i] = k.last(*rear_wheels_)[i];
      if (limbs_) k[*limbs_][i] = k.last(*limbs_)[i];
      // 0 until it is there for the first time.
      const double before = k.last(model_)[i].model;
      k[model_][i].model = before == 0 && !k.alive("robot", i) ? 0 : WorldRobots::model_of(before, i);
      if (!k.alive("robot", i)) continue;
      if (before == 0) starts_.push_back(i);
      now.rows.push_back(i);
      now.models.push_back(k[model_][i].model);
    }
    if (!(now == made_)) {
      made_ = now;
      make([&](std::size_t row) { return k.name("robot", row); });
    }
  }

  void warn_of_starts(const Step& k) const {
    std::vector<description::starts::Block> blocks;
    for (const scene::Slab& slab :
         scene::slabs(scene_walls(k[walls_]), scene_doors(k[doors_], k[door_states_], k[walls_])))
      blocks.push_back(description::starts::block_of(slab));
    for (const auto& fault : description::starts::faults(
             k[pose_].size(), [&](std::size_t i) { return k.last(pose_)[i]; },
             [&](std::size_t i) { return k.alive("robot", i) ? robots_.of(k[model_][i].model) : nullptr; },
             [&](auto set, std::size_t row) { return k.name(set, row); }, blocks))
      if (std::find(starts_.begin(), starts_.end(), fault.robot) != starts_.end())
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
    append(k[walls_]), append(k[doors_]), append(k[door_states_]);
    const bool same = now.size() == known_walls_.size() &&
                      std::memcmp(now.data(), known_walls_.data(), now.size() * sizeof(double)) == 0;  // some are NaN
    if (same) return;
    world_->set_walls(scene::slabs(scene_walls(k[walls_]), scene_doors(k[doors_], k[door_states_], k[walls_])));
    known_walls_ = now;
  }

  Command asked(const Step& k, std::size_t row) const {
    Command result{};
    const auto drives = k[drive_];
    if (row < drives.size())
      result = {drives[row].left, drives[row].right, drives[row].left_rate, drives[row].right_rate};
    if (rear_drive_ && row < k[*rear_drive_].size()) {
      const Drive& rear = k[*rear_drive_][row];
      result.rear = {rear.left, rear.right}, result.rear_rate = {rear.left_rate, rear.right_rate};
    }
    if (steering_ && row < k[*steering_].size()) {
      const SteeringAngle& now = k[*steering_][row];
      result.steering = now.angle, result.steering_rate = now.rate;
    }
    if (flies_ && row < k[rotor_drive_].size()) {
      const RotorDrive& r = k[rotor_drive_][row];
      result.rotors = {r.front, r.left, r.back, r.right};
    }
    return result;
  }

  State gather(const Step& k, std::size_t row) const {
    const Pose& p = k.last(pose_)[row];
    const Twist& t = k.last(twist_)[row];
    const Wheels& w = k.last(wheels_)[row];
    State s{};
    s.pose = {p.x, p.y, p.z, p.qw, p.qx, p.qy, p.qz};
    s.twist = {t.vx, t.vy, t.vz, t.wx, t.wy, t.wz};
    s.angle = {w.left, w.right}, s.rate = {w.left_rate, w.right_rate};
    if (limbs_) s.limbs = k.last(*limbs_)[row];
    if (rear_wheels_) {
      const Wheels& rear = k.last(*rear_wheels_)[row];
      s.rear_angle = {rear.left, rear.right}, s.rear_rate = {rear.left_rate, rear.right_rate};
    }
    if (flies_) {
      const Rotors& r = k.last(rotors_)[row];
      s.rotors = {r.front, r.left, r.back, r.right};
    }
    return s;
  }

  void spread(const Step& k, std::size_t row, const State& s) const {
    const auto& p = s.pose;
    const auto& t = s.twist;
    k[pose_][row] = {p[0], p[1], p[2], p[3], p[4], p[5], p[6]};
    k[twist_][row] = {t[0], t[1], t[2], t[3], t[4], t[5]};
    k[wheels_][row] = {s.angle[0], s.angle[1], s.rate[0], s.rate[1]};
    if (rear_wheels_) k[*rear_wheels_][row] = {s.rear_angle[0], s.rear_angle[1], s.rear_rate[0], s.rear_rate[1]};
    if (limbs_) k[*limbs_][row] = s.limbs;
    if (flies_) k[rotors_][row] = {s.rotors[0], s.rotors[1], s.rotors[2], s.rotors[3]};
  }

  WorldRobots robots_;
  bool flies_;  // some robots have rotors; otherwise their tables are not claimed
  In<Drive> drive_;
  In<RotorDrive> rotor_drive_{};
  In<Wall> walls_;
  In<Door> doors_;
  In<DoorState> door_states_;
  Out<Pose> pose_;
  Out<Twist> twist_;
  Out<Wheels> wheels_;
  Out<Rotors> rotors_{};
  Out<description::Model> model_;
  std::optional<Out<Limbs>> limbs_;            // where a robot has any
  std::optional<In<SteeringAngle>> steering_;  // where a robot has any
  std::optional<In<Drive>> rear_drive_;        // where a robot has rollers
  std::optional<Out<Wheels>> rear_wheels_;
  Out<Complained> complained_;
  Made made_;
  std::unique_ptr<World> world_;
  std::vector<std::size_t> starts_;  // robots that are there for the first time
  std::vector<double> known_walls_;  // and doors, that stand in the world
  std::vector<State> states_;        // buffers, kept from step to step
  std::vector<Command> commands_;
};

}  // namespace muster::rigid
