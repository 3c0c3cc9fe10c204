// Membership of a radio in a personal area network of IEEE 802.15.4.
#pragma once

namespace muster {

// radio/*/pan: macPANId, from 0 to 0xFFFE. A row of zeros is the default PAN.
struct Pan {
  static constexpr const char* columns = "id";
  double id;
};

}  // namespace muster
