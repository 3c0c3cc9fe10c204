#include "roadmap/route.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

namespace muster::roadmap {
namespace {

std::string text(double metres) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, metres, std::chars_format::general, 4).ptr};
}

std::string text(const Point& p) { return text(p.x) + ' ' + text(p.y); }

// Numbers of places with a free line to p; p lacks `give` of the radius.
std::vector<std::uint32_t> joined(const Graph& graph, const Obstacles& obstacles, const Point& p, double give) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t i = 0; i < graph.nodes.size(); ++i) {
    if (obstacles.is_free(p, graph.nodes[i], give)) result.push_back(i);
  }
  return result;
}

// `, which lies outside of the plan (x 0 to 12, y 0 to 6 m)`, where it does: beyond all walls.
std::string outside(const Obstacles& obstacles, const Point& p) {
  if (obstacles.blocks().empty()) return "";
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Point low{infinite, infinite}, high{-infinite, -infinite};
  for (const Block& block : obstacles.blocks()) {
    for (const Point& end : {block.from, block.to}) {
      low = {std::min(low.x, end.x), std::min(low.y, end.y)};
      high = {std::max(high.x, end.x), std::max(high.y, end.y)};
    }
  }
  if (p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y) return "";
  return ", which lies outside of the plan (x " + text(low.x) + " to " + text(high.x) + ", y " + text(low.y) + " to " +
         text(high.y) + " m)";
}

}  // namespace

Route route(const Graph& graph, const Obstacles& obstacles, const Point& start, const Point& goal, const Cost& cost,
            Guide guide) {
  constexpr double spare = 1e-6;  // [m] the start lies outside what is left of the radius
  Route result;
  const auto refused = [&](const std::string& fault) { return result.fault = fault, result; };
  const double lacks = obstacles.depth(start), give = lacks > 0 ? lacks + spare : 0;
  if (lacks > 0 && !(lacks < obstacles.radius())) return refused("the start " + text(start) + " is inside a wall");
  if (!obstacles.is_free(goal))
    return refused("the goal " + text(goal) + " is " + text(obstacles.clearance(goal)) +
                   " m from a wall; expected at least the radius, " + text(obstacles.radius()) + " m, on all sides");
  Graph joint = graph;
  const auto from = static_cast<std::uint32_t>(joint.nodes.size()), to = from + 1;
  joint.nodes.push_back(start);
  joint.nodes.push_back(goal);
  for (const std::uint32_t i : joined(graph, obstacles, start, give)) joint.edges.push_back({from, i});
  for (const std::uint32_t i : joined(graph, obstacles, goal, 0)) joint.edges.push_back({i, to});
  if (obstacles.is_free(start, goal, give)) joint.edges.push_back({from, to});
  const Found found = cheapest(joint, from, to, cost, guide);
  if (found.nodes.empty())
    return refused("no way leads from " + text(start) + outside(obstacles, start) + " to " + text(goal) +
                   outside(obstacles, goal));
  for (const std::uint32_t i : found.nodes) {
    if (!result.points.empty() && result.points.back() == joint.nodes[i]) continue;
    if (!result.points.empty()) result.length += distance(result.points.back(), joint.nodes[i]);
    result.points.push_back(joint.nodes[i]);
  }
  result.cost = found.cost;
  return result;
}

}  // namespace muster::roadmap
