// Upright walls with doors, level floors, and exact crossings of them by a straight radio link, the same in both
// directions. README.md defines a crossing and gives the reasons.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/box_tree.hpp"
#include "scene/floors.hpp"
#include "scene/point.hpp"
#include "scene/wall_columns.hpp"

namespace muster::scene {

// An upright rectangle: its centre plane is over (x0, y0) -> (x1, y1) and covers the heights [base, base + height). The
// thickness, in metres and half to each side, does not affect crossings.
struct Wall {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  double base = 0, height = 0, thickness = 0;
  int material = 0;
};

// A gap in a wall, [at, at + width) metres along it from (x0, y0), from the wall's base up to `height` (or to the
// wall's own top, if that is lower). An open door is empty; a closed one is of its own material.
struct Door {
  int wall = 0;
  double at = 0, width = 0, height = 0;
  int material = 0;
  bool open = false;
};

struct Crossing {
  int wall = 0;   // or -1, of a floor
  int door = -1;  // the closed door that is crossed instead of its wall, or -1
  int material = 0;
  double fraction = 0;       // of the way along the link, from its first end: [0, 1]
  double z = 0;              // m
  double cos_incidence = 0;  // between the link and the normal of the wall or floor: (0, 1]
  int floor = -1;            // or -1, of a wall
};

// A link between two of a list of points, by their places in it.
struct Pair {
  std::uint32_t from = 0, to = 0;
};

// The points in spatial order, as places in the list: neighbours in the order are near each other.
std::vector<std::uint32_t> spatial_order(const std::vector<Point>& points);

// True if the points are already nearly in spatial order: most are at their position in it, or near it.
bool in_spatial_order(const std::vector<Point>& points);

// The fastest kernel that this machine can run. All give the same counts.
const WallKernel& best_wall_kernel();

// Walls are fixed; doors open and close. Reading is safe from several threads while no door moves.
class Scene {
 public:
  // Materials are numbered from 0 to materials - 1. Throws std::runtime_error with the faulty row and the reason.
  Scene(const std::vector<Wall>& walls, const std::vector<Door>& doors, int materials,
        const std::vector<Floor>& floors = {});

  int materials() const { return materials_; }
  bool is_open(int door) const { return doors_.at(door).open; }
  void set_open(int door, bool open) { doors_.at(door).open = open; }

  // Replaces `out` by the crossings of the straight line from p to q, walls by their rows, then floors by theirs. All
  // but `fraction` is the same, bit for bit, from q to p. Throws std::runtime_error for a point beyond 100 km.
  void crossings(const Point& p, const Point& q, std::vector<Crossing>& out) const;

  // The same as counts: fills by_material[0 .. materials()).
  void counts(const Point& p, const Point& q, int* by_material) const;

  // The same for many links at once, much faster: fills by_material[material x number of links + link]. Fastest where
  // points are in spatial order and links in ascending order of both ends.
  void counts(const std::vector<Point>& points, const std::vector<Pair>& links, std::vector<int>& by_material,
              const WallKernel& kernel = best_wall_kernel()) const;

 private:
  // In lattice steps; a -> b runs southward, turned if need be.
  struct LatticeWall {
    Spot a, b;
    std::int64_t base = 0, top = 0;
    std::int64_t length = 0;
    int material = 0;
    bool turned = false;
    std::vector<int> doors;
  };

  // In lattice steps along the wall, from a.
  struct LatticeDoor {
    std::int64_t from = 0, to = 0, top = 0;
    int material = 0;
    bool open = false;
  };

  struct Link;
  struct Hit;
  class ManyLinks;

  void add_wall(const Wall& wall);
  void add_door(const Door& door);
  bool cross(const Link& link, int wall, Hit& hit) const;
  void counts_of_near_parts(const std::vector<Point>& points, const std::vector<Pair>& links,
                            std::vector<int>& by_material, const WallKernel& kernel) const;
  template <class Report>
  void for_each_crossing(const Link& link, const Report& report) const;

  std::vector<LatticeWall> walls_;
  std::vector<LatticeDoor> doors_;
  Floors floors_;
  BoxTree tree_;
  WallColumns columns_;
  int materials_ = 0;
};

}  // namespace muster::scene
