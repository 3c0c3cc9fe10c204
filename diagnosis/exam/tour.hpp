// Robots that wander over a plan: from room to room through open doors, never closer to a wall than a clearance.
#pragma once

#include "plan.hpp"

namespace muster::exam {

struct Stop {
  double t = 0;  // s
  Vec2 at;
  double yaw = 0, speed = 0;  // rad, m/s
};

class Floor {
 public:
  explicit Floor(const Plan& plan);

  // `ticks` places `period` seconds apart.
  std::vector<Stop> wander(Random& random, int ticks, double period) const;

 private:
  struct Cell {
    int x = 0, y = 0;
  };
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
