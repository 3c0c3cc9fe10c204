// A roadmap: places, and straight pieces between them that a robot can drive.
#pragma once

#include <cstdint>
#include <vector>

#include "roadmap/obstacles.hpp"

namespace muster::roadmap {

struct Edge {
  std::uint32_t a, b;  // numbers of places
};

struct Graph {
  std::vector<Point> nodes;
  std::vector<Edge> edges;
};

// A rectangle in plan along the axes, [m].
struct Area {
  double x0, y0, x1, y1;

  bool holds(const Point& p) const { return p.x >= x0 && p.x <= x1 && p.y >= y0 && p.y <= y1; }
};

// Of all blocks and places, and `room` around them. Throws std::runtime_error without any.
Area area_of(const std::vector<Block>& blocks, const std::vector<Point>& places, double room);

// A lattice: the free places at whole multiples of `step`, each joined to those of its eight neighbours to which it has
// a free straight line. Throws std::runtime_error where that is more than `most_places`.
Graph lattice(const Obstacles& obstacles, const Area& area, double step);
constexpr double most_places = 1e6;

// The reduced visibility graph (Lozano-Perez and Wesley 1979; de Berg et al., Computational Geometry, chapter 15):
// corners of the grown walls, joined where the line between them is free and touches both without cutting in. A
// shortest way turns at such corners and along such lines only.
Graph visibility_graph(const Obstacles& obstacles, const Area& area);

// The same without places that no piece leads to; `alone` counts these.
Graph without_lone(const Graph& graph, std::size_t& alone);

// For each place the number of its component, from 0 in the order of their first places.
std::vector<std::uint32_t> components_of(const Graph& graph);
std::size_t count_of(const std::vector<std::uint32_t>& components);
// How many places more than two pieces lead to.
std::size_t branches_of(const Graph& graph);

// How much of the area is outside all grown walls [m2], by lines `between` apart.
double free_area(const Obstacles& obstacles, const Area& area, double between = 0.02);

}  // namespace muster::roadmap
