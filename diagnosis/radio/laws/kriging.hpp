// Kriging: predicts each reading from its neighbours. The error has the reading's own law, widened by the prediction
// variance.
#pragma once

#include <compare>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "diagnosis/inference/noise/fit.hpp"
#include "diagnosis/radio/links/link_rows.hpp"

namespace muster::diagnosis {

// Kriging errors at one ratio of a reading's variance to the field's, their only parameter.
struct ReadingView {
  double log_ratio = 0;        // of variances
  Eigen::VectorXd error;       // dB, a reading less its prediction
  Eigen::VectorXd spread;      // prediction variance of the level, for a field of variance 1
  Eigen::VectorXd log_spread;  // its logarithm
};

// A family of correlations with a decorrelation distance.
struct FieldShape {
  noise::Family family = noise::Family::exponential;
  int distance = 0;  // 1000 ln(distance [m])

  friend auto operator<=>(const FieldShape&, const FieldShape&) = default;
};

// The field about readings, and the weights by which it predicts each from its neighbours: whatever the readings are.
class Kriging {
 public:
  struct Weights {
    noise::Whitener whitener;
    Eigen::VectorXd spread, log_spread;  // as in ReadingView
  };

  explicit Kriging(noise::Field field) : field_(std::move(field)) {}
  Kriging(const Kriging&) = delete;  // whiteners refer to the field

  const noise::Field& field() const { return field_; }
  // `place`: 1000 log_ratio. Those that were asked for are kept up to 256 MB.
  std::shared_ptr<const Weights> weights(const FieldShape& shape, int place);

 private:
  noise::Field field_;
  std::map<std::pair<FieldShape, int>, std::shared_ptr<const Weights>> kept_;
};

// Nugget of the empirical variogram: half the squared differences of adjacent readings, regressed on distance, at
// distance zero. It estimates the variance of one reading for any field.
struct CloseReadings {
  Eigen::Index pairs = 0;
  double variance = 0, standard_error = 0;  // dB^2; 0 and infinite without enough distances or pairs
  Eigen::VectorXd apart{};                  // dB, by which readings of a pair differ
  std::vector<Eigen::Index> first{};        // of each pair
  Eigen::VectorXd beside{};                 // dB, mean residual of the nearest others: the field about each pair
};

// Where readings of a site share a part that is fixed there, laws are judged by the readings that repeat another one:
// the first has that part, whose own law is another.
class KrigedReadings {
 public:
  // One residual a reading; non-finite ones are left out. `fitted`: of the rows; with a fixed share, readings have one.
  // `time_unit`: as that of the model (ModelState::time_unit), s.
  KrigedReadings(const LinkReadings& readings, const Eigen::VectorXd& residual,
                 std::shared_ptr<const noise::StatedCorrelation> stated = nullptr,
                 noise::Family fitted = noise::Family::exponential, double time_unit = 0);
  // Without winsorising. An outlier then affects its neighbours' predictions. Without outliers the errors have known
  // variance, while winsorised ones vary less than under a law with rare deep fades.
  KrigedReadings untamed() const;
  // Other values of these readings, one each.
  KrigedReadings with(Eigen::VectorXd residual) const;
  // A subsample of about this many readings, in evenly chosen cells: whole neighbourhoods keep their prediction
  // errors.
  KrigedReadings some(Eigen::Index about) const;

  Eigen::Index size() const { return residual_.size(); }
  // Those by which a law is judged.
  const std::vector<Eigen::Index>& judged() const { return judged_; }
  // Standard deviations beyond which an error enters predictions winsorised; infinite: none does.
  double far_off() const { return far_off_; }
  // `place`: 1000 log_ratio. Computed once, then cached.
  const ReadingView& view(const FieldShape& shape, int place);
  const Eigen::VectorXd& residual() const { return residual_; }
  // Of the field; with a fixed share, the fitted one and those with the next shares.
  std::vector<noise::Family> families() const;
  // Uses each reading in at most one pair.
  CloseReadings close_readings() const;

 private:
  KrigedReadings(Eigen::VectorXd residual, std::shared_ptr<Kriging> kriging, noise::Family fitted, double far_off);
  Eigen::VectorXd error_by(const noise::Whitener& whitener) const;

  Eigen::VectorXd residual_;
  std::shared_ptr<Kriging> kriging_;
  noise::Family fitted_;
  std::vector<Eigen::Index> judged_;
  double far_off_;
  std::map<std::pair<FieldShape, int>, ReadingView> known_;
};

}  // namespace muster::diagnosis
