#include "midpoint_engine.hpp"

#include <algorithm>
#include <cmath>

namespace muster::simbody {

using Eigen::Vector3d;

namespace {

// Rough cost of a robot's step [us], to divide the work.
constexpr double on_wheels = 1, on_legs = 8, near_others = 6;
constexpr double least_share = 25;  // [us] below which a share is not worth a thread
constexpr int most_shares = 16;

}  // namespace

MidpointEngine::MidpointEngine(const std::vector<NamedRobot>& robots, Steps longest, LegModel legs)
    : arena_(robots, legs), longest_(longest), place_(robots.size()), clusters_(robots.size()) {}

void MidpointEngine::set_surroundings(const std::vector<scene::Slab>& walls, double friction) {
  arena_.friction = friction;
  arena_.walls.clear();
  arena_.wall_extents.clear();
  for (const scene::Slab& slab : walls) {
    const Solid wall = solid_of(slab);
    const Vector3d half = wall.axes.cwiseAbs() * wall.half;
    arena_.walls.push_back(wall);
    arena_.wall_extents.push_back({wall.centre - half, wall.centre + half});
  }
  broad_phase_.set_standing(arena_.wall_extents);
}

Count MidpointEngine::count() const {
  Count sum;
  for (const auto& mover : movers_) sum += mover->count();
  return sum;
}

// In a tick of several steps, clusters must be valid for all of them: they are found with a margin. If that was too
// small, the tick starts again with a larger one. So the results depend neither on the margin nor on threads.
void MidpointEngine::step(double dt, const std::vector<Command>& commands, std::vector<RobotState>& states,
                          const Each& each) {
  const bool many_steps = dt > longest_.of_all * (1 + 1e-9) || dt > longest_.of_legs * (1 + 1e-9);
  if (many_steps) start_ = states;
  for (double room = many_steps ? 2 : 1;; room *= 2) {
    find_clusters(dt, room, states);
    share_out(dt);
    if (move(dt, commands, states, each)) return;
    states = start_;
  }
}

// Robots that may meet a walking robot take its step length.
int MidpointEngine::steps_of(const Cluster& cluster, double dt) const {
  const bool walks = std::any_of(cluster.robots.begin(), cluster.robots.end(),
                                 [&](int i) { return !arena_.crew[i].model.legs.empty(); });
  const double longest = walks ? std::min(longest_.of_all, longest_.of_legs) : longest_.of_all;
  return std::max(1, static_cast<int>(std::ceil(dt / longest - 1e-9)));
}

void MidpointEngine::find_clusters(double dt, double room, const std::vector<RobotState>& states) {
  const int count = static_cast<int>(arena_.crew.size());
  reach_.clear();
  for (int i = 0; i < count; ++i) reach_.push_back(extent_of(arena_.crew[i].model, states[i], dt, room));
  broad_phase_.find(reach_);
  connected_.begin(count);
  for (const auto& [i, j] : broad_phase_.among()) connected_.join(i, j);
  for (Cluster& cluster : clusters_) cluster.robots.clear(), cluster.pairs.clear(), cluster.walls.clear();
  for (int i = 0; i < count; ++i) {
    std::vector<int>& robots = clusters_[connected_.root(i)].robots;
    place_[i] = static_cast<int>(robots.size());
    robots.push_back(i);
  }
  for (const auto& [i, j] : broad_phase_.among()) clusters_[connected_.root(i)].pairs.push_back({place_[i], place_[j]});
  for (const auto& [i, wall] : broad_phase_.with_standing())
    clusters_[connected_.root(i)].walls.push_back({place_[i], wall});
}

// Divides the clusters among the movers: consecutive ones, with about equal work.
void MidpointEngine::share_out(double dt) {
  const auto work = [&](const Cluster& cluster) {
    double sum = 0;
    for (const int i : cluster.robots) sum += arena_.crew[i].model.legs.empty() ? on_wheels : on_legs;
    return steps_of(cluster, dt) * sum * (cluster.pairs.empty() ? 1 : near_others);
  };
  double all = 0, done = 0;
  for (const Cluster& cluster : clusters_) all += work(cluster);
  const int shares = std::clamp(static_cast<int>(all / least_share), 1, most_shares);
  const double share = all / shares;
  shares_.clear();
  for (std::size_t k = 0; k < clusters_.size(); ++k) {
    done += work(clusters_[k]);
    while (static_cast<int>(shares_.size()) + 1 < shares && done >= share * static_cast<double>(shares_.size() + 1))
      shares_.push_back(k + 1);
  }
  shares_.push_back(clusters_.size());
  while (movers_.size() < shares_.size()) movers_.push_back(std::make_unique<ClusterStepper>(arena_));
}

bool MidpointEngine::move(double dt, const std::vector<Command>& commands, std::vector<RobotState>& states,
                          const Each& each) {
  kept_.assign(shares_.size(), true);
  each(shares_.size(), [&](std::size_t share) {
    for (std::size_t k = share == 0 ? 0 : shares_[share - 1]; k < shares_[share] && kept_[share]; ++k) {
      const Cluster& cluster = clusters_[k];
      if (cluster.robots.empty()) continue;
      kept_[share] = movers_[share]->move(cluster, reach_, steps_of(cluster, dt), dt, commands, states);
    }
  });
  return std::all_of(kept_.begin(), kept_.end(), [](char kept) { return kept; });
}

}  // namespace muster::simbody
