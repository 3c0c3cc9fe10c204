// To which personal area network of IEEE 802.15.4 a radio belongs.
#pragma once

namespace muster {

// radio/*/pan: macPANId, from 0 to 0xFFFE. A row of zeros is of the PAN to which all belong that nobody names.
struct Pan {
  static constexpr const char* columns = "id";
  double id;
};

}  // namespace muster
