#include "diagnosis/radio/links/moving_end.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace muster::diagnosis {
namespace {

using noise::Index;

// Farthest distance of each radio from its first place, and its climb.
class Ways {
 public:
  explicit Ways(const LinkReadings& r) {
    for (Index i = 0; i < r.size(); ++i) {
      add(r.tx[static_cast<std::size_t>(i)], r.tx_at.col(i));
      add(r.rx[static_cast<std::size_t>(i)], r.rx_at.col(i));
    }
  }

  double of(int radio) const { return seen_.at(radio).farthest; }
  double climb() const {
    double most = 0;
    for (const auto& [radio, way] : seen_) most = std::max(most, way.highest - way.lowest);
    return most;
  }

 private:
  struct Way {
    Eigen::Vector3d first;
    double farthest, lowest, highest;
  };

  void add(int radio, const Eigen::Vector3d& at) {
    Way& way = seen_.try_emplace(radio, Way{at, 0, at.z(), at.z()}).first->second;
    way.farthest = std::max(way.farthest, (at - way.first).norm());
    way.lowest = std::min(way.lowest, at.z());
    way.highest = std::max(way.highest, at.z());
  }

  std::map<int, Way> seen_;
};

}  // namespace

double MovingEnds::known_headings() const {
  return static_cast<double>(heading.array().isFinite().count()) /
         static_cast<double>(std::max<Index>(heading.size(), 1));
}

MovingEnds moving_ends(const LinkReadings& readings) {
  const Index n = readings.size();
  const Ways ways(readings);
  MovingEnds result{Eigen::MatrixXd(n, 2), Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n), ways.climb()};
  for (Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Eigen::Vector3d to_tx = readings.tx_at.col(i) - readings.rx_at.col(i);
    const double tx_way = ways.of(readings.tx[k]), rx_way = ways.of(readings.rx[k]);
    const bool sends = tx_way > rx_way || (tx_way == rx_way && readings.rx_yaw.empty() && !readings.tx_yaw.empty());
    result.place.row(i) = (sends ? readings.tx_at : readings.rx_at).col(i).head<2>().transpose();
    result.z[i] = (sends ? readings.tx_at : readings.rx_at)(2, i);
    const std::vector<double>& yaw = sends ? readings.tx_yaw : readings.rx_yaw;
    result.heading[i] = yaw.empty() ? std::nan("") : yaw[k];
    const double sign = sends ? -1 : 1;
    result.bearing[i] = std::atan2(sign * to_tx.y(), sign * to_tx.x()) - result.heading[i];
  }
  return result;
}

}  // namespace muster::diagnosis
