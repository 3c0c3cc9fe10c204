// The stepper: second order, on velocities, one small problem a robot or for robots that touch. Robots with rotors that
// can touch nothing in a step fly by fourth order instead. N: unknowns of a robot, more where some walk.
//
// Velocities stand at the middle of steps: u is found for the configuration half a step ahead and carries the robot
// over the whole step, x += h N(x_mid) u. So forces act over (previous step + step) / 2, and commands are taken at
// mid-step.
#pragma once

#include "broad_phase.hpp"
#include "encounters.hpp"
#include "flight.hpp"
#include "world.hpp"

namespace muster::simbody {

template <int N>
class MidpointOf : public Engine {
 public:
  using Velocity = VelocityOf<N>;

  MidpointOf(const std::vector<NamedRobot>& robots, double step, LegModel legs = LegModel::as_described);
  void step(double dt, const std::vector<Command>& commands, std::vector<RobotState>& states) override;
  void set_surroundings(const std::vector<scene::Slab>& walls, double friction) override;

  // u of each robot without contacts and motors after `dt`, at the given configuration: for checks against Simbody's
  // own.
  Velocity free_acceleration(std::size_t robot, const Eigen::Matrix3d& to_world, const Velocity& u) const;
  const System& system() const { return system_; }

  // Problems solved so far; those in which friction's bounds and normal impulses did not agree in the end; and those
  // whose search failed.
  struct Count {
    long solved = 0, unsettled = 0, failed = 0;
  };
  const Count& count() const { return count_; }

 private:
  struct Robot {
    std::string name;
    RobotModel model;
    RobotBodies bodies;
    description::Mass whole;            // wheels included
    Eigen::Matrix3d inertia_at_origin;  // of the whole, in the body's frame
    double wheel_inertia[2];            // about the axle
    std::optional<Flight> flight;       // where it has rotors
    PlacedOf<N> now;
  };

  // Robots that may meet in this step, with what else they may meet. Groups do not meet each other.
  struct Group {
    std::vector<int> robots;
    BroadPhase::Pairs pairs, walls;  // of robots; of a robot and a wall
    int parts = 1;                   // of the step, so that nobody passes through anything
  };

  // Robots that touch, and all their contacts, by index.
  struct Island {
    std::vector<int> robots, contacts;
  };

  void read_masses();
  void find_groups(double h, const std::vector<RobotState>& states);
  int parts_of(const Group& group, double h, const std::vector<RobotState>& states) const;
  void advance(const Group& group, double h, double at, const std::vector<Command>& commands,
               std::vector<RobotState>& states);
  bool is_in_the_air(const Group& group, double h, const std::vector<RobotState>& states) const;
  void fly(int index, double h, const Command& command, RobotState& state);
  static Eigen::Vector3d origin_lead(const Robot& robot, const RobotState& state);
  void place(int index, double h, double at, const Command& command, const RobotState& state);
  void place_wheels(Robot& robot, int index, double h, double at, const Command& command, const RobotState& state);
  void place_legs(Robot& robot, double h, double at, const Command& command, const RobotState& state);
  void meet(const Group& group, double h, const std::vector<RobotState>& states);
  void solve_islands(const Group& group, std::vector<RobotState>& states);
  void solve(const Island& island, std::vector<RobotState>& states);
  void finish(Robot& robot, double h, const Command& command, RobotState& state) const;

  System system_;
  std::vector<Robot> robots_;
  double longest_step_;
  std::vector<Solid> walls_;
  double friction_ = 0;

  // Room that is kept from step to step; nothing of it outlives one.
  BroadPhase broad_phase_;
  std::vector<Extent> extents_;
  std::vector<Group> groups_;
  EncountersOf<N> encounters_;
  std::vector<Island> islands_;
  ContactSolverOf<N> solver_;
  ProblemOf<N> problem_;
  Count count_;
};

using Midpoint = MidpointOf<unknowns>;
using MidpointWithLegs = MidpointOf<unknowns_with_legs>;

}  // namespace muster::simbody
