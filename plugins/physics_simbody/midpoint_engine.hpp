// The stepper of this backend: second order, on velocities, with one small problem for each robot, or for robots in
// contact. Robots that cannot meet within a tick are stepped separately, on all threads.
#pragma once

#include "cluster_stepper.hpp"
#include "engine.hpp"

namespace muster::simbody {

class MidpointEngine : public Engine {
 public:
  MidpointEngine(const std::vector<NamedRobot>& robots, Steps longest, LegModel legs = LegModel::as_described);
  void step(double dt, const std::vector<Command>& commands, std::vector<RobotState>& states,
            const Each& each = one_by_one) override;
  void set_surroundings(const std::vector<scene::Slab>& walls, double friction) override;

  Count count() const;

 private:
  void find_clusters(double dt, double room, const std::vector<RobotState>& states);
  int steps_of(const Cluster& cluster, double dt) const;
  void share_out(double dt);
  bool move(double dt, const std::vector<Command>& commands, std::vector<RobotState>& states, const Each& each);

  Arena arena_;
  Steps longest_;

  // Buffers, kept from step to step; no state outlives a step.
  BroadPhase broad_phase_;
  Connected connected_;
  std::vector<Extent> reach_;
  std::vector<int> place_;           // of each robot in its cluster
  std::vector<Cluster> clusters_;    // by their first robots; others are empty
  std::vector<std::size_t> shares_;  // end of each mover's clusters
  std::vector<char> kept_;           // for each mover, whether its robots stayed within their reach
  std::vector<RobotState> start_;
  std::vector<std::unique_ptr<ClusterStepper>> movers_;
};

}  // namespace muster::simbody
