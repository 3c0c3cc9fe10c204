// Figures of a diagnosis.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/report/words.hpp"
#include "plotting/figure.hpp"

namespace muster::report {

struct Picture {
  std::string name;  // of its file, without extension
  plotting::Figure figure;
};

// All figures that the data allow: no map without varying places, no steps without held-out blocks.
std::vector<Picture> pictures_of(const Diagnosis& diagnosis);

// ---- Its parts ----

plotting::Figure residual_map(const Diagnosis& diagnosis);
plotting::Figure before_and_after(const Diagnosis& diagnosis);
plotting::Figure staircase(const Diagnosis& diagnosis);
plotting::Figure partial_residual(const Diagnosis& diagnosis, const CauseEstimate& cause);
plotting::Figure residual_by_covariate(const Diagnosis& diagnosis);

}  // namespace muster::report
