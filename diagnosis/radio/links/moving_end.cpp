#include "diagnosis/radio/links/moving_end.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace muster::diagnosis {
namespace {

using noise::Index;

// Farthest distance of each radio from its first place.
class Ways {
 public:
  explicit Ways(const LinkReadings& r) {
    for (Index i = 0; i < r.size(); ++i) {
      add(r.tx[static_cast<std::size_t>(i)], r.tx_at.col(i));
      add(r.rx[static_cast<std::size_t>(i)], r.rx_at.col(i));
    }
  }

  double of(int radio) const { return seen_.at(radio).farthest; }

 private:
  struct Way {
    Eigen::Vector3d first;
    double farthest;
  };

  void add(int radio, const Eigen::Vector3d& at) {
    Way& way = seen_.try_emplace(radio, Way{at, 0}).first->second;
    way.farthest = std::max(way.farthest, (at - way.first).norm());
  }

  std::map<int, Way> seen_;
};

}  // namespace

MovingEnds moving_ends(const LinkReadings& readings) {
  const Index n = readings.size();
  const Ways ways(readings);
  MovingEnds result{Eigen::MatrixXd(n, 2), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Eigen::Vector3d to_tx = readings.tx_at.col(i) - readings.rx_at.col(i);
    const bool sends = ways.of(readings.tx[k]) > ways.of(readings.rx[k]);
    result.place.row(i) = (sends ? readings.tx_at : readings.rx_at).col(i).head<2>().transpose();
    const std::vector<double>& yaw = sends ? readings.tx_yaw : readings.rx_yaw;
    result.heading[i] = yaw.empty() ? std::nan("") : yaw[k];
    const double sign = sends ? -1 : 1;
    result.bearing[i] = std::atan2(sign * to_tx.y(), sign * to_tx.x()) - result.heading[i];
  }
  return result;
}

}  // namespace muster::diagnosis
