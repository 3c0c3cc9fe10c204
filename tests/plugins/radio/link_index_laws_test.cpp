// The link from one radio to another, for any order of the links.
#include <gtest/gtest.h>

#include <vector>

#include "network_ideal/link_index.hpp"

namespace muster {
namespace {

template <class Row>
Rows<const Row> view(const std::vector<Row>& rows) {
  return {reinterpret_cast<const double*>(rows.data()), rows.size()};
}

TEST(LinkIndex, FindsADirectionByItsRadios) {
  const std::vector<Endpoint> ends{{7, 0}, {2, 0}, {5, 0}};
  const std::vector<Ends> links{{0, 1}, {0, 2}, {1, 0}, {2, 1}};
  const LinkIndex index(view(links), view(ends));
  EXPECT_EQ(index.find(7, 2), 0u);
  EXPECT_EQ(index.find(7, 5), 1u);
  EXPECT_EQ(index.find(2, 7), 2u);
  EXPECT_EQ(index.find(5, 2), 3u);
  EXPECT_EQ(index.find(2, 5), LinkIndex::none);
  EXPECT_EQ(index.find(7, 7), LinkIndex::none);
  EXPECT_EQ(index.find(9, 2), LinkIndex::none);
}

TEST(LinkIndex, TakesTheLastOfSeveralReadings) {
  const std::vector<Endpoint> ends{{1, 0}, {0, 0}, {0, 1}, {1, 1}, {1, 2}, {0, 2}};
  const std::vector<Ends> links{{0, 1}, {2, 3}, {4, 5}};
  const LinkIndex index(view(links), view(ends));
  EXPECT_EQ(index.find(1, 0), 2u);
  EXPECT_EQ(index.find(0, 1), 1u);
}

}  // namespace
}  // namespace muster
