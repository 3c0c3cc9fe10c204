// Draws censored readings from their distribution given all others: the Gibbs sampler of a truncated normal (Geweke
// 1991), whose draws the noise and the mean are refitted to in turn (stochastic EM: Celeux and Diebolt 1985). Their
// expectations instead would scatter less than readings do, and the less the more of them are censored: what is found
// in such noise is too sure.
#pragma once

#include "diagnosis/inference/noise/censored.hpp"
#include "diagnosis/inference/noise/rows.hpp"
#include "diagnosis/inference/noise/whitener_columns.hpp"

namespace muster::noise {

// The standard normal variable that this share of all beyond `end` lies above.
double normal_above(double end, double share);

class CensoredDraws {
 public:
  // `readings`: with the bound where one is censored; all outlive this.
  CensoredDraws(const Eigen::VectorXd& readings, const Bounds& bounds, const Rows& rows, const Field& field,
                const Whitener& whitener);

  // Draws each censored reading once, given the others and the mean [one a reading]. The same number draws the same.
  void sweep(uint64_t number, const Eigen::VectorXd& mean, Eigen::VectorXd& filled) const;

 private:
  double variance_of(Index row) const;  // of its readings about its mean

  const Eigen::VectorXd& readings_;
  const Bounds& bounds_;
  const Rows& rows_;
  const Field& field_;
  const Whitener& whitener_;
  Reach reach_;
};

}  // namespace muster::noise
