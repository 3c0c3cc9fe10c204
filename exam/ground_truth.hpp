// Ground truth of a case: plan, base model, noise; and the readings taken there.
#pragma once

#include <Eigen/Core>

#include "exam/crossings.hpp"
#include "exam/trajectory.hpp"

namespace muster::exam {

enum class Family { exponential = 1, gaussian, two_scale };

// Shadowing over the robots' places: one field for each station, and one shared by all.
struct FieldLaw {
  Family family = Family::exponential;
  double sigma = 4;          // dB
  double decorrelation = 2;  // m
  double shared = 0.2;       // share of the variance common to all stations
};

// Law of single readings.
struct ReadingLaw {
  double rician_k = 6;           // dB
  int averaged = 1;              // number of independent fades averaged in a reading
  double outliers = 0;           // share, uniform within +-20 dB
  std::vector<double> channels;  // dB, levels of hopping channels; empty: a single channel
};

struct Noise {
  FieldLaw field;
  ReadingLaw reading;
  double lost = 0;  // share of readings lost at random
};

struct Base {
  double level_at_1m = -30;  // dBm, true
  double n = 2;
  double tx_power = 10;                 // dBm, in the world file
  double stated_l0 = 40, stated_n = 2;  // in the world file: start of a fit
};

struct GroundTruth {
  Plan plan;
  Base base;
  Noise noise;
  FieldLaw stated_field;  // in the world file; the truth unless the case's effect changes it
  ReadingLaw stated_reading;
  int robots = 1;
  bool two_way = false;       // stations receive from robots too
  bool has_power = false;     // a column power[dBm]
  bool has_firmware = false;  // a column firmware
  bool has_noise = false;     // a column noise[dBm]
  double noise_swing = 0;     // dB, of that column
  int ticks = 0;
  double period = 0.3;  // s
  double duration() const { return ticks * period; }
};

struct Reading {
  double t = 0;  // s
  int station = 0, robot = 0;
  bool up = false;  // the robot sends
  Vec3 at;          // of the robot's antenna
  double yaw = 0, speed = 0, battery = 0, temperature = 0;
  int power = 0;     // index into `power_levels`
  int firmware = 0;  // index into `firmware_names`
  double noise = 0;  // at the receiver, in swings above the quiet floor
};

inline constexpr std::array<double, 4> power_levels{-12, -6, 0, 4};  // dBm, nominal
inline constexpr std::array<const char*, 3> firmware_names{"v1.2", "v1.4", "v2.0"};

// Readings of one run with the crossings of their links, and the base model's columns: 1, -10 log10 d, -walls by
// material.
struct Data {
  std::vector<Reading> readings;
  std::vector<std::vector<Crossing>> crossings;
  Eigen::MatrixXd design;
  Eigen::VectorXd rssi;  // dBm; NaN: not received

  std::size_t size() const { return readings.size(); }
};

Vec3 place_of(const GroundTruth& site, const Reading& r);
double distance_of(Vec3 a, Vec3 b);
// Bearing of the station from the robot, relative to its heading; and of the robot from the station, relative to the
// station's.
double robot_bearing(const GroundTruth& site, const Reading& r);
double station_bearing(const GroundTruth& site, const Reading& r);

// Readings with their links' crossings and their design matrix.
Data data_of(const GroundTruth& site, std::vector<Reading> readings);
// One row of the design matrix, for radios at other places than on the map.
Eigen::RowVectorXd design_row(const GroundTruth& site, const std::vector<Crossing>& crossed, Vec3 a, Vec3 b);
Eigen::VectorXd coefficients(const GroundTruth& site);

struct SiteNeeds {
  PlanNeeds plan;
  bool two_robots = false, two_way = false, power = false, firmware = false, noise = false;
  bool single_fades = false;  // readings of a single fade
};

// `walls`: the plan, as a table; empty: one is drawn.
GroundTruth draw_site(std::uint64_t seed, const SiteNeeds& needs, int rows, const std::string& walls = {});
// Draws a run over the site, a different one for each `name`.
Data draw_data(const GroundTruth& site, std::uint64_t seed, const std::string& name);

}  // namespace muster::exam
