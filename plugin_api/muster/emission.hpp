// What a radio radiates that is no message, as networks that share its band feel it.
#pragma once

namespace muster {

// A flat spectrum about a frequency, on for the first `duty` of each period, which begins at `phase`; a row of zeros is
// silent. Its power stands above that of the radio's messages, so the same links carry it. A bandwidth of 0 is a
// carrier alone.
struct Emission {
  static constexpr const char* columns = "excess[dB] frequency[Hz] bandwidth[Hz] period[s] duty phase[s]";
  double excess, frequency, bandwidth, period, duty, phase;
};

}  // namespace muster
