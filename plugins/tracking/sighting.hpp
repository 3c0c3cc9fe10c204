// What robots see of a target, and say of it.
#pragma once

namespace muster::tracking {

// A robot's last sighting: when, where, and how far off each coordinate is in the mean. Null before the first.
struct Sighting {
  static constexpr const char* columns = "t[s] x[m]? y[m]? deviation[m]?";
  double t, x, y, deviation;
};

// The bytes of a message about it.
struct Told {
  double x, y, deviation;
  char tag[8] = {'s', 'i', 'g', 'h', 't', 'i', 'n', 'g'};  // sets it apart from others of its size
};

}  // namespace muster::tracking
