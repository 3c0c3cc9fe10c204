// Finds walls crossed by a straight link, by signed areas (orientation test). Random places meet no corner, so ties
// need no rule.
#pragma once

#include <optional>

#include "exam/plan.hpp"

namespace muster::exam {

struct Crossing {
  int wall = 0;
  int material = 0;
  double cosine = 1;  // of the angle between link and the wall's normal, in plan
};

struct Meeting {
  double along_link = 0, along_wall = 0;  // shares of their lengths
  double cosine = 1;
};

// Intersection of segments p q and a b.
std::optional<Meeting> meeting(Vec2 p, Vec2 q, Vec2 a, Vec2 b);

// Crossings of a link: an open door is a gap, a closed one has its wall's material, and the wall continues above it.
std::vector<Crossing> crossings(const Plan& plan, Vec3 from, Vec3 to);

// True if a robot's step, on the ground, would cross a wall or a closed door.
bool runs_into_wall(const Plan& plan, Vec2 from, Vec2 to);

// Length of p q within a disk.
double chord(Vec2 p, Vec2 q, Vec2 centre, double radius);

// Length of p q within a room; ends in the world's frame.
double length_within(const Plan& plan, const Room& room, Vec2 p, Vec2 q);

}  // namespace muster::exam
