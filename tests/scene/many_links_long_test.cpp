// The same comparisons on 10^8 links.
#include "adversary.hpp"

namespace muster::scene {
namespace {

TEST(ManyLinksLong, AgreeWithTheTwinOnTwentyMillion) { EXPECT_GT(compare_with_twin(1000, 20'000), 20'000'000); }

TEST(ManyLinksLong, AgreeWithSingleLinksOnEightyMillion) {
  EXPECT_GT(compare_with_single_links(2000, 8'000), 80'000'000);
}

}  // namespace
}  // namespace muster::scene
