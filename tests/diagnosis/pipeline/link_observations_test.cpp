// Columns of the data as the search reads them.
#include "diagnosis/pipeline/link_observations.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/diagnosis/scratch.hpp"

namespace muster::diagnosis {
namespace {

// Fourteen settings of eight values have more combinations than an int has numbers.
TEST(SettingsOf, ManyColumnsAreNumberedAnew) {
  ObservedColumns observed;
  for (int c = 0; c < 14; ++c) {
    inference::Factor factor{"setting" + std::to_string(c), {}};
    for (int i = 0; i < 64; ++i) factor.level.push_back(i < 8 ? i : (i >> (c % 3)) % 8);
    observed.columns.factors.push_back(factor);
  }
  std::set<std::vector<int>> combinations;
  for (std::size_t i = 0; i < 64; ++i) {
    std::vector<int> one;
    for (const inference::Factor& factor : observed.columns.factors) one.push_back(factor.level[i]);
    combinations.insert(one);
  }
  const std::vector<int> settings = settings_of(observed);
  EXPECT_EQ(std::set(settings.begin(), settings.end()).size(), combinations.size());
  EXPECT_EQ(*std::min_element(settings.begin(), settings.end()), 0);
  EXPECT_EQ(*std::max_element(settings.begin(), settings.end()), static_cast<int>(combinations.size()) - 1);
}

// A column `run` that counts the readings is none of runs.
TEST(ObservedColumns, ANumberOfEachReadingIsNoRun) {
  Dataset data;
  Covariate run;
  run.name = "run";
  for (int i = 0; i < 40; ++i) run.values.push_back(i);
  data.covariates = {run};
  std::vector<Eigen::Index> used(40);
  for (std::size_t i = 0; i < used.size(); ++i) used[i] = static_cast<Eigen::Index>(i);
  EXPECT_TRUE(observed_columns(data, used).run.empty());
  for (std::size_t i = 0; i < used.size(); ++i) {
    const std::size_t ten = i / 10;
    data.covariates[0].values[i] = 40 - static_cast<double>(ten);
  }
  const std::vector<int> runs = observed_columns(data, used).run;
  ASSERT_EQ(runs.size(), used.size());
  EXPECT_EQ(runs.front(), 3);
  EXPECT_EQ(runs.back(), 0);
}

}  // namespace
}  // namespace muster::diagnosis
