// Power that a radio emits outside its messages, as interference to networks that share its band.
#pragma once

namespace muster {

// A flat spectrum about a frequency, on for the first `duty` of each period, which begins at `phase`; a row of zeros is
// silent. Its power is given relative to that of the radio's messages, so the same links carry it. A bandwidth of 0 is
// a carrier alone.
struct Emission {
  static constexpr const char* columns = "excess[dB] frequency[Hz] bandwidth[Hz] period[s] duty phase[s]";
  double excess, frequency, bandwidth, period, duty, phase;
};

}  // namespace muster
