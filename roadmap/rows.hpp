// A roadmap and the walls that it was made for, as rows of a table.
#pragma once

#include "roadmap/graph.hpp"

namespace muster::roadmap {

// With an empty width and radius: a piece that can be driven, both ways. With both: the centre line of a wall of that
// width, as it was grown by that radius. A place is where pieces end.
struct Row {
  static constexpr const char* columns = "x0[m] y0[m] x1[m] y1[m] width[m]? radius[m]? .";
  double x0, y0, x1, y1, width, radius;
};

// robot/NAME/roadmap: `graph` has the rows, as doubles. `recipe` tells settings apart; 0: it is not made yet.
struct Cell {
  static constexpr const char* columns = "nodes edges branches components radius[m] recipe graph{}";
  static constexpr unsigned payload_column = 6;
  double nodes, edges, branches, components, radius, recipe, graph;
};

struct Map {
  Graph graph;
  Obstacles obstacles;
};

std::vector<Row> rows_of(const Graph& graph, const Obstacles& obstacles);
// Pieces that end at the same coordinates meet there. Throws std::runtime_error with the number of the faulty row.
Map map_of(const Row* rows, std::size_t count);

}  // namespace muster::roadmap
