// A way from one place to another: straight onto a roadmap, along it, and straight off it.
#pragma once

#include <string>

#include "roadmap/search.hpp"

namespace muster::roadmap {

struct Route {
  std::vector<Point> points;  // from the start to the goal
  double length = 0;          // [m]
  double cost = 0;            // the same without a cost of its own
  std::string fault;          // why there is none; "" if there is one
};

// The cheapest route whose pieces are free. Start and goal are joined to every place of the roadmap, and to each other,
// by straight lines where these are free. A start nearer to a wall than the radius leaves with what it has; a goal
// there is a fault.
Route route(const Graph& graph, const Obstacles& obstacles, const Point& start, const Point& goal,
            const Cost& cost = length_cost, Guide guide = Guide::distance);

}  // namespace muster::roadmap
