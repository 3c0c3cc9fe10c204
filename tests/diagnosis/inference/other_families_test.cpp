// Families that are fitted beside the present one.
#include "diagnosis/inference/score/other_families.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace muster::inference {
namespace {

using noise::Family;

std::vector<Family> names_of(const std::vector<noise::Fit>& fits) {
  std::vector<Family> result;
  for (const noise::Fit& fit : fits) result.push_back(fit.covariance.family);
  return result;
}

// Fits from two shares end in one: the second cost as much as the first and changed nothing.
TEST(OtherFamilies, AreOneOfThoseThatDifferInTheirFixedShareAlone) {
  const Family tenth = noise::with_fixed(Family::exponential, 1, 0),
               third = noise::with_fixed(Family::exponential, 2, 0),
               one_way = noise::with_fixed(Family::exponential, 2, 1), stated = noise::with_fixed(Family::stated, 2, 0);
  std::vector<noise::Fit> fits;
  for (const Family family : {third, Family::exponential, tenth, Family::gaussian, one_way, stated})
    fits.push_back({{family, noise::Theta::Zero()}});
  EXPECT_EQ(names_of(other_families(fits, tenth)),
            (std::vector{Family::exponential, Family::gaussian, one_way, stated}));
  EXPECT_EQ(names_of(other_families(fits, Family::exponential)),
            (std::vector{third, Family::gaussian, one_way, stated}));
}

}  // namespace
}  // namespace muster::inference
