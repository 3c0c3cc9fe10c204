// Shortest ways in a graph.
#pragma once

#include <functional>

#include "roadmap/graph.hpp"

namespace muster::roadmap {

// Cost of a straight piece, at least its length; infinite where it is closed.
using Cost = std::function<double(const Point&, const Point&)>;
inline double length_cost(const Point& a, const Point& b) { return distance(a, b); }

enum class Guide {
  distance,  // A* (Hart, Nilsson, Raphael 1968): no way is shorter than the straight line, so it finds the cheapest
  none       // Dijkstra
};

struct Found {
  std::vector<std::uint32_t> nodes;  // from the first to the last; empty: there is no way
  double cost = 0;
  std::size_t expanded = 0;  // places whose neighbours were looked at
};

Found cheapest(const Graph& graph, std::uint32_t from, std::uint32_t to, const Cost& cost,
               Guide guide = Guide::distance);

}  // namespace muster::roadmap
