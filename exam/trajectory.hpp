// Trajectories of robots at random over a plan: from room to room through open doors, with a clearance to walls.
#pragma once

#include <array>
#include <utility>

#include "exam/plan.hpp"

namespace muster::exam {

struct Stop {
  double t = 0;  // s
  Vec2 at;
  double yaw = 0, speed = 0;  // rad, m/s
};

// Walls without their open doors, in the plan's own frame.
std::vector<std::pair<Vec2, Vec2>> solid_pieces(const Plan& plan);

double distance_to(Vec2 place, Vec2 a, Vec2 b);

class Floor {
 public:
  explicit Floor(const Plan& plan);

  // The largest set of mutually reachable rooms, by area.
  std::vector<Room> connected(const std::vector<Room>& rooms) const;

  // `ticks` poses `period` seconds apart.
  std::vector<Stop> wander(Random& random, int ticks, double period) const;

 private:
  struct Cell {
    int x = 0, y = 0;
  };
  static std::array<Cell, 4> neighbours(Cell c) {
    return {{Cell{c.x + 1, c.y}, Cell{c.x - 1, c.y}, Cell{c.x, c.y + 1}, Cell{c.x, c.y - 1}}};
  }
  // Connected components of the free floor, by index; -1 where it is not free.
  std::vector<int> parts() const;
  bool is_free(Cell c) const;
  bool is_free(Vec2 own) const;
  bool sees(Vec2 own_from, Vec2 own_to) const;
  Vec2 centre(Cell c) const;
  Cell cell(Vec2 own) const;
  Vec2 place_in(Random& random, const Room& room) const;
  std::vector<Vec2> way(Vec2 own_from, Vec2 own_to) const;
  std::size_t index(Cell c) const {
    return static_cast<std::size_t>(c.y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c.x);
  }

  const Plan& plan_;
  int columns_ = 0, rows_ = 0;
  std::vector<char> blocked_;
};

}  // namespace muster::exam
