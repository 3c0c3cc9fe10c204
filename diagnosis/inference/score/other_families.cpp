#include "diagnosis/inference/score/other_families.hpp"

#include <algorithm>

namespace muster::inference {
namespace {

// True if a fit from either family ends in the same one.
bool alike(noise::Family a, noise::Family b) {
  return a == b || (noise::fixed_share(a) > 0 && noise::fixed_share(b) > 0 &&
                    noise::without_fixed(a) == noise::without_fixed(b) &&
                    (noise::stream_part(a) == 1) == (noise::stream_part(b) == 1));
}

}  // namespace

std::vector<noise::Fit> other_families(const std::vector<noise::Fit>& families, noise::Family present) {
  std::vector<noise::Fit> result;
  for (const noise::Fit& family : families) {
    const auto is_alike = [&](const noise::Fit& known) {
      return alike(known.covariance.family, family.covariance.family);
    };
    if (!alike(present, family.covariance.family) && std::none_of(result.begin(), result.end(), is_alike))
      result.push_back(family);
  }
  return result;
}

}  // namespace muster::inference
