#include <cmath>
#include <stdexcept>

#include "roadmap/graph.hpp"

namespace muster::roadmap {

Graph lattice(const Obstacles& obstacles, const Area& area, double step) {
  constexpr double rounding = 1e-9;  // of a place on the area's border, in steps
  const double west = std::ceil(area.x0 / step - rounding), east = std::floor(area.x1 / step + rounding);
  const double south = std::ceil(area.y0 / step - rounding), north = std::floor(area.y1 / step + rounding);
  if (!(east >= west && north >= south)) return {};
  if (!((east - west + 1) * (north - south + 1) <= most_places))
    throw std::runtime_error("the lattice has more than a million places; expected a larger step or a smaller area");
  const auto width = static_cast<std::size_t>(east - west) + 1, height = static_cast<std::size_t>(north - south) + 1;
  constexpr std::uint32_t none = ~0u;
  std::vector<std::uint32_t> number(width * height, none);
  Graph result;
  for (std::size_t i = 0; i < number.size(); ++i) {
    const std::size_t column = i % width, line = i / width;
    const Point at{(west + static_cast<double>(column)) * step, (south + static_cast<double>(line)) * step};
    if (!obstacles.is_free(at)) continue;
    number[i] = static_cast<std::uint32_t>(result.nodes.size());
    result.nodes.push_back(at);
  }
  const auto join = [&](std::size_t from, std::size_t to) {
    const std::uint32_t a = number[from], b = number[to];
    if (a != none && b != none && obstacles.is_free(result.nodes[a], result.nodes[b])) result.edges.push_back({a, b});
  };
  for (std::size_t i = 0; i < number.size(); ++i) {
    const bool has_east = i % width + 1 < width, has_north = i / width + 1 < height;
    if (has_east) join(i, i + 1);
    if (has_north && i % width > 0) join(i, i + width - 1);
    if (has_north) join(i, i + width);
    if (has_north && has_east) join(i, i + width + 1);
  }
  return result;
}

}  // namespace muster::roadmap
