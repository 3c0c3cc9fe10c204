// What a search for causes must know of the measurements: when, where and by whom they were taken, and which way the
// walls of the plan run.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "diagnosis/data/dataset.hpp"
#include "diagnosis/data/span.hpp"
#include "diagnosis/radio/links/link_model.hpp"
#include "diagnosis/radio/links/room_detection.hpp"

namespace muster::diagnosis {

struct MeasurementGeometry {
  bool has_time = false, has_yaw = false, has_height = false;
  bool has_places = true;                       // false: the data have distances alone
  std::set<std::string> counted = {};           // materials whose walls the data count, in columns walls_NAME
  Span time, east, north, height;               // s, m
  Span distance;                                // m, from the tenth to the 85th percentile of links
  double above_moving = 0;                      // m: halfway from the highest place of radios that move to the next one
  double plan_angle = 0;                        // rad, in [0, pi/2): most of the walls run along it or across it
  std::vector<bool> turns, moves;               // a radio
  std::vector<std::array<double, 2>> standing;  // m, places of radios that do not move
  // Ways of radios that move, x0 y0 x1 y1 of each piece, in m; by their x0.
  std::vector<std::array<double, 4>> ways;
  std::vector<OrientedRectangle>
      strips;  // between walls that run side by side and could be corridors, the longest first
  std::vector<OrientedRectangle> rooms;  // in which moving radios took some of the readings
};

MeasurementGeometry measurement_geometry(const LinkModel& model, const Dataset& data);

}  // namespace muster::diagnosis
