// Moves robots that may meet within a tick through its steps. In each step those that may meet are a group, divided
// into parts where somebody is fast, and a group with legs or limbs has twelve unknowns a robot, any other eight.
#pragma once

#include <memory>

#include "broad_phase.hpp"
#include "stepper.hpp"

namespace muster::simbody {

// Nobody of a cluster may meet anybody of another within the tick. Pairs by place in `robots`, walls by their index.
struct Cluster {
  std::vector<int> robots;
  BroadPhase::Pairs pairs, walls;
};

// How far a robot may reach within `time` [s], and be reached: twice its way, since a contact may make it faster.
Extent extent_of(const RobotModel& model, const RobotState& state, double time, double room = 1);

class Mover {
 public:
  Mover(Arena& arena);

  // Through dt in `count` equal steps. `reach`: of each robot in the whole time. False where one was about to leave it,
  // and might have met what is not in the cluster; what `states` hold of the cluster then is nothing.
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
  std::unique_ptr<StepperOf<unknowns_with_legs>> stepper_with_legs_;  // or limbs: where a robot has any

  // Room that is kept from step to step.
  Connected connected_;
  std::vector<Extent> extents_;
  std::vector<Group> groups_;
};

}  // namespace muster::simbody
