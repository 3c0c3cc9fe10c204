#include <algorithm>

#include "roadmap/graph.hpp"

namespace muster::roadmap {

double free_area(const Obstacles& obstacles, const Area& area, double between) {
  const auto lines = static_cast<std::size_t>(std::clamp((area.y1 - area.y0) / between, 1.0, 1e5));
  const double height = (area.y1 - area.y0) / static_cast<double>(lines);
  double sum = 0;
  std::vector<Obstacles::Span> spans;
  for (std::size_t line = 0; line < lines; ++line) {
    const double y = area.y0 + (static_cast<double>(line) + 0.5) * height;
    spans.clear();
    for (std::size_t i = 0; i < obstacles.blocks().size(); ++i) {
      const Obstacles::Span s = obstacles.covered(i, y);
      if (s.from < s.to) spans.push_back({std::max(s.from, area.x0), std::min(s.to, area.x1)});
    }
    std::sort(spans.begin(), spans.end(), [](const auto& a, const auto& b) { return a.from < b.from; });
    double done = area.x0, covered = 0;
    for (const Obstacles::Span& s : spans) {
      covered += std::max(0.0, s.to - std::max(done, s.from));
      done = std::max(done, s.to);
    }
    sum += (area.x1 - area.x0 - covered) * height;
  }
  return sum;
}

}  // namespace muster::roadmap
