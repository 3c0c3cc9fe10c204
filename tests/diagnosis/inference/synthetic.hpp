// Synthetic worlds for tests of the engine: robots wander among walls and receive transmitters through a random
// field. All formulas are this file's own; the engine gets readings, a base design and candidates only.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "diagnosis/radio/links/link_rows.hpp"

namespace muster::synthetic {

using Eigen::Index;
using Segment = std::array<double, 4>;  // x0, y0, x1, y1 in m

enum class Shape { exponential = 1, gaussian, two_scale };

struct Recipe {
  uint64_t seed = 1;
  Index readings = 4000;
  int transmitters = 4, robots = 2;
  double width = 24, height = 16;                        // m
  double sigma = 4, decorrelation = 1.8, shared = 0.15;  // dB, m
  double fading = 2.5;                                   // dB, of one reading
  Shape shape = Shape::exponential;
};

struct World {
  Recipe recipe;
  diagnosis::LinkReadings readings;
  Eigen::VectorXd rssi;  // dBm, without a hidden effect
  Eigen::MatrixXd base;  // 1, -10 log10 d, -walls crossed
  Eigen::VectorXd time, speed, battery, temperature;
  std::vector<Segment> walls;
  Eigen::VectorXd true_theta;  // as noise::Theta

  Eigen::VectorXd distance() const;
  Eigen::VectorXd bearing() const;  // of the transmitter, relative to the robot's heading, rad
};

World world_of(const Recipe& recipe);

// Recipes that differ in size, field, noise and number of transmitters.
Recipe varied(uint64_t seed, Index readings);

// 1 where the straight line of a reading crosses the segment.
Eigen::VectorXd crossings(const diagnosis::LinkReadings& readings, const Segment& segment);
bool crosses(double px, double py, double qx, double qy, const Segment& s);

// Scales the column to a whitened energy of lambda beside the base design, under the true covariance.
Eigen::VectorXd scaled_to(const World& world, const Eigen::VectorXd& column, double lambda);

}  // namespace muster::synthetic
