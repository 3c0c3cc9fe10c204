// Smooths along everything that a reading of a link has: distance, bearings, time, place, link, each further column and
// factor of the data, and products.
#pragma once

#include "diagnosis/inference/state/smooths.hpp"
#include "diagnosis/radio/links/link_rows.hpp"

namespace muster::diagnosis {

// Columns of the data beyond those of a link.
struct LinkColumns {
  std::vector<inference::Covariate> covariates;
  std::vector<inference::Factor> factors;
};

// `places_known`: false where the data have distances alone.
std::vector<inference::Candidate> link_smooths(const LinkReadings& readings, const LinkColumns& columns,
                                               bool places_known);

}  // namespace muster::diagnosis
