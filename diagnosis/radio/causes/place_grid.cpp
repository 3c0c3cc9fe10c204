#include "diagnosis/radio/causes/place_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/radio/causes/place_moves.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

using std::numbers::pi;

std::vector<VectorXd> places_over(PlaceShape shape, const MeasurementGeometry& survey, bool large) {
  const MeasurementGeometry s = in_own_unit(survey);
  const double area = s.east.length() * s.north.length();
  const double spacing = large ? std::max(2.0, std::sqrt(area / 100)) : std::max(0.8, std::sqrt(area / 500));
  const std::vector<double> lengths = large ? std::vector<double>{5, 10} : std::vector<double>{1.3, 2.2, 3.6, 5.2};
  const int turns = large ? 2 : 4;
  std::vector<VectorXd> result;
  for (double x = s.east.low + spacing / 2; x < s.east.high; x += spacing) {
    for (double y = s.north.low + spacing / 2; y < s.north.high; y += spacing) {
      if (shape == PlaceShape::point) {
        result.push_back(Eigen::Vector2d(x, y));
        continue;
      }
      for (const double length : lengths) {
        for (int k = 0; k < turns; ++k) result.push_back(Eigen::Vector4d(x, y, length, s.plan_angle + k * pi / turns));
      }
    }
  }
  for (VectorXd& place : result) place.head(shape == PlaceShape::segment ? 3 : 2) *= survey.scale;
  return result;
}

// Places around each radio's mapped place, and far ones over the whole area.
std::vector<VectorXd> around_radios(const CauseShape& shape, const MeasurementGeometry& survey,
                                    const LinkModel& model) {
  const double around = 5 * survey.scale;
  const double area = survey.east.length() * survey.north.length();
  const double spacing =
      std::max(2 * survey.scale, std::sqrt(area * static_cast<double>(shape.rows.size()) / thresholds::far_places));
  std::vector<VectorXd> result;
  for (std::size_t row = 0; row < shape.rows.size(); ++row) {
    const auto at = place_of_radio(model, shape.rows[row].at(0));
    if (!at) continue;
    for (const double share : {0.05, 0.12, 0.3, 0.6, 1.0}) {
      for (int k = 0; k < 8; ++k) {
        const double r = share * around, angle = (k + (share == 0.3 || share == 1.0 ? 0.5 : 0)) * pi / 4;
        result.push_back(
            theta_of(row, Eigen::Vector2d(at->x() + r * std::cos(angle), at->y() + r * std::sin(angle)), {}));
      }
    }
    for (double x = survey.east.low + spacing / 2; x < survey.east.high; x += spacing) {
      for (double y = survey.north.low + spacing / 2; y < survey.north.high; y += spacing) {
        const Eigen::Vector2d place(x, y);
        if ((place - *at).norm() > around + spacing / 2) result.push_back(theta_of(row, place, {}));
      }
    }
  }
  return result;
}

// Strips along and across the plan through radios that stand: over the whole area, and to either side of the radio. A
// long strip is not met from a short piece of it.
std::vector<VectorXd> through_radios(const MeasurementGeometry& s) {
  constexpr std::size_t most = 12;
  std::vector<VectorXd> result;
  for (std::size_t k = 0; k < std::min(most, s.standing.size()); ++k) {
    const Eigen::Vector2d radio(s.standing[k][0], s.standing[k][1]);
    for (const double angle : {s.plan_angle, s.plan_angle + pi / 2}) {
      const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
      double low = 0, high = 0;  // m, from the radio
      for (const double x : {s.east.low, s.east.high}) {
        for (const double y : {s.north.low, s.north.high}) {
          const double at = along.dot(Eigen::Vector2d(x, y) - radio);
          low = std::min(low, at), high = std::max(high, at);
        }
      }
      for (const auto& [from, to] : {std::pair(low, high), std::pair(low, 0.0), std::pair(0.0, high)}) {
        const Eigen::Vector2d middle = radio + along * (from + to) / 2;
        if (to - from > thresholds::shortest_strip * s.scale)
          result.push_back(Eigen::Vector4d(middle.x(), middle.y(), to - from, angle));
      }
    }
  }
  return result;
}

double inside(double value, const Axis& axis) { return std::clamp(value, axis.lower, axis.upper); }

std::vector<VectorXd> between_walls(const CauseShape& shape, const MeasurementGeometry& survey) {
  std::vector<VectorXd> result;
  for (const OrientedRectangle& s : survey.strips)
    result.push_back(
        theta_of(0, Eigen::Vector4d(s.x, s.y, s.length, s.angle), {inside(std::log(s.width), shape.axes[0])}));
  return result;
}

std::vector<VectorXd> rooms_of_plan(const CauseShape& shape, const MeasurementGeometry& survey) {
  std::vector<VectorXd> result;
  const auto others = products({shape.axes.begin() + 2, shape.axes.end()});
  for (const OrientedRectangle& s : survey.rooms) {
    for (const auto& more : others) {
      std::vector<double> axes{inside(std::log(s.length), shape.axes[0]), inside(std::log(s.width), shape.axes[1])};
      axes.insert(axes.end(), more.begin(), more.end());
      result.push_back(theta_of(0, Eigen::Vector2d(s.x, s.y), axes));
    }
  }
  return result;
}

}  // namespace

std::optional<Eigen::Vector2d> place_of_radio(const LinkModel& model, const std::string& name) {
  const auto end = model.first_end(name);
  return end ? std::optional(Eigen::Vector2d(end->x, end->y)) : std::nullopt;
}

std::vector<VectorXd> starts_of(const CauseShape& shape, const MeasurementGeometry& survey, const LinkModel& model,
                                bool stands) {
  if (shape.cause.meaning().kind == MUSTER_WORLD_EDIT && shape.place == PlaceShape::point)
    return around_radios(shape, survey, model);
  std::vector<VectorXd> rooms;
  if (shape.is_room() && !survey.rooms.empty()) rooms = rooms_of_plan(shape, survey);
  const std::vector<OrientedRectangle> halls = survey.halls();
  if (!rooms.empty() && halls.empty()) return rooms;
  if (shape.is_strip() && !survey.strips.empty()) return between_walls(shape, survey);
  if (shape.place == PlaceShape::none) return start_grid(shape, {VectorXd()});
  std::vector<VectorXd> places = places_over(shape.place, survey, !stands);
  if (shape.is_strip()) {
    const std::vector<VectorXd> more = through_radios(survey);
    places.insert(places.end(), more.begin(), more.end());
  }
  if (!rooms.empty())  // elsewhere whole rooms
    std::erase_if(places, [&](const VectorXd& place) {
      return std::none_of(halls.begin(), halls.end(),
                          [&](const OrientedRectangle& hall) { return hall.holds(place[0], place[1]); });
    });
  std::vector<VectorXd> starts = start_grid(shape, places);
  starts.insert(starts.end(), rooms.begin(), rooms.end());
  return starts;
}

}  // namespace muster::diagnosis
