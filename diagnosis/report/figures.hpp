// The pictures of a diagnosis.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/picture/figure.hpp"
#include "diagnosis/report/words.hpp"

namespace muster::report {

struct Picture {
  std::string name;  // of its file, without ending
  picture::Figure figure;
};

// Only those that the data allow: no map without places that vary, no steps without held-out blocks.
std::vector<Picture> pictures_of(const Diagnosis& diagnosis);

// ---- Its parts ----

picture::Figure residual_map(const Diagnosis& diagnosis);
picture::Figure before_and_after(const Diagnosis& diagnosis);
picture::Figure staircase(const Diagnosis& diagnosis);
picture::Figure partial_residual(const Diagnosis& diagnosis, const FoundCause& cause);
picture::Figure residual_by_covariate(const Diagnosis& diagnosis);

}  // namespace muster::report
