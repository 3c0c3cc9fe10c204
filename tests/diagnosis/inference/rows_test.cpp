// Rows that are divided where an effect changes.
#include "diagnosis/inference/noise/rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace muster::noise {
namespace {

TEST(Rows, EndWhereAnEffectStartsOrStops) {
  constexpr int size = 60;
  Eigen::VectorXd effect = Eigen::VectorXd::Zero(size), value(size);
  std::vector<Index> order, first;
  for (int k = 0; k < size; ++k) {
    order.push_back(size - 1 - k);  // in reverse order
    if (k % 6 == 0) first.push_back(k);
    if (k > 12 && k < 31) effect[k] = -4;
    value[k] = std::sin(k);
  }
  first.push_back(size);
  const Rows whole(order, first);
  ASSERT_EQ(whole.size(), 10);
  std::vector<Index> parent;
  const Rows ended = whole.ended_where(effect, 1, parent);
  EXPECT_EQ(ended.size(), 12);
  ASSERT_EQ(parent.size(), 12u);
  const Eigen::VectorXd means = ended.mean(effect), of_values = ended.mean(value), of_whole = whole.mean(value);
  for (Index i = 0; i < ended.size(); ++i) EXPECT_TRUE(means[i] == 0 || means[i] == -4) << i;
  EXPECT_EQ(ended.count().sum(), size);
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(whole.size());
  for (Index i = 0; i < ended.size(); ++i) sums[parent[static_cast<std::size_t>(i)]] += of_values[i] * ended.count()[i];
  EXPECT_LT((sums.cwiseQuotient(whole.count()) - of_whole).norm(), 1e-12);
  EXPECT_LT((ended.at_readings(means) - effect).norm(), 1e-12);
  EXPECT_EQ(whole.ended_where(effect, 5, parent).size(), 10);
}

}  // namespace
}  // namespace muster::noise
