// The same comparisons on 10^8 links.
#include "adversary.hpp"

namespace muster::scene {
namespace {

TEST(ManyLinksLong, AgreeWithTheTwinOnTwentyMillion) { EXPECT_GT(compare_with_twin(1000, 20'000), 20'000'000); }

TEST(ManyLinksLong, AgreeWithShiftedRadiosOnSixtyMillion) {
  EXPECT_GT(compare_with_shifted_radios(2000, 6'000), 60'000'000);
}

TEST(ManyLinksLong, AgreeWithShiftedRadiosOnTwentyMillionOnLargeFloors) {
  EXPECT_GT(compare_with_shifted_radios(10'000, 2'000, 30, 30), 20'000'000);
}

}  // namespace
}  // namespace muster::scene
