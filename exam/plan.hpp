// Floor plans: random ones, a corridor with rooms on both sides, at any angle; or a user's own (walls.hpp). All
// coordinates are whole millimetres, so that files hold exactly the truth.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "exam/random.hpp"

namespace muster::exam {

struct Vec2 {
  double x = 0, y = 0;  // m
};

struct Vec3 {
  double x = 0, y = 0, z = 0;  // m
};

inline double to_millimetres(double v) { return std::round(v * 1000) / 1000; }

struct Material {
  std::string name;
  double loss = 0;    // dB a wall, true
  double stated = 0;  // dB a wall, in the world file: start of a fit
};

struct Wall {
  std::string name;
  Vec2 a, b;
  double height = 2.7, thickness = 0.1;  // m
  int material = 0;
};

struct Door {
  std::string name;
  int wall = 0;
  double at = 0, width = 0.9, height = 2.0;  // m, `at` from the wall's first end
  bool open = true;
};

// A rectangle in the plan's own frame.
struct Room {
  Vec2 low, high;
  bool holds(Vec2 p) const { return p.x > low.x && p.x < high.x && p.y > low.y && p.y < high.y; }
};

struct Station {
  std::string name;
  Vec3 at;
  double yaw = 0;  // rad
};

struct Plan {
  std::vector<Material> materials;
  std::vector<Wall> walls;
  std::vector<Door> doors;
  std::vector<Room> rooms;
  Room corridor;  // or the room most like one
  bool has_corridor = true;
  std::vector<Station> stations;
  Room whole;
  double angle = 0;  // rad, of the plan in the world
  Vec2 shift;        // m, of the plan's origin

  Vec2 to_world(Vec2 own) const;
  Vec2 to_own(Vec2 world) const;
  double top() const;  // m, of the highest wall
  // Index of the room at a place in the world, or -1: the corridor, or outside.
  int room_at(Vec2 world) const;
};

struct PlanNeeds {
  bool corridor_station = false;  // one station in the corridor
  bool high_stations = false;     // two stations above the walls
};

Plan draw_plan(Random& random, const PlanNeeds& needs);
// A given plan with wall losses and stations.
Plan furnished(Plan given, Random& random, const PlanNeeds& needs);

}  // namespace muster::exam
