// Robots and their surroundings, shared by all steppers.
#pragma once

#include "broad_phase.hpp"
#include "contact_detection.hpp"
#include "robot_models.hpp"

namespace muster::simbody {

struct Arena {
  explicit Arena(const std::vector<NamedRobot>& robots, LegModel legs = LegModel::as_described) : crew(robots, legs) {
    make(placed);
    if (crew.any_has_many_joints()) make(placed_with_legs);
  }
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  RobotModels crew;
  // Each robot half a step ahead, for the steppers of eight and of twelve unknowns; at any time one thread uses a
  // robot.
  std::vector<PlacedOf<unknowns>> placed;
  std::vector<PlacedOf<unknowns_with_legs>> placed_with_legs;  // empty if no robot has any

  std::vector<Solid> walls;
  std::vector<Extent> wall_extents;
  double friction = 0;  // between bodies, and of bodies with walls

 private:
  template <int N>
  void make(std::vector<PlacedOf<N>>& all) const {
    all.resize(crew.size());
    for (std::size_t i = 0; i < crew.size(); ++i) {
      auto& now = all[i];
      now.model = &crew[i].model;
      now.index = static_cast<int>(i);
      now.mass = crew[i].whole.mass;
      now.inertia.mass.setIdentity();
      now.inertia.inverse.setIdentity();
      now.inertia.mass.template topLeftCorner<unknowns, unknowns>() = crew[i].mass;
      now.inertia.inverse.template topLeftCorner<unknowns, unknowns>() = crew[i].inverse_mass;
      if constexpr (N == unknowns_with_legs) {
        if (crew[i].with_four_wheels) now.inertia = *crew[i].with_four_wheels;
      }
      now.body.inertia = &now.inertia;
      now.body.previous.setZero();
    }
  }
};

}  // namespace muster::simbody
