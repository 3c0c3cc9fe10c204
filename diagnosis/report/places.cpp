#include "diagnosis/report/places.hpp"

#include <cmath>
#include <map>

namespace muster::report {

namespace {

// True for radios with places more than half a metre apart.
std::vector<bool> moving(const diagnosis::RowSummary& rows) {
  std::vector<bool> moves(rows.radios.size(), false);
  std::map<int, Eigen::Vector3d> first;
  for (std::size_t k = 0; k < rows.tx.size(); ++k) {
    for (const auto& [radio, ends] : {std::pair{rows.tx[k], &rows.tx_at}, std::pair{rows.rx[k], &rows.rx_at}}) {
      const Eigen::Vector3d at = ends->col(static_cast<Eigen::Index>(k));
      if ((first.try_emplace(radio, at).first->second - at).norm() > 0.5) moves[static_cast<std::size_t>(radio)] = true;
    }
  }
  return moves;
}

}  // namespace

Places places_of(const diagnosis::RowSummary& rows) {
  Places out;
  const auto n = static_cast<Eigen::Index>(rows.tx.size());
  if (n == 0) return out;
  double tx_way = 0, rx_way = 0;
  for (Eigen::Index i = 1; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (rows.tx[k] != rows.tx[k - 1] || rows.rx[k] != rows.rx[k - 1]) continue;
    tx_way += (rows.tx_at.col(i) - rows.tx_at.col(i - 1)).norm();
    rx_way += (rows.rx_at.col(i) - rows.rx_at.col(i - 1)).norm();
  }
  const bool tx_stays = tx_way <= rx_way;
  out.place = tx_stays ? rows.rx_at : rows.tx_at;
  out.anchor = tx_stays ? rows.tx_at : rows.rx_at;
  out.radio = tx_stays ? rows.tx : rows.rx;
  // The reversed link has the same moving end.
  const std::vector<bool> moves = moving(rows);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const bool tx_moves = moves[static_cast<std::size_t>(rows.tx[k])],
               rx_moves = moves[static_cast<std::size_t>(rows.rx[k])];
    if (tx_moves == rx_moves || rx_moves == tx_stays) continue;
    out.place.col(i) = tx_moves ? rows.tx_at.col(i) : rows.rx_at.col(i);
    out.anchor.col(i) = tx_moves ? rows.rx_at.col(i) : rows.tx_at.col(i);
    out.radio[k] = tx_moves ? rows.rx[k] : rows.tx[k];
  }
  out.width = out.place.row(0).maxCoeff() - out.place.row(0).minCoeff();
  out.depth = out.place.row(1).maxCoeff() - out.place.row(1).minCoeff();
  return out;
}

std::vector<int> blocks_of(const Places& places, double side) {
  std::map<std::pair<long, long>, int> number;
  std::vector<int> out;
  for (Eigen::Index i = 0; i < places.place.cols(); ++i) {
    const std::pair cell{std::lround(std::floor(places.place(0, i) / side)),
                         std::lround(std::floor(places.place(1, i) / side))};
    out.push_back(number.try_emplace(cell, static_cast<int>(number.size())).first->second);
  }
  return out;
}

}  // namespace muster::report
