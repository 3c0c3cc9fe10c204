#include "diagnosis/planning/second_station.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/planning/standing_radios.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::Vector2d;

// The standing end that all rows share which the effect reaches. Nothing if there is none, or another one too.
std::optional<RowEnd> only_station(const RowSummary& seen, const Eigen::VectorXd& effect,
                                   const std::vector<StandingRadio>& radios) {
  std::optional<RowEnd> only;
  const double least = thresholds::reached * effect.cwiseAbs().maxCoeff();
  for (Index i = 0; i < effect.size(); ++i) {
    if (std::abs(effect[i]) < least) continue;
    const RowEnd tx = end_of(seen, i, true), rx = end_of(seen, i, false);
    const bool tx_stands = is_standing(radios, tx.radio, true);
    if (tx_stands == is_standing(radios, rx.radio, false)) return {};
    const RowEnd& station = tx_stands ? tx : rx;
    if (only && only->radio != station.radio) return {};
    only = station;
  }
  return only;
}

// The visited place from which the nearest and the farthest place of the range lie farthest apart in angle.
std::optional<Vector2d> best_view(const RowSummary& seen, const std::vector<StandingRadio>& radios,
                                  const Vector2d& nearest, const Vector2d& farthest) {
  std::optional<Vector2d> best;
  double widest = 0;
  const Vector2d along = farthest - nearest;
  for (Index i = 0; i < seen.tx_at.cols(); ++i) {
    for (const bool sends : {true, false}) {
      const RowEnd end = end_of(seen, i, sends);
      if (is_standing(radios, end.radio, sends)) continue;
      const Vector2d at = end.at.head<2>();
      const double share = std::clamp((at - nearest).dot(along) / along.squaredNorm(), 0.0, 1.0);
      if ((nearest + share * along - at).norm() < thresholds::second_station_apart) continue;
      const Vector2d a = (nearest - at).normalized(), b = (farthest - at).normalized();
      const double angle = std::acos(std::clamp(a.dot(b), -1.0, 1.0));
      if (angle > widest) widest = angle, best = at;
    }
  }
  return best;
}

}  // namespace

std::vector<Vector2d> places_of(const CauseShape& shape, const inference::Finding& finding) {
  std::vector<Vector2d> places;
  if (shape.place == PlaceShape::none || shape.is_room()) return places;
  if (!shape.cause.rows().empty()) return places;  // of what the map has, as a radio: nothing that casts a shadow
  for (const Eigen::VectorXd& theta : finding.thetas) places.emplace_back(theta[1], theta[2]);
  return places;
}

std::optional<OneStation> seen_from_one_station(const RowSummary& seen, const Eigen::VectorXd& effect,
                                                const std::vector<Vector2d>& places) {
  if (!seen.places_known || places.size() < 2 || effect.size() == 0 || !(effect.cwiseAbs().maxCoeff() > 0)) return {};
  const std::vector<StandingRadio> radios = standing_radios(seen);
  const std::optional<RowEnd> only = only_station(seen, effect, radios);
  if (!only) return {};
  const Vector2d station = only->at.head<2>();
  std::vector<double> distances;
  Vector2d towards(0, 0);
  for (const Vector2d& place : places) {
    distances.push_back((place - station).norm());
    towards += (place - station).normalized();
  }
  std::sort(distances.begin(), distances.end());
  const auto quantile = [&](double share) {
    return distances[static_cast<std::size_t>(share * static_cast<double>(distances.size() - 1))];
  };
  const double nearest = quantile(0.025), farthest = quantile(0.975);
  if (farthest < thresholds::distance_known * nearest || towards.norm() == 0) return {};
  towards.normalize();
  return OneStation{seen.radios[static_cast<std::size_t>(only->radio)], nearest, farthest,
                    best_view(seen, radios, station + nearest * towards, station + farthest * towards)};
}

}  // namespace muster::diagnosis
