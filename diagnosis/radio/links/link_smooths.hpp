// Smooths over the covariates of link readings: distance, bearings, time, place, link, further columns and factors of
// the data, and products.
#pragma once

#include "diagnosis/inference/state/smooths.hpp"
#include "diagnosis/radio/links/link_rows.hpp"

namespace muster::diagnosis {

// Columns of the data beyond those of a link.
struct LinkColumns {
  std::vector<inference::Covariate> covariates;
  std::vector<inference::Factor> factors;
};

// `places_known`: false if the data have only distances.
std::vector<inference::Candidate> link_smooths(const LinkReadings& readings, const LinkColumns& columns,
                                               bool places_known);

}  // namespace muster::diagnosis
