// True covariance of readings that the simulator draws: line integrals of an exponential loss field (Agrawal and
// Patwari 2009), fading of a pair of places, and rounding.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "exam/ground_truth.hpp"

namespace muster::exam::simulated {

struct Link {
  Vec3 a, b;
};

struct LinkLaw {
  double shadowing = 0, decorrelation = 1;  // dB, m
  double fading = 0;                        // dB, sd of a pair of places
  double step = 1;                          // dB, of the receiver's codes
};

// Covariance of the shadowing of two links in dB^2, by the midpoint rule on both: shadowing^2 / 2 D / sqrt(length a x
// length b) x the double integral of exp(-distance / D). The same rule on all pairs keeps a matrix of them positive.
double shadowing_covariance(const Link& one, const Link& other, double shadowing, double decorrelation);

// Three levels, each exact given the one above: a cell (links of one station to places within a grid) has the field's
// covariance with other cells; the readings of a spot (the same pair of places at one time) share its fading; readings
// have a rounding error each. What the field changes within a cell counts as independent between its spots.
class LinkCovariance {
 public:
  LinkCovariance(const GroundTruth& site, const Data& data, const LinkLaw& law, const std::vector<char>& used);

  // Columns over all readings; of unit covariance afterwards.
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& columns) const;
  // 2 x the Kullback-Leibler divergence of `truth` from this law, of the cells' means.
  double field_divergence(const LinkLaw& truth) const;
  int spots() const { return static_cast<int>(spot_variance_.size()); }

 private:
  Eigen::MatrixXd of_cells(const LinkLaw& law) const;

  LinkLaw law_;
  std::vector<int> spot_of_, cell_of_;  // by reading, -1: not used; by spot
  std::vector<int> spot_count_;
  std::vector<double> spot_variance_, cell_weight_;  // dB^2; its inverse, summed
  std::vector<Link> cells_;
  Eigen::MatrixXd root_;
};

}  // namespace muster::exam::simulated
