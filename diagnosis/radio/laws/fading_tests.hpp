// Tests the world's law of readings against each law that a plugin declares, such as another strength of fading,
// hopping channels or outliers. Each by a likelihood ratio against the stated law.
#pragma once

#include <string>

#include "diagnosis/radio/laws/kriging.hpp"
#include "diagnosis/radio/laws/law_families.hpp"

namespace muster::diagnosis {

// Likelihood-ratio test of one law against the stated one.
struct LawTest {
  std::string cause;  // "effect.outliers"
  std::vector<LawValue> values;
  double gain = 0;      // twice the log-likelihood ratio
  double evidence = 0;  // nats
  double log_p = 0;
  ReadingDistribution law{};  // fitted
  Eigen::VectorXd won{};      // nats, of each reading that was tested, in their order; of the likeliest law only
};

struct LawTests {
  std::vector<LawTest> tests;  // by falling evidence; only the first has values
  ReadingDistribution stated;  // with the likeliest number of fades in one reading
};

// `step`: dB between codes. `laws`: of the causes to be tested, at most one of each. The null includes readings that
// average several fades of the stated spread: receivers average, and the mean of a few fades has another shape. Where
// the world states readings that do not scatter it includes normal noise of any size: that a receiver is noisy is no
// law of fading. It includes the field's variance, refitted under every law. `fit`: covariance of the field from rows,
// the start of the search for its shape. `unsure`: of each reading, true where its level would be another one with
// walls or places as far off as they may be; empty: of none. A few of such readings make no law.
LawTests law_tests(KrigedReadings& field, double step, const std::vector<std::shared_ptr<const ReadingLaw>>& laws,
                   const ReadingDistribution& stated, const noise::Covariance& fit,
                   const std::vector<bool>& unsure = {});

}  // namespace muster::diagnosis
