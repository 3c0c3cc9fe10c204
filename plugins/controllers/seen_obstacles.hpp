// What a laser saw that is not on the plan: echoes on a lattice, each with the time at which it was seen last.
#pragma once

#include <map>
#include <muster/plugin.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "roadmap/obstacles.hpp"

namespace muster {

class SeenObstacles {
 public:
  SeenObstacles() = default;
  explicit SeenObstacles(std::string_view bytes);  // as bytes() gave them
  std::string bytes() const;

  std::size_t size() const { return seen_.size(); }

  // Takes an echo. True if none was remembered in its cell.
  bool see(const roadmap::Point& echo, double time);
  // Drops what was not seen for `forget` seconds.
  void forget(double time, double forget);

  // True where the straight piece keeps `radius` from every echo; from one that is nearer to the start already, it is
  // enough to come no nearer.
  bool is_free(const roadmap::Point& from, const roadmap::Point& to, const roadmap::Point& start, double radius) const;

 private:
  struct Spot {
    double x, y, t;
  };
  static constexpr double cell = 0.1;               // [m] edge of a cell, of which one echo is kept
  std::map<std::pair<double, double>, Spot> seen_;  // by the cell's column and row
};

// Places of a scan's echoes in the frame of the robot's odometry, those within `reach` of the laser. Echoes from the
// ground are left out.
std::vector<roadmap::Point> echoes_of(const Scan& scan, std::string_view ranges, double reach);

}  // namespace muster
