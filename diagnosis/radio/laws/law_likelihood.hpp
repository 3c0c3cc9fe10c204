// How likely single readings are under a law of their scatter, over the fields that they may stand in.
#pragma once

#include <vector>

#include "diagnosis/radio/laws/kriging.hpp"
#include "diagnosis/radio/laws/reading_distribution.hpp"

namespace muster::diagnosis {

// The highest log-likelihood of a law: which shape the field has, and how large it is beside the law.
struct Peak {
  double value = -1e300;
  FieldShape shape;
  int place = 0;  // of ReadingField
};

// Of one reading, with its rounding; dB^2.
double variance_of(const ReadingLaw& law, double step);

class Judge {
 public:
  static constexpr int places = 200, distances = 300;  // from one try to the next

  Judge(ReadingField& field, double step) : field_(field), step_(step) {}

  // Over the field's size, from a start; between its tries by a parabola. A field that hardly is there, or little
  // beside it, is not sought further.
  Peak best(const ReadingLaw& law, Peak from);
  // Over size and decorrelation distance.
  Peak best_distance(const ReadingLaw& law, const Peak& from);
  // From there, the distance to a fiftieth.
  Peak closer_distance(const ReadingLaw& law, Peak from);
  // The best of each family, sought from a covariance; among many readings first by some of them, and further by all
  // only where these do not speak clearly against a family.
  std::vector<Peak> shapes(const ReadingLaw& law, const noise::Covariance& from);
  // At one place alone.
  double value(const ReadingLaw& law, const Peak& there);
  // The same, of readings evenly chosen where there are many; scaled to all.
  double about(const ReadingLaw& law, const Peak& there);

  ReadingField& field() { return field_; }
  double step() const { return step_; }

 private:
  std::vector<Peak> shapes_by_all(const ReadingLaw& law, const noise::Covariance& from);
  double at(const ReadingDensities& densities, double log_variance, const FieldShape& shape, int place,
            Eigen::Index every = 1);
  ReadingDensities densities_of(const ReadingLaw& law, double log_variance, const Peak& there, double margin);

  ReadingField& field_;
  double step_;
};

}  // namespace muster::diagnosis
