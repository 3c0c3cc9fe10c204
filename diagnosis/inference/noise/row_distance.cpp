#include "diagnosis/inference/noise/row_distance.hpp"

#include <map>

namespace muster::noise {

bool anchors_move(const Sites& sites) {
  std::map<int, Index> first;  // of each group
  for (Index i = 0; i < sites.size(); ++i) {
    const Index other = first.try_emplace(sites.group[static_cast<std::size_t>(i)], i).first->second;
    if (sites.anchor.col(i) != sites.anchor.col(other) || !sites.anchor_stretch.col(i).isZero(0)) return true;
  }
  return false;
}

SiteFloats floats_of(const Sites& sites) {
  SiteFloats result(sites.size(), 14);
  if (sites.size() == 0) return result;
  const auto about_first = [](const Eigen::Matrix3Xd& at) {
    return (at.colwise() - at.col(0)).transpose().cast<float>().eval();
  };
  result << about_first(sites.place), about_first(sites.anchor), sites.place_stretch.transpose().cast<float>(),
      sites.anchor_stretch.transpose().cast<float>(), Eigen::MatrixX2f::Zero(sites.size(), 2);
  const auto own = static_cast<float>(own_share);
  result.col(12) = own * result.middleCols<3>(6).rowwise().norm();
  result.col(13) = own * result.middleCols<6>(6).rowwise().norm();
  return result;
}

Places PlacedSites::places(bool by_readings, bool anchors_move, float far) const {
  const auto axis = [&](Index k) { return values_.col(k).data(); };
  const auto ends = [&](Index middle, Index stretch) {
    return Ends{{axis(middle), axis(middle + 1), axis(middle + 2)},
                {axis(stretch), axis(stretch + 1), axis(stretch + 2)}};
  };
  return {ends(0, 6), ends(3, 9),  by_readings ? axis(12) : nullptr, by_readings ? axis(13) : nullptr,
          far,        anchors_move};
}

}  // namespace muster::noise
