#include "diagnosis/radio/causes/local_columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Columns = std::function<Eigen::MatrixXd(const VectorXd&)>;

constexpr double beyond_ends = 0.5;  // m: half a wall's widest edge, with loss beyond its ends
constexpr double moves = 0.5;        // m, to every side
constexpr double strays = 0.01;      // share of thetas that are left out at each side

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

// What holds the places of nearly all thetas, and those beside them.
Area about(const CauseShape& shape, const std::vector<VectorXd>& thetas) {
  std::array<std::vector<double>, 4> sides;
  for (const VectorXd& theta : thetas) {
    const Area one = about(shape, theta, beyond_ends + moves);
    sides[0].push_back(-one.west);
    sides[1].push_back(-one.south);
    sides[2].push_back(one.east);
    sides[3].push_back(one.north);
  }
  const auto out = static_cast<std::size_t>(strays * static_cast<double>(thetas.size()));
  for (std::vector<double>& side : sides) std::sort(side.begin(), side.end(), std::greater<>());
  return {-sides[0][out], -sides[1][out], sides[2][out], sides[3][out]};
}

}  // namespace

Columns columns_near(const std::vector<VectorXd>& thetas, const CauseCandidate& cause, const LinkReadings& readings,
                     const Simulate& simulate) {
  constexpr std::size_t tried = 5;  // thetas
  const Columns& all = cause.candidate.design.columns;
  const Area area = about(*cause.shape, thetas);
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
  for (std::size_t k = 0; k < thetas.size(); k += thetas.size() / tried + 1) {
    if (result(thetas[k]) != all(thetas[k])) return all;
  }
  return result;
}

}  // namespace muster::diagnosis
