// Walls in plan, grown by a robot's radius: where its centre may be, and along which straight lines it may go.
#pragma once

#include <cmath>
#include <vector>

namespace muster::roadmap {

struct Point {
  double x = 0, y = 0;  // [m]
  bool operator==(const Point& other) const { return x == other.x && y == other.y; }
};

inline double distance(const Point& a, const Point& b) { return std::hypot(b.x - a.x, b.y - a.y); }
// From a point to the straight piece between two others.
double distance(const Point& p, const Point& a, const Point& b);

// An upright slab seen from above: a rectangle around its centre line, which ends where it does.
struct Block {
  Point from, to;
  double width = 0;  // full [m]
};

// A corner of a grown rectangle: the rectangle lies on the inner side of both directions.
struct Corner {
  Point at;
  Point along, across;  // unit vectors that point outwards
};

// The Minkowski sum of each block with a disc, with square corners in place of round ones: a robot's centre that is not
// inside any sum keeps the radius from every wall, and at a corner up to 0.41 times more.
class Obstacles {
 public:
  Obstacles() = default;
  Obstacles(const std::vector<Block>& blocks, double radius);

  const std::vector<Block>& blocks() const { return blocks_; }
  double radius() const { return radius_; }

  // Borders are free. `give` is taken from the radius.
  bool is_free(const Point& p, double give = 0) const;
  bool is_free(const Point& a, const Point& b, double give = 0) const;
  // How much of the radius p lacks: 0 where it is free; the radius or more inside a block.
  double depth(const Point& p) const;
  // From p to the nearest block, without the radius; 0 inside, infinite without any.
  double clearance(const Point& p) const;

  // Those at which a way may turn: each once, without those in or on another grown rectangle.
  std::vector<Corner> corners() const;

  // The part of the line at height y that a grown rectangle covers; from > to where it covers none.
  struct Span {
    double from, to;
  };
  Span covered(std::size_t block, double y) const;

 private:
  struct Frame {
    Point middle, axis;  // the axis is a unit vector along the block
    double half_length, half_width;

    Point local(const Point& p) const;
    bool is_crossed(const Point& a, const Point& b, double grown) const;
  };

  std::vector<Block> blocks_;
  std::vector<Frame> frames_;
  double radius_ = 0;
};

}  // namespace muster::roadmap
