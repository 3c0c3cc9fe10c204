// The way of the robot: through every room in rows along x, then once more in rows along y, so that each place is seen
// at two times.
#pragma once

#include <cmath>
#include <vector>

struct Place {
  double x = 0, y = 0;  // m
};

struct Step {
  Place at;
  double heading = 0;  // rad, from east to north
};

struct Room {
  double x0, y0, x1, y1;  // m
  double door;            // x of the middle of its door to the corridor; the corridor itself has none
};

inline const std::vector<Room>& rooms() {
  static const std::vector<Room> all{{-14, -1.2, 22, 1.2, 0},  // corridor
                                     {-14, 1.2, -8, 8, -9.5},  {-8, 1.2, -3, 8, -4},      {-3, 1.2, 2, 8, -1.5},
                                     {2, 1.2, 8, 8, 6.8},      {8, 1.2, 15, 8, 12},       {15, 1.2, 22, 8, 17},
                                     {11, -7.5, 22, -1.2, 19}, {4, -7.5, 11, -1.2, 9.5},  {-2, -7.5, 4, -1.2, -0.5},
                                     {-9, -7.5, -2, -1.2, -6}, {-14, -7.5, -9, -1.2, -11}};
  return all;
}

// Corners of a sweep over a room that keeps 0.6 m from its walls.
inline void sweep(const Room& room, bool along_x, double spacing, std::vector<Place>& way) {
  const double margin = 0.6;
  const double x0 = std::fmin(room.x0, room.x1) + margin, x1 = std::fmax(room.x0, room.x1) - margin;
  const double y0 = room.y0 + margin, y1 = room.y1 - margin;
  const double from = along_x ? y0 : x0, to = along_x ? y1 : x1;
  const int rows = 1 + static_cast<int>((to - from) / spacing);
  for (int i = 0; i < rows; ++i) {
    const double at = from + (to - from) * i / std::fmax(rows - 1, 1);
    const bool back = i % 2 == 1;
    if (along_x) {
      way.push_back({back ? x1 : x0, at});
      way.push_back({back ? x0 : x1, at});
    } else {
      way.push_back({at, back ? y1 : y0});
      way.push_back({at, back ? y0 : y1});
    }
  }
}

inline std::vector<Place> corners() {
  std::vector<Place> way;
  for (const bool along_x : {true, false}) {
    for (const Room& room : rooms()) {
      const bool corridor = room.y0 == -1.2 && room.y1 == 1.2;
      const double inside = room.y0 > 0 ? room.y0 + 0.6 : room.y1 - 0.6;  // just behind the door
      if (!corridor) way.insert(way.end(), {{room.door, 0}, {room.door, inside}});
      sweep(room, along_x, 0.65, way);
      if (!corridor) way.insert(way.end(), {{room.door, inside}, {room.door, 0}});
    }
  }
  return way;
}

// `count` places evenly along the way.
inline std::vector<Step> tour_of_rooms(int count) {
  const std::vector<Place> way = corners();
  double length = 0;
  for (std::size_t i = 1; i < way.size(); ++i) length += std::hypot(way[i].x - way[i - 1].x, way[i].y - way[i - 1].y);
  std::vector<Step> tour;
  double passed = 0;  // length of the legs behind
  for (std::size_t i = 1; i < way.size(); ++i) {
    const double dx = way[i].x - way[i - 1].x, dy = way[i].y - way[i - 1].y, leg = std::hypot(dx, dy);
    while (static_cast<int>(tour.size()) < count) {
      const double into = length * static_cast<double>(tour.size()) / count - passed;
      if (into >= leg) break;
      tour.push_back({{way[i - 1].x + dx * into / leg, way[i - 1].y + dy * into / leg}, std::atan2(dy, dx)});
    }
    passed += leg;
  }
  while (static_cast<int>(tour.size()) < count) tour.push_back(tour.back());
  return tour;
}
