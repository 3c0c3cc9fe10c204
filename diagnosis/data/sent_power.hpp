// Readings of a radio that was set to several powers while it was measured: as received, or referred to one power.
#pragma once

#include <optional>
#include <vector>

namespace muster::diagnosis {

struct SentPower {
  double rise = 0;    // dB of level for each dB of power
  double middle = 0;  // dBm, of the powers that were set
};

// One of each reading: which link it is of, its distance [m], the power [dBm] that its sender was set to, and its level
// [dBm]. NaN: unknown.
struct PoweredReadings {
  std::vector<std::size_t> link;
  std::vector<double> distance, power, level;
};

// How levels rise with the power where they do so decibel by decibel, at equal distances on one link; nothing where
// they do not: they had been referred to a nominal power before, as docs/reference/table_format.md asks. A power that
// is the same in all readings of each link tells nothing.
std::optional<SentPower> followed_power(const PoweredReadings& readings);

}  // namespace muster::diagnosis
