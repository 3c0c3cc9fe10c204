#include "diagnosis/radio/causes/place_axes.hpp"

#include <cmath>
#include <string_view>

namespace muster::diagnosis {
namespace {

Axis length(const muster_param& p, const MeasurementGeometry& s, const CauseShape& shape) {
  const double u = s.scale;
  if (shape.place == PlaceShape::segment) return logarithmic(p, 0.8, 6 * u, {1.5 * u, 3 * u}, 0.2);
  if (shape.place == PlaceShape::point && shape.has_heading_of_plan()) {
    if (p.value < 1) return logarithmic(p, 0.2, 5 * u, {0.5 * u, 1.5 * u}, 0.4);  // depth
    return logarithmic(p, 1, 60 * u, {3 * u, 6 * u}, 0.05);
  }
  const bool is_of_a_thing = p.max <= 10 || p.value < 1;
  // Hills and woods take up more of their area than things of a room do.
  if (shape.place == PlaceShape::point && is_of_a_thing && s.is_outdoors())
    return logarithmic(p, 0.15 * u, 15 * u, {0.45 * u, 0.8 * u, 2.5 * u, 5 * u, 10 * u}, 0.3);
  if (shape.place == PlaceShape::point && is_of_a_thing) return logarithmic(p, 0.15, 1.5, {0.45, 0.8}, 0.3);
  if (shape.place == PlaceShape::point) return logarithmic(p, 1.5, 15, {3, 6}, 0.2);
  const double low = std::log(s.distance.low * 1.1), high = std::log(s.distance.high * 0.8);
  std::vector<double> values;
  for (const double v : evenly(low, high, 12)) values.push_back(std::exp(v));
  return logarithmic(p, s.distance.low, s.distance.high, values, 0.12);
}

}  // namespace

std::optional<Axis> axis_of(const muster_param& p, const MeasurementGeometry& s, const CauseShape& shape, bool alone) {
  const std::string_view unit = p.unit;
  if (p.flags & MUSTER_CYCLIC) return axis_over(p, s.time, shape, alone, s.sampling);
  if (p.flags & MUSTER_LOG) {
    if (unit == "m") return length(p, s, shape);
    // A loss: from below that of one wall to above that of any link.
    if (unit == "dB") return logarithmic(p, 2, 300, {5, 8, 12, 18, 28, 50, 100}, 0.2);
    return axis_over(p, s.time, shape, alone, s.sampling);
  }
  if (unit == "dBm")
    return Axis{p.name, false, s.level.low, s.level.high, 0.1 * s.level.length(), evenly(s.level.low, s.level.high, 9)};
  // Width of a wall's edges.
  if (unit == "m" && shape.place == PlaceShape::segment)
    return Axis{p.name, false, p.min, p.max, (p.max - p.min) / 5, {p.min}};
  if (unit == "m" && shape.place == PlaceShape::point) {
    // Height of an obstacle: above moving radios only, or above all radios.
    std::vector<double> heights{s.above_moving, s.height.high + 0.5};
    if (heights[0] >= s.height.high) heights.erase(heights.begin());
    return Axis{p.name, false, heights.front(), heights.back(), 0, heights};
  }
  if (unit == "m") {
    if (!s.has_height) return {};
    return Axis{p.name,
                false,
                s.height.low,
                s.height.high,
                0.1 * s.height.length(),
                evenly(s.height.at(0.1), s.height.at(0.9), 7)};
  }
  return axis_over(p, s.time, shape, alone, s.sampling);
}

}  // namespace muster::diagnosis
