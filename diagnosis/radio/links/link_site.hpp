// Site of a reading: which way of which link it is, and where both ends are, within 2 cm.
#pragma once

#include <array>
#include <cmath>

#include "diagnosis/inference/thresholds.hpp"
#include "diagnosis/radio/links/link_rows.hpp"

namespace muster::diagnosis {

using LinkSite = std::array<long, 8>;  // the transmitter's radio, the receiver's, and their places

inline LinkSite site_of(const LinkReadings& readings, noise::Index reading) {
  const auto k = static_cast<std::size_t>(reading);
  LinkSite site{readings.tx[k], readings.rx[k]};
  std::size_t entry = 2;
  for (const Eigen::Matrix3Xd* places : {&readings.tx_at, &readings.rx_at}) {
    for (noise::Index axis = 0; axis < 3; ++axis)
      site[entry++] = std::lround((*places)(axis, reading) / inference::thresholds::same_site);
  }
  return site;
}

}  // namespace muster::diagnosis
