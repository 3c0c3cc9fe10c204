// A place in the scene.
#pragma once

namespace muster::scene {

// In metres, east, north and up. Coordinates of radios are at most 100 km in size, those of walls and floors below 1
// km.
struct Point {
  double x = 0, y = 0, z = 0;
};

}  // namespace muster::scene
