// A measuring campaign before anything is wrong with it, in one of the styles in which people measure.
#pragma once

#include "exam/field_survey/draws.hpp"
#include "exam/field_survey/scene.hpp"

namespace muster::exam::survey {

enum class Clock { seconds = 1, none, row_number, nanoseconds };  // of the column t

struct Campaign {
  std::string style;
  Scene scene;
  std::vector<Row> rows;
  std::vector<double> powers;     // dBm, nominal ones of a column power[dBm]; empty: no such column
  std::vector<char> in_world;     // by radio: whether the world file lists it
  bool heights = true;            // columns tx_z and rx_z
  bool headings = false;          // columns tx_yaw and rx_yaw
  bool both_ways = false;         // each link is measured in both directions
  bool states_frequency = false;  // in the world file
  bool states_scatter = true;     // the world has a radio.fading
  Clock clock = Clock::seconds;
  int left_out = -1;  // index of the panel that a missing wall would be
};

// 10 m x 9 m of rooms, 3,000 to 7,000 readings of 1 to 4 stations along a drive through all of them, Gaussian scatter
// and no shadowing. One panel of 3 m and 7 dB is marked as `left_out`.
Campaign flat(Draws& draws);
// Standing radios, all pairs both ways, once an hour.
Campaign mesh(Draws& draws);
// Repeats at chosen places of an office floor.
Campaign walk(Draws& draws);
// A drive in the open, 20 m to 20 km from one to four masts.
Campaign drive(Draws& draws);

inline double to_millimetre(double v) { return std::round(v * 1000) / 1000; }

}  // namespace muster::exam::survey
