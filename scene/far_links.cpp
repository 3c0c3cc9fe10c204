#include "scene/far_links.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "scene/lattice.hpp"
#include "scene/refusal.hpp"

namespace muster::scene {
namespace {

constexpr double edge = extent - 1 / steps_per_metre;  // m

void check(const Point& p) {
  if (within_reach(p.x) && within_reach(p.y) && within_reach(p.z)) return;
  refuse_point(p.x, p.y, p.z);
}

Point at(const Point& p, const Point& q, double share) {
  const auto between = [&](double a, double b) { return std::clamp(a + share * (b - a), -edge, edge); };
  return {between(p.x, q.x), between(p.y, q.y), between(p.z, q.z)};
}

// Narrows [begin, end] to the shares where a coordinate is within the edge (Liang and Barsky).
void narrow(double from, double to, double& begin, double& end) {
  const double way = to - from;
  if (way == 0) {
    if (std::abs(from) > edge) end = begin - 1;
    return;
  }
  const double a = (-edge - from) / way, b = (edge - from) / way;
  begin = std::max(begin, std::min(a, b));
  end = std::min(end, std::max(a, b));
}

}  // namespace

bool is_near(const Point& p) { return within_extent(p.x) && within_extent(p.y) && within_extent(p.z); }

std::optional<NearPart> near_part(const Point& p, const Point& q) {
  check(p);
  check(q);
  if (is_near(p) && is_near(q)) return NearPart{p, q, 0, 1};
  // One order of the ends, so that both directions are cut alike.
  if (std::tie(q.x, q.y, q.z) < std::tie(p.x, p.y, p.z)) {
    const auto turned = near_part(q, p);
    if (!turned) return std::nullopt;
    return NearPart{turned->to, turned->from, 1 - turned->end, 1 - turned->begin};
  }
  double begin = 0, end = 1;
  narrow(p.x, q.x, begin, end);
  narrow(p.y, q.y, begin, end);
  narrow(p.z, q.z, begin, end);
  if (begin > end) return std::nullopt;
  return NearPart{is_near(p) ? p : at(p, q, begin), is_near(q) ? q : at(p, q, end), begin, end};
}

}  // namespace muster::scene
