#include "roadmap/graph.hpp"

namespace muster::roadmap {
namespace {

// True where a line through the corner along d leaves the rectangle on one side.
bool touches(const Corner& corner, const Point& d) {
  constexpr double rounding = 1e-12;  // of a line along a side, in squares of its length
  const double along = corner.along.x * d.x + corner.along.y * d.y;
  const double across = corner.across.x * d.x + corner.across.y * d.y;
  return along * across <= rounding * (d.x * d.x + d.y * d.y);
}

}  // namespace

Graph visibility_graph(const Obstacles& obstacles, const Area& area) {
  std::vector<Corner> corners;
  for (const Corner& c : obstacles.corners()) {
    if (area.holds(c.at)) corners.push_back(c);
  }
  Graph result;
  for (const Corner& c : corners) result.nodes.push_back(c.at);
  for (std::uint32_t a = 0; a < corners.size(); ++a) {
    for (std::uint32_t b = a + 1; b < corners.size(); ++b) {
      const Point d{corners[b].at.x - corners[a].at.x, corners[b].at.y - corners[a].at.y};
      if (touches(corners[a], d) && touches(corners[b], d) && obstacles.is_free(corners[a].at, corners[b].at))
        result.edges.push_back({a, b});
    }
  }
  return result;
}

}  // namespace muster::roadmap
