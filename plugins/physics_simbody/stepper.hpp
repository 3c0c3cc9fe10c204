// A step of robots that may meet: half a step ahead, contacts there, one small problem an island, and on. Second order,
// on velocities. N: unknowns of a robot.
//
// Velocities are those at the middle of steps: u is found for the configuration half a step ahead and carries the robot
// over the whole step, x += h N(x_mid) u. So forces act over (previous step + step) / 2, and commands are taken at
// mid-step.
#pragma once

#include "arena.hpp"
#include "connected.hpp"

namespace muster::simbody {

// Robots that may meet in this step, and walls that they may meet. Groups do not meet each other.
struct Group {
  std::vector<int> robots;         // in order
  BroadPhase::Pairs pairs, walls;  // of robots; of a robot and a wall
  int parts = 1;                   // of the step, so that no robot tunnels through anything
};

// Problems solved so far; those in which friction's bounds and normal impulses did not agree in the end; and those
// whose search failed.
struct Count {
  long solved = 0, unsettled = 0, failed = 0;

  Count& operator+=(const Count& b) {
    solved += b.solved, unsettled += b.unsettled, failed += b.failed;
    return *this;
  }
};

template <int N>
class StepperOf {
 public:
  explicit StepperOf(Arena& arena);

  // A step of length h [s]; commands are taken `at` [s] after the tick's start. Bouncing robots take it from impact to
  // impact.
  void advance(const Group& group, double h, double at, const std::vector<Command>& commands,
               std::vector<RobotState>& states);

  const Count& count() const { return count_; }

 private:
  // Robots in contact, by index, and all their contacts.
  struct Island {
    std::vector<int> robots, contacts;
  };

  std::vector<PlacedOf<N>>& placed() const;
  void prepare(const Group& group, double h, double at, const std::vector<Command>& commands,
               const std::vector<RobotState>& states);
  void complete(const Group& group, double h, double at, const std::vector<Command>& commands,
                std::vector<RobotState>& states, int halvings = 0);
  void place(int index, double h, double at, const Command& command, const RobotState& state);
  void place_wheels(const CrewMember& robot, double h, double at, const Command& command, const RobotState& state,
                    PlacedOf<N>& now);
  void place_mecanum(const CrewMember& robot, double h, double at, const Command& command, const RobotState& state,
                     PlacedOf<N>& now);
  void place_legs(const CrewMember& robot, double h, double at, const Command& command, const RobotState& state,
                  PlacedOf<N>& now);
  void meet(const Group& group, double h, const std::vector<RobotState>& states);
  void find_islands(const Group& group);
  bool needs_halves(const Island& island) const;
  static Group part_of(const Group& group, const Island& island);
  void take_contacts(const Island& island);
  void solve(const Island& island, double h, std::vector<RobotState>& states);
  void solve_problem();
  void finish(int index, double h, const Command& command, RobotState& state) const;

  // stepper_limbs.cpp
  void place_limbs(const CrewMember& robot, double h, double at, const Command& command, const RobotState& state,
                   PlacedOf<N>& now);
  void push(const CrewMember& robot, double h, const RobotState& state, const VelocityOf<N>& after, PlacedOf<N>& now);
  static void stop_limbs(const CrewMember& robot, double h, const RobotState& state, const VelocityOf<N>& rates,
                         PlacedOf<N>& now);
  bool push_again(const Island& island, double h, const std::vector<RobotState>& states);
  void finish_limbs(const CrewMember& robot, double h, const PlacedOf<N>& now, RobotState& state) const;

  // impacts.cpp
  bool bounces(const Group& group) const;
  void go_by_impacts(const Group& group, double h, double at, const std::vector<Command>& commands,
                     std::vector<RobotState>& states);
  double first_impact(const Group& group, double h, const std::vector<RobotState>& states) const;
  bool strike(const Group& group, double at, const std::vector<Command>& commands, std::vector<RobotState>& states);
  bool take_impact(const Island& island);
  void rebound();

  Arena& arena_;
  const bool somebody_bounces_;

  // Buffers, kept from step to step; no state outlives a step.
  EncountersOf<N> encounters_;
  Connected connected_;
  std::vector<Island> islands_;
  std::vector<int> place_;  // of each of the group's robots in its island
  ContactSolverOf<N> solver_;
  ProblemOf<N> problem_;
  Count count_;
};

}  // namespace muster::simbody
