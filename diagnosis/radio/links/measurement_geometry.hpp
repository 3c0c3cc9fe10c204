// Geometry of the measurements: times, places and radios of the readings, and directions of the plan's walls.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "diagnosis/data/dataset.hpp"
#include "diagnosis/data/recorded_time.hpp"
#include "diagnosis/data/span.hpp"
#include "diagnosis/radio/links/link_model.hpp"
#include "diagnosis/radio/links/room_detection.hpp"

namespace muster::diagnosis {

struct MeasurementGeometry {
  bool has_time = false, has_height = false;
  bool has_yaw = false;                         // of either end
  bool receivers_turn = false;                  // headings of the receiving ends differ
  bool has_places = true;                       // false: the data have only distances
  std::set<std::string> counted = {};           // materials whose walls the data count, in columns walls_NAME
  Span level;                                   // dBm, of all but the weakest and the strongest readings
  double sampling = 0;                          // s, between samples, as the longer gaps of the run have it; 0: no time
  RecordedTime time;                            // s
  Span east, north, height;                     // m
  Span distance;                                // m, from the tenth to the 85th percentile of links
  double above_moving = 0;                      // m: midway between the highest moving radio and the next radio above
  double plan_angle = 0;                        // rad, in [0, pi/2): mean direction of walls, modulo quarter turns
  std::vector<bool> turns, moves;               // one a radio
  std::vector<bool> both_ends;                  // one a radio: it sends in some readings and receives in others
  std::vector<std::array<double, 2>> standing;  // m, places of radios that do not move
  // Driven paths, x0 y0 x1 y1 of each piece, m; sorted by x0.
  std::vector<std::array<double, 4>> ways;
  std::vector<OrientedRectangle> strips;  // between parallel walls, possible corridors; the longest first
  std::vector<OrientedRectangle> rooms;   // with at least one in 50 readings of moving radios
  // By how much things are larger than in a building: one there, more where radios move over a mean extent of above 60
  // m.
  double scale = 1;

  bool is_outdoors() const { return scale > 1; }
  // Halls among the rooms, of which things may fill a corner.
  std::vector<OrientedRectangle> halls() const;
};

// MeasurementGeometry::scale alone.
double scale_of(const LinkModel& model);

MeasurementGeometry measurement_geometry(const LinkModel& model, const Dataset& data);

}  // namespace muster::diagnosis
