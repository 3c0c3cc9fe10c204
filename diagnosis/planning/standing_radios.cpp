#include "diagnosis/planning/standing_radios.hpp"

#include <algorithm>
#include <map>

#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {

using Eigen::Index;

RowEnd end_of(const RowSummary& seen, Index row, bool sends) {
  const auto k = static_cast<std::size_t>(row);
  const Eigen::VectorXd& yaw = sends ? seen.tx_yaw : seen.rx_yaw;
  return {sends ? seen.tx[k] : seen.rx[k], (sends ? seen.tx_at : seen.rx_at).col(row), yaw.size() > 0,
          yaw.size() > 0 ? yaw[row] : 0};
}

std::vector<StandingRadio> standing_radios(const RowSummary& seen) {
  std::map<std::pair<int, bool>, std::pair<StandingRadio, bool>> known;
  for (Index i = 0; i < seen.tx_at.cols(); ++i) {
    for (const bool sends : {true, false}) {
      const RowEnd end = end_of(seen, i, sends);
      auto& [first, stays] = known.try_emplace({end.radio, sends}, StandingRadio{end, sends}, true).first->second;
      stays = stays && (first.end.at - end.at).norm() < thresholds::stands_within;
    }
  }
  std::vector<StandingRadio> out;
  for (const auto& [key, value] : known) {
    if (value.second) out.push_back(value.first);
  }
  return out;
}

bool is_standing(const std::vector<StandingRadio>& radios, int radio, bool sends) {
  return std::any_of(radios.begin(), radios.end(),
                     [&](const StandingRadio& s) { return s.end.radio == radio && s.sends == sends; });
}

}  // namespace muster::diagnosis
