// What is measured in a field campaign: walls, radios, a law of levels, and the rows of its table.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace muster::exam::survey {

struct Point {
  double x = 0, y = 0, z = 0;  // m
};

inline double length(Point a, Point b) { return std::hypot(b.x - a.x, b.y - a.y, b.z - a.z); }

// A wall on the floor plan.
struct Panel {
  std::string name, material;
  Point from, to;
  double loss = 0;      // dB
  double height = 2.7;  // m
};

struct Radio {
  std::string name;
  Point at;
  double yaw = 0;  // rad
  bool moves = false;
};

// One reading, without its level.
struct Row {
  double t = 0;        // s, since the campaign began
  int tx = 0, rx = 0;  // indices of radios
  Point mobile;        // of the end that moves, if one does
  double yaw = 0;      // rad, of the end that moves
  int cell = 0;        // place x link: its readings share what is frozen there
  int power = 0;       // index of the nominal power
};

// The direct way of one reading.
struct Path {
  const Row& row;
  Point tx, rx;
  double tx_yaw = 0, rx_yaw = 0;  // rad
  double length = 0;              // m
};

// Law of a reading's error beside the mean.
struct Scatter {
  double shadowing = 0, decorrelation = 10;  // dB, m; exponential, over the place of the end that moves
  double frozen = 0;                         // dB, sd of place x link, which repeats do not average away
  double reading = 1.5;                      // dB, sd between repeats
  double freedom = 0;                        // of Student's t between repeats, of the same sd; 0: Gaussian
  double step = 0.1;                         // dB, of the receiver's codes
};

// Intermittent blockage of one link.
struct Passers {
  int radio = 0, other = 0;
  double loss = 0, share = 0, duration = 0;  // dB, of time, s
};

// The campaign as somebody believes it to be (the map), or as it is (the truth).
struct Scene {
  std::vector<Panel> panels;
  std::vector<Radio> radios;
  double power = 0;                                       // dBm
  double l0 = 40, n = 2;                                  // dB at 1 m, exponent
  double frequency = 2.44e9;                              // Hz
  std::vector<std::function<double(const Path&)>> terms;  // dB
  std::vector<std::function<double(double)>> receiver;    // reading of a level in dBm; NaN: none
  std::vector<Passers> passers;
  Scatter scatter;
};

// True if the way from a to b passes the panel, in height too. Ends that touch it do not count.
bool passes(const Panel& panel, Point a, Point b);

Path path_of(const Scene& scene, const Row& row);
// Mean level in dBm before the receiver.
double mean_level(const Scene& scene, const Row& row);

// Gain in dB of a wave reflected by level ground beside the direct one, antennas upright. `roughness` multiplies the
// reflected amplitude.
double two_ray_gain(double distance_on_ground, double height_a, double height_b, double frequency, double permittivity,
                    double roughness);

}  // namespace muster::exam::survey
