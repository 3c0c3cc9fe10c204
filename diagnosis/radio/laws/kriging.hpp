// Single readings against the field of their places: each is predicted from readings near it, so that what is left
// is the reading's own law widened by what the prediction does not know.
#pragma once

#include <compare>
#include <map>
#include <utility>

#include "diagnosis/inference/noise/fit.hpp"
#include "diagnosis/radio/links/link_rows.hpp"

namespace muster::diagnosis {

// Errors of prediction at one ratio of a reading's variance to the field's; they depend on nothing else.
struct ReadingView {
  double log_ratio = 0;        // of variances
  Eigen::VectorXd error;       // dB, a reading less its prediction
  Eigen::VectorXd log_spread;  // log variance of the level beside its prediction, for a field of variance 1
};

// A family of correlations with a decorrelation distance.
struct FieldShape {
  noise::Family family = noise::Family::exponential;
  int distance = 0;  // a thousand times its logarithm [m]

  friend auto operator<=>(const FieldShape&, const FieldShape&) = default;
};

// Half the squared differences of readings side by side, a line over their distance, where it meets distance zero: the
// variance of one reading, whatever the field is.
struct CloseReadings {
  Eigen::Index pairs = 0;
  double variance = 0, standard_error = 0;  // dB^2; without enough distances or pairs 0 and infinite
};

class KrigedReadings {
 public:
  // A residual a reading; those that are not finite are left out.
  KrigedReadings(const LinkReadings& readings, const Eigen::VectorXd& residual);
  // With every reading telling its neighbours all that it is off by. An outlier then spoils them; but where there are
  // none, this is the sum of errors whose variance is known, while tamed ones vary less than a law with rare deep fades
  // says.
  KrigedReadings untamed() const;
  // The readings of evenly chosen places, about so many: whole neighbourhoods, so that they tell each other what they
  // tell each other among all.
  KrigedReadings some(Eigen::Index about) const;

  Eigen::Index size() const { return residual_.size(); }
  // `place`: a thousand times log_ratio. Worked out once.
  const ReadingView& view(const FieldShape& shape, int place);
  const Eigen::VectorXd& residual() const { return residual_; }
  // Each reading in one pair at most.
  CloseReadings close_readings() const;

 private:
  KrigedReadings(Eigen::VectorXd residual, noise::Field field, double far_off);
  Eigen::VectorXd error_by(const noise::Whitener& whitener) const;

  Eigen::VectorXd residual_;
  noise::Field field_;
  double far_off_ = 4;  // standard deviations; what is further off tells its neighbours no more than that
  std::map<std::pair<FieldShape, int>, ReadingView> known_;
};

}  // namespace muster::diagnosis
