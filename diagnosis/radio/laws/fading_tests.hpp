// How readings scatter about the level of their place, and whether the world's law of it holds: fading of another
// strength, hopping channels, outliers, each by a likelihood ratio against the stated law.
#pragma once

#include <string>

#include "diagnosis/radio/laws/kriging.hpp"
#include "diagnosis/radio/laws/reading_distribution.hpp"

namespace muster::diagnosis {

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
  ReadingLaw law{};  // as fitted
};

struct LawTests {
  std::vector<LawTest> tests;  // by falling evidence; values of the first alone
  ReadingLaw stated;           // of as many fades in one reading as is likeliest
};

// `step` in dB between codes. That a reading may be the mean of several fades of the same spread
// as stated is part of the null: receivers average, and the mean of a few fades has another shape. So is the field's
// own variance, which is fitted anew under every law. `fit`: of the field to rows, where its shape is sought from.
LawTests law_tests(ReadingField& field, double step, const ReadingLaw& stated, const noise::Covariance& fit);

}  // namespace muster::diagnosis
