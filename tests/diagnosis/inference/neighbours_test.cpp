// Conditioning sets against a comparison of all rows with all.
#include "diagnosis/inference/noise/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/inference/thresholds.hpp"
#include "muster/random.hpp"

namespace muster::noise {
namespace {

// Readings in clusters narrower than a site is wide, of several anchors, that move where `moving`, and streams; every
// ninth is alone. No two are equally near to a third.
Sites clusters(Index n, int groups, int streams, bool moving) {
  const Stream s(23);
  const double site = inference::thresholds::same_site;
  Sites result{Eigen::Matrix3Xd::Zero(3, n),
               Eigen::Matrix3Xd::Zero(3, n),
               Eigen::Matrix3Xd::Zero(3, n),
               Eigen::Matrix3Xd::Zero(3, n),
               {},
               Eigen::VectorXd::Constant(n, 1)};
  for (Index i = 0; i < n; ++i) {
    const auto k = static_cast<uint64_t>(i), cluster = k % 40;
    const int group = static_cast<int>(k / 7) % groups;
    for (Index d = 0; d < 2; ++d) {
      const auto axis = static_cast<uint64_t>(d);
      result.place(d, i) = 9 * s.uniform(cluster, axis) + 0.7 * site * s.uniform(k + 100, axis + 3);
      result.anchor(d, i) = 3.0 * group + (moving ? 0.2 * site * s.uniform(k + 100, axis + 6) : 0);
    }
    result.group.push_back(group);
    result.stream.push_back(static_cast<int>(k / 3) % streams);
    result.alone.push_back(i % 9 == 4 ? 1 : 0);
  }
  return result;
}

// As neighbours.hpp says it, row by row: all earlier rows, sorted by their distance.
std::vector<Index> by_comparison(const Sites& sites, const Conditioning& with, Index i) {
  const double site = inference::thresholds::same_site;
  const Stream order(combined(key_of("vecchia order"), with.seed));
  const auto lot = [&](Index j) { return order.uniform(static_cast<uint64_t>(j)); };
  const auto of = [](const std::vector<int>& list, Index j) { return list[static_cast<std::size_t>(j)]; };
  const auto apart = [&](Index j) {
    return std::hypot((sites.place.col(i) - sites.place.col(j)).norm(),
                      (sites.anchor.col(i) - sites.anchor.col(j)).norm());
  };
  const auto nearest = [&](int most, const auto& admits, const auto& distance) {
    std::vector<std::pair<double, Index>> found;
    for (Index j = 0; j < sites.size(); ++j)
      if (lot(j) < lot(i) && !sites.is_alone(j) && admits(j)) found.emplace_back(distance(j), j);
    std::sort(found.begin(), found.end());
    std::vector<Index> rows;
    for (std::size_t k = 0; k < std::min(found.size(), static_cast<std::size_t>(most)); ++k)
      rows.push_back(found[k].second);
    return rows;
  };
  const auto own = [&](Index j) { return of(sites.group, j) == of(sites.group, i); };
  const auto beside = [&](Index j) { return own(j) && of(sites.stream, j) != of(sites.stream, i) && apart(j) < site; };
  const auto by_stream = [&](Index j) {
    return std::hypot(apart(j), site * (of(sites.stream, j) - of(sites.stream, i)));
  };
  std::vector<Index> rows = nearest(with.same, own, by_stream);
  const std::vector<Index> last = nearest(with.same / 2, beside, by_stream);
  std::erase_if(rows, [&](Index j) { return std::count(last.begin(), last.end(), j) > 0; });
  rows.resize(std::min(rows.size(), static_cast<std::size_t>(with.same) - last.size()));
  rows.insert(rows.end(), last.begin(), last.end());
  rows.resize(static_cast<std::size_t>(with.same), -1);
  const std::vector<Index> others = nearest(
      with.others, [&](Index j) { return !own(j); },
      [&](Index j) { return (sites.place.col(i) - sites.place.col(j)).norm(); });
  rows.insert(rows.end(), others.begin(), others.end());
  rows.resize(static_cast<std::size_t>(with.slots()), -1);
  return rows;
}

TEST(Neighbours, AreThoseThatAComparisonOfAllRowsFinds) {
  const Conditioning with{6, 5, 3};
  for (const auto& [groups, streams, moving] : {std::tuple(1, 1, false), {1, 3, false}, {4, 2, false}, {4, 3, true}}) {
    const Sites sites = clusters(700, groups, streams, moving);
    const std::vector<Index> found = neighbours_of(sites, with);
    for (Index i = 0; i < sites.size(); ++i) {
      const std::vector<Index> expected = sites.is_alone(i)
                                              ? std::vector<Index>(static_cast<std::size_t>(with.slots()), -1)
                                              : by_comparison(sites, with, i);
      const auto first = found.begin() + i * with.slots();
      ASSERT_EQ(std::vector<Index>(first, first + with.slots()), expected) << groups << ' ' << streams << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace muster::noise
