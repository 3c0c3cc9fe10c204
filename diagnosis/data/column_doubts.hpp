// Further columns of a table on which nothing can be said to depend: other measures of what was received, and counters.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace muster::diagnosis {

// True for a name of what a receiver tells of a received signal: snr, sinr, lqi, rsrp, rsrq and the like. A level
// depends on none of these: all of them depend on what the level depends on.
bool measures_reception(const std::string& name);
// True for those of them that tell by how much the signal is above the noise.
bool is_signal_to_noise(const std::string& name);

// True if a column that is called a number of packets, rows or the like counts them as time goes on, or one that is
// called a clock goes as time does, for each stream by itself: what depends on it depends on time. What only rises with
// time, such as the angle of a turntable, is neither. `t` [s] and `stream` of each value: its sender and its receiver,
// for several may hear one packet; NaN: empty.
bool goes_with_time(const std::string& name, const std::vector<double>& values, const std::vector<double>& t,
                    const std::vector<std::size_t>& stream);

}  // namespace muster::diagnosis
