// Generic smooths: functions along a column, an angle, a factor, a plane, and products of them. They find structure
// that no named cause explains, whatever its origin.
#pragma once

#include <string_view>

#include "diagnosis/inference/state/candidate.hpp"

namespace muster::inference {

// A column of the data outside the model.
struct Covariate {
  std::string name;
  Eigen::VectorXd values;  // one a reading, none empty
  bool angle = false;      // rad
  int functions = 5;       // of the first smooth
  bool products = true;    // also as products with a domain's own columns
};

struct Factor {
  std::string name;
  std::vector<int> level;  // one a reading, from 0
};

// True for time, products with it, and time by itself at each level of a factor; not for a column such as "uptime".
bool is_time(std::string_view covariate);

// Cosines over the range of x, a half-wave each; one row a value.
Eigen::MatrixXd cosines(const Eigen::VectorXd& x, int functions);
// Cosine and sine of each harmonic of an angle [rad].
// Of an angle [rad]; zero where it is NaN, unknown.
Eigen::MatrixXd harmonics_of(const Eigen::VectorXd& angle, int harmonics);

// Cosines of a covariate over its range; may grow.
Candidate smooth_of(const std::string& name, const Eigen::VectorXd& values, int functions);
// Harmonics of an angle [rad]; may grow.
Candidate smooth_of_angle(const std::string& name, const Eigen::VectorXd& angle, int harmonics);
// The same functions, for one level of a factor at a time.
Candidate smooth_by_level(const std::string& name, const std::vector<int>& level, const Eigen::MatrixXd& functions);
// A constant for one level of a factor at a time.
Candidate factor(const std::string& name, const std::vector<int>& level);
// Hinge functions, flat on one side of a bend and linear on the other (Friedman 1991): one function where a smooth
// needs five.
Candidate bend(const std::string& name, const Eigen::VectorXd& values);
// Oscillation whose frequency changes linearly over the data. Theta: number of cycles, and how many more of them the
// second half has.
Candidate chirp(const std::string& name, const Eigen::VectorXd& time);

// Products of low order of two columns, "name*other".
Candidate product_of(const std::string& name, const Eigen::VectorXd& values, const std::string& other,
                     const Eigen::VectorXd& along);
// Products of low order of a column and the two coordinates of a plane (one row a reading), "name*plane".
Candidate product_over(const std::string& name, const Eigen::VectorXd& values, const std::string& plane,
                       const Eigen::MatrixXd& place);
// Products of cosines over a plane.
Candidate smooth_over(const std::string& plane, const Eigen::MatrixXd& place);
// The lowest two-dimensional terms. A field can absorb what bends at most once over the plane, and a test of few
// functions has more power.
Candidate slope_over(const std::string& plane, const Eigen::MatrixXd& place);

}  // namespace muster::inference
