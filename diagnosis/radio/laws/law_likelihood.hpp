// Log-likelihood of single readings under a fading law, maximised over the shadowing covariance.
#pragma once

#include <map>
#include <vector>

#include "diagnosis/radio/laws/kriging.hpp"
#include "diagnosis/radio/laws/reading_distribution.hpp"

namespace muster::diagnosis {

// Maximum of a law's log-likelihood over the field's shape and its size relative to the law.
struct Peak {
  double value = -1e300;
  FieldShape shape;
  int place = 0;  // of KrigedReadings
};

class LawLikelihood {
 public:
  static constexpr int places = 200, distances = 300;  // grid steps

  LawLikelihood(KrigedReadings& field, double step) : field_(field), step_(step) {}

  // Maximises over the field's size, from a start; by a parabola between grid points. Stops at a negligible field or
  // a negligible law.
  Peak best(const ReadingDistribution& law, Peak from);
  // Maximises over size and decorrelation distance.
  Peak best_distance(const ReadingDistribution& law, const Peak& from);
  // The same to a fortieth of the distance, from a start near it: by a parabola between grid points.
  Peak closer_distance(const ReadingDistribution& law, const Peak& from);
  // The maximum of each family, from a covariance. Many readings: first on a subsample, then on all for families that
  // remain possible.
  std::vector<Peak> shapes(const ReadingDistribution& law, const noise::Covariance& from);
  // At one grid point.
  double value(const ReadingDistribution& law, const Peak& there);
  // The terms of that, one a reading; 0 of readings by which no law is judged.
  Eigen::VectorXd each(const ReadingDistribution& law, const Peak& there);
  // The same on an even subsample, if there are many readings; scaled to all.
  double about(const ReadingDistribution& law, const Peak& there);

  // Of a reading as predictions use it, dB^2: what adds heavy tails enters them winsorised.
  double log_variance_of(ReadingDistribution law) const;

  KrigedReadings& field() { return field_; }
  double step() const { return step_; }
  std::vector<noise::Family> families() const { return field_.families(); }

 private:
  std::vector<Peak> shapes_by_all(const ReadingDistribution& law, const noise::Covariance& from);
  double at(const ReadingDensities& densities, double log_variance, const FieldShape& shape, int place,
            Eigen::Index every = 1);
  const ReadingDensities& densities_of(const ReadingDistribution& law, double log_variance, const Peak& there);

  KrigedReadings& field_;
  double step_;
  std::map<ReadingDistribution, ReadingDensities> known_;  // laws that were asked for, until they are too many
};

}  // namespace muster::diagnosis
