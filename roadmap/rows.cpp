#include "roadmap/rows.hpp"

#include <map>
#include <muster/plugin.hpp>
#include <stdexcept>
#include <string>
#include <utility>

namespace muster::roadmap {

std::vector<Row> rows_of(const Graph& graph, const Obstacles& obstacles) {
  std::vector<Row> result;
  for (const Edge& e : graph.edges) {
    const Point &a = graph.nodes[e.a], &b = graph.nodes[e.b];
    result.push_back({a.x, a.y, b.x, b.y, null(), null()});
  }
  for (const Block& b : obstacles.blocks())
    result.push_back({b.from.x, b.from.y, b.to.x, b.to.y, b.width, obstacles.radius()});
  return result;
}

Map map_of(const Row* rows, std::size_t count) {
  Map map;
  std::map<std::pair<double, double>, std::uint32_t> numbers;
  const auto number = [&](double x, double y) {
    const auto [at, is_new] = numbers.emplace(std::pair{x, y}, static_cast<std::uint32_t>(map.graph.nodes.size()));
    if (is_new) map.graph.nodes.push_back({x, y});
    return at->second;
  };
  std::vector<Block> blocks;
  double radius = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Row& r = rows[i];
    const auto refuse = [&](const char* what) {
      throw std::runtime_error("row " + std::to_string(i + 1) + " of the roadmap " + what);
    };
    if (r.x0 == r.x1 && r.y0 == r.y1) refuse("has no length; expected two different ends");
    if (is_null(r.width) != is_null(r.radius))
      refuse("has one of width and radius; expected both, for a wall, or neither, for a piece of the way");
    if (is_null(r.width)) {
      const std::uint32_t a = number(r.x0, r.y0), b = number(r.x1, r.y1);
      map.graph.edges.push_back({a, b});
      continue;
    }
    if (!(r.width >= 0 && r.radius >= 0)) refuse("has a negative width or radius");
    if (!blocks.empty() && r.radius != radius)
      refuse("has another radius than a row before; expected one for all walls");
    radius = r.radius;
    blocks.push_back({{r.x0, r.y0}, {r.x1, r.y1}, r.width});
  }
  map.obstacles = Obstacles(blocks, radius);
  return map;
}

}  // namespace muster::roadmap
