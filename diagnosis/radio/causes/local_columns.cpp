#include "diagnosis/radio/causes/local_columns.hpp"

#include <algorithm>
#include <cmath>

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Columns = std::function<Eigen::MatrixXd(const VectorXd&)>;

constexpr double beyond_ends = 0.5;  // m: half a wall's widest edge, with loss beyond its ends
constexpr double moves = 0.75;  // m, to every side

struct Area {
  double west, south, east, north;

  bool holds(const Area& other) const {
    return west <= other.west && south <= other.south && other.east <= east && other.north <= north;
  }

  // True if a link enters or touches the area (separating axes).
  bool met_by(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    if (std::max(a.x(), b.x()) < west || std::min(a.x(), b.x()) > east) return false;
    if (std::max(a.y(), b.y()) < south || std::min(a.y(), b.y()) > north) return false;
    const auto side = [&](double x, double y) { return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x()); };
    const auto [least, most] =
        std::minmax({side(west, south), side(west, north), side(east, south), side(east, north)});
    return least <= 0 && most >= 0;
  }
};

Area about(const CauseShape& shape, const VectorXd& theta, double margin) {
  const auto p = shape.parameters(theta);
  const double reach =
      margin + (shape.place == PlaceShape::point ? std::exp(theta[1 + place_entries(shape.place)]) : 0);
  Area area{1e300, 1e300, -1e300, -1e300};
  for (std::size_t k = 0; k < shape.coordinates.size(); k += 2) {
    const double x = p.at(shape.coordinates[k]), y = p.at(shape.coordinates[k + 1]);
    area = {std::min(area.west, x - reach), std::min(area.south, y - reach), std::max(area.east, x + reach),
            std::max(area.north, y + reach)};
  }
  return area;
}

LinkReadings those(const LinkReadings& all, const std::vector<Index>& kept) {
  LinkReadings result;
  result.tx_at = all.tx_at(Eigen::all, kept);
  result.rx_at = all.rx_at(Eigen::all, kept);
  const auto take = [&](const auto& from, auto& to) {
    if (from.empty()) return;
    for (const Index k : kept) to.push_back(from[static_cast<std::size_t>(k)]);
  };
  take(all.tx, result.tx);
  take(all.rx, result.rx);
  take(all.t, result.t);
  take(all.rx_yaw, result.rx_yaw);
  take(all.tx_yaw, result.tx_yaw);
  return result;
}

// theta, and thetas shifted by `moves` to all four corners.
std::vector<VectorXd> corners(const VectorXd& theta) {
  std::vector<VectorXd> result{theta};
  for (const double x : {-moves, moves}) {
    for (const double y : {-moves, moves}) {
      result.push_back(theta);
      result.back().segment<2>(1) += Eigen::Vector2d(x, y);
    }
  }
  return result;
}

}  // namespace

Columns columns_near(const VectorXd& theta, const CauseCandidate& cause, const LinkReadings& readings,
                     const Simulate& simulate) {
  const Columns& all = cause.candidate.design.columns;
  const Area area = about(*cause.shape, theta, beyond_ends + moves);
  std::vector<Index> near;
  for (Index i = 0; i < readings.size(); ++i) {
    if (area.met_by(readings.tx_at.col(i), readings.rx_at.col(i))) near.push_back(i);
  }
  if (near.empty() || 2 * static_cast<Index>(near.size()) > readings.size()) return all;
  const std::shared_ptr<SimulatedReadings> simulated = simulate(those(readings, near));
  const Columns columns = simulated->at(cause).design.columns;
  Columns result = [=, shape = cause.shape, many = readings.size()](const VectorXd& t) -> Eigen::MatrixXd {
    (void)simulated;  // kept alive for `columns`
    if (!area.holds(about(*shape, t, beyond_ends))) return all(t);
    const Eigen::MatrixXd here = columns(t);
    Eigen::MatrixXd there = Eigen::MatrixXd::Zero(many, here.cols());
    there(near, Eigen::all) = here;
    return there;
  };
  for (const VectorXd& t : corners(theta)) {
    if (result(t) != all(t)) return all;
  }
  return result;
}

}  // namespace muster::diagnosis
