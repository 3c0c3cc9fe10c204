// How readings scatter about the level of their place, and whether the world's law of it holds: fading of another
// strength, hopping channels, outliers, each by a likelihood ratio against the stated law.
#pragma once

#include <string>

#include "diagnosis/reading_law.hpp"
#include "diagnosis/search/bench.hpp"

namespace muster::diagnosis {

// Readings of one row share the level of their place, known from the rows around it: normal about `level`.
struct ScatterRow {
  double level = 0, variance = 0;  // dB, dB^2
  std::vector<double> readings;    // dB, measured less the mean
};

struct Scatter {
  std::vector<ScatterRow> rows;
  double within = 0;  // dB^2: what the field itself varies within a row
  double step = 1;    // dB between codes

  double log_likelihood(const ReadingLaw& law, double within_share) const;
};

// `residual` is one a reading, NaN where only a bound is known; at most 3000 rows, evenly chosen.
Scatter scatter_of(const search::Bench& bench, const Eigen::VectorXd& residual, double step);

struct LawValue {
  std::string name;
  double value, lower95, upper95;
};

// One law against the stated one.
struct LawTest {
  std::string cause;  // "effect.outliers"
  std::vector<LawValue> values;
  double gain = 0;      // twice the log-likelihood ratio
  double evidence = 0;  // nats
  double log_p = 0;
};

// By falling evidence. That a reading may be the mean of several fades of the same spread as stated is part of the
// null: receivers average, and the mean of a few fades has another shape.
std::vector<LawTest> law_tests(const Scatter& scatter, const ReadingLaw& stated);

}  // namespace muster::diagnosis
