// Superframes of a beacon-enabled PAN (IEEE 802.15.4-2006, 7.5.1.1), as times. The first one begins at time 0, and
// beacons are due whether anybody sends them or not.
#pragma once

#include "standard.hpp"

namespace muster::lrwpan {

struct Superframe {
  Time interval = 0;  // from a beacon to the next; 0: there are no beacons
  Time active = 0;    // from a beacon to the end of its contention access period (CAP), which has no slots reserved
  Time cap = 0;       // from a beacon to the begin of its CAP, on a back-off boundary

  Superframe() = default;
  Superframe(int beacon_order, int superframe_order, bool extended)
      : interval(base_superframe << beacon_order),
        active(base_superframe << superframe_order),
        cap(boundary(air_time(beacon_frame(extended)))) {}

  bool exists() const { return interval > 0; }
  // Begin of the superframe that this moment lies in, and of its CAP; end of its CAP.
  Time begin(Time at) const { return at / interval * interval; }
  Time cap_begin(Time at) const { return begin(at) + cap; }
  Time cap_end(Time at) const { return begin(at) + active; }

  // First boundary of a back-off period from then on. They are aligned with the begin of each beacon.
  static Time boundary(Time at) { return (at + unit_backoff - 1) / unit_backoff * unit_backoff; }
  // The same within a CAP.
  Time boundary_in_cap(Time at) const {
    const Time next = boundary(at);
    if (next < cap_begin(next)) return cap_begin(next);
    return next < cap_end(next) ? next : begin(next) + interval + cap;
  }
  // Time that is left in the CAP; 0 outside of it.
  Time left(Time at) const { return at < cap_begin(at) ? 0 : std::max<Time>(0, cap_end(at) - at); }
};

}  // namespace muster::lrwpan
