// Conditioning sets of Vecchia's approximation: rows in a random order, each with its nearest earlier rows of the
// same anchor and of others. Random orders approximate best (Guinness, Permutation and grouping methods for
// sharpening Gaussian process approximations, Technometrics 60, 2018).
#pragma once

#include "diagnosis/inference/noise/rows.hpp"

namespace muster::noise {

struct Conditioning {
  int same = 10, others = 12;  // rows of the same anchor; of others, for the shared part of the field
  uint64_t seed = 1;           // of the order

  int slots() const { return same + others; }
};

// slots() a row; -1: fewer earlier rows than slots.
std::vector<Index> neighbours_of(const Sites& sites, const Conditioning& conditioning);

}  // namespace muster::noise
