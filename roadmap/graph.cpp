#include "roadmap/graph.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace muster::roadmap {

Area area_of(const std::vector<Block>& blocks, const std::vector<Point>& places, double room) {
  std::vector<Point> all = places;
  for (const Block& b : blocks) all.push_back(b.from), all.push_back(b.to);
  if (all.empty()) throw std::runtime_error("there is neither a wall nor a robot: no area to plan in");
  Area area{all[0].x, all[0].y, all[0].x, all[0].y};
  for (const Point& p : all) {
    area.x0 = std::min(area.x0, p.x), area.x1 = std::max(area.x1, p.x);
    area.y0 = std::min(area.y0, p.y), area.y1 = std::max(area.y1, p.y);
  }
  return {area.x0 - room, area.y0 - room, area.x1 + room, area.y1 + room};
}

Graph without_lone(const Graph& graph, std::size_t& alone) {
  constexpr std::uint32_t none = ~0u;
  std::vector<std::uint32_t> number(graph.nodes.size(), none);
  for (const Edge& e : graph.edges) number[e.a] = number[e.b] = 0;
  Graph result;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    if (number[i] == none) continue;
    number[i] = static_cast<std::uint32_t>(result.nodes.size());
    result.nodes.push_back(graph.nodes[i]);
  }
  for (const Edge& e : graph.edges) result.edges.push_back({number[e.a], number[e.b]});
  alone = graph.nodes.size() - result.nodes.size();
  return result;
}

std::vector<std::uint32_t> components_of(const Graph& graph) {
  std::vector<std::uint32_t> root(graph.nodes.size());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t at) {
    while (root[at] != at) at = root[at] = root[root[at]];
    return at;
  };
  for (const Edge& e : graph.edges) {
    const std::uint32_t a = find(e.a), b = find(e.b);
    root[std::max(a, b)] = std::min(a, b);
  }
  // Roots are the first places of their components, so each has its number before it is asked for.
  std::vector<std::uint32_t> result(root.size());
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < root.size(); ++i) result[i] = find(i) == i ? count++ : result[find(i)];
  return result;
}

std::size_t count_of(const std::vector<std::uint32_t>& components) {
  return components.empty() ? 0 : *std::max_element(components.begin(), components.end()) + 1;
}

std::size_t branches_of(const Graph& graph) {
  std::vector<int> degree(graph.nodes.size());
  for (const Edge& e : graph.edges) ++degree[e.a], ++degree[e.b];
  return static_cast<std::size_t>(std::count_if(degree.begin(), degree.end(), [](int d) { return d > 2; }));
}

}  // namespace muster::roadmap
