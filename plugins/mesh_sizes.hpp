// Meshes of a world that are far larger than what is around them, as a file in millimetres is that is read in metres.
#pragma once

#include <algorithm>
#include <cmath>
#include <muster/plugin.hpp>
#include <muster/printed.hpp>
#include <string>

namespace muster {

// The extent in plan of places that have an x and a y [m].
template <class Places>
double extent_of(const Places& places) {
  double low_x = 1e9, high_x = -1e9, low_y = 1e9, high_y = -1e9;
  for (const auto& at : places) {
    low_x = std::min(low_x, at.x), high_x = std::max(high_x, at.x);
    low_y = std::min(low_y, at.y), high_y = std::max(high_y, at.y);
  }
  return places.empty() ? 0 : std::hypot(high_x - low_x, high_y - low_y);
}

// Warns at the mesh where its longest edge [m] is far beyond `reach`, the extent of `what` ("radios"). One whose scale
// is given was looked at.
inline void warn_of_size(const Step& k, const std::string& mesh, double longest, double scale, double reach,
                         const char* what) {
  constexpr double far = 20, least = 5;  // times; [m]
  if (scale != 1 || longest <= far * std::max(reach, least)) return;
  k.warn("mesh/" + mesh, "mesh \"" + mesh + "\" is " + printed(longest) + " m long, and all " + what + " are within " +
                             printed(reach) + " m; is its file in millimetres? expected scale=\"0.001\"");
}

}  // namespace muster
