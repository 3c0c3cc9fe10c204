// Steps robots that may meet within a tick. In each step those that may meet form a group. Fast robots divide its step
// into parts. A group with legs, limbs or mecanum wheels has twelve unknowns a robot, any other eight.
#pragma once

#include <memory>

#include "broad_phase.hpp"
#include "stepper.hpp"

namespace muster::simbody {

// No robot of a cluster may meet one of another cluster within the tick. Pairs by place in `robots`, walls by their
// index.
struct Cluster {
  std::vector<int> robots;
  BroadPhase::Pairs pairs, walls;
};

// Bounds of a robot's motion within `time` [s]: twice its path, since a contact may accelerate it.
Extent extent_of(const RobotModel& model, const RobotState& state, double time, double room = 1);

class ClusterStepper {
 public:
  ClusterStepper(Arena& arena);

  // Advances by dt in `count` equal steps. `reach`: bounds of each robot for the whole time. False if a robot might
  // have left them and met something outside the cluster; the cluster's `states` are then invalid.
  bool move(const Cluster& cluster, const std::vector<Extent>& reach, int count, double dt,
            const std::vector<Command>& commands, std::vector<RobotState>& states);

  Count count() const;

 private:
  bool find_groups(const Cluster& cluster, const std::vector<Extent>* reach, double h,
                   const std::vector<RobotState>& states);
  int parts_of(const Group& group, double h, const std::vector<RobotState>& states) const;
  int parts_if_it_slides(const Group& group, double h, const std::vector<Command>& commands,
                         const std::vector<RobotState>& states) const;
  void advance(const Group& group, double h, double at, const std::vector<Command>& commands,
               std::vector<RobotState>& states);
  bool is_in_the_air(const Group& group, double h, const std::vector<RobotState>& states) const;

  Arena& arena_;
  StepperOf<unknowns> stepper_;
  std::unique_ptr<StepperOf<unknowns_with_legs>> stepper_with_legs_;  // or limbs, or four motors: if any robot has them

  // Buffers, kept from step to step.
  Connected connected_;
  std::vector<Extent> extents_;
  std::vector<Group> groups_;
};

}  // namespace muster::simbody
