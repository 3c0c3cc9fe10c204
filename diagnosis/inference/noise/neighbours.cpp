#include "diagnosis/inference/noise/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <nanoflann.hpp>
#include <optional>
#include <tuple>

#include "diagnosis/inference/thresholds.hpp"
#include "muster/random.hpp"

namespace muster::noise {
namespace {

// Points of some rows in d dimensions, in nanoflann's interface.
struct Cloud {
  Eigen::MatrixXd at;       // d x points
  std::vector<Index> rows;  // of the points

  std::size_t kdtree_get_point_count() const { return rows.size(); }
  double kdtree_get_pt(std::size_t point, std::size_t d) const {
    return at(static_cast<Index>(d), static_cast<Index>(point));
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, -1>;

// The nearest points that `admits` accepts. Of equally near ones, as rows of one site are, any: another choice for each
// row, as in a random order, but the same wherever they lie, so that the likelihoods of two maps differ by the maps
// alone. nanoflann's own result set accepts all, and its search leaves out points as far as the last one.
template <class Admits>
class Nearest {
 public:
  // `within`, m^2: no farther points are sought.
  Nearest(std::size_t most, double within, Index from, const std::vector<Index>& rows, Admits admits)
      : most_(most), within_(within), from_(static_cast<uint64_t>(from)), rows_(rows), admits_(admits) {}

  std::size_t size() const { return found_.size(); }
  bool full() const { return found_.size() == most_; }
  double worstDist() const {
    return full() ? std::nextafter(found_.back().distance, std::numeric_limits<double>::max()) : within_;
  }
  bool addPoint(double distance, std::size_t point) {
    if (!admits_(point)) return true;
    const Found entry{distance, combined(from_, static_cast<uint64_t>(rows_[point])), rows_[point]};
    found_.insert(std::lower_bound(found_.begin(), found_.end(), entry), entry);
    if (found_.size() > most_) found_.pop_back();
    return true;
  }
  std::vector<Index> rows() const {
    std::vector<Index> result;
    for (const Found& each : found_) result.push_back(each.row);
    return result;
  }

 private:
  struct Found {
    double distance;
    uint64_t lot;  // drawn
    Index row;

    bool operator<(const Found& other) const {
      return std::tie(distance, lot, row) < std::tie(other.distance, other.lot, other.row);
    }
  };

  std::size_t most_;
  double within_;
  uint64_t from_;
  const std::vector<Index>& rows_;
  Admits admits_;
  std::vector<Found> found_;
};

// Trees of ever fewer rows, each of those that come first in an order: all, half, a quarter ... The nearest of the rows
// before the k-th are sought in the smallest that has them all, of which at least every other one counts.
class Grove {
 public:
  // `rows` in that order, which `rank` tells; both stay the caller's.
  Grove(const Eigen::MatrixXd& all, std::vector<Index> rows, const std::vector<Index>& rank)
      : all_(&all), rank_(&rank), rows_(std::move(rows)) {
    // A dimension that is the same for all, as the anchor of one station, tells none apart.
    for (Index d = 0; d < all.rows(); ++d) {
      const auto differs = [&](Index row) { return all(d, row) != all(d, rows_.front()); };
      if (std::any_of(rows_.begin(), rows_.end(), differs)) telling_.push_back(d);
    }
    if (telling_.empty()) telling_.push_back(0);
    for (std::vector<Index> some = rows_;; some.resize((some.size() + 1) / 2)) {
      trees_.push_back(std::make_unique<Planted>(all(telling_, some), some));
      if (some.size() <= fewest) return;
    }
  }

  // The nearest to row `from`, at most `most`, of those before it that `admits` accepts. Where few are accepted,
  // `within` [m^2], which they are nearer than, saves a look at all others.
  template <class Admits>
  std::vector<Index> nearest(Index from, int most, const Admits& admits,
                             double within = std::numeric_limits<double>::max()) const {
    if (most == 0) return {};
    const Planted& near = with_all_before(from);
    const auto is_earlier = [&](std::size_t point) {
      const Index row = near.cloud.rows[point];
      return (*rank_)[static_cast<std::size_t>(row)] < (*rank_)[static_cast<std::size_t>(from)] && admits(row);
    };
    Nearest found(static_cast<std::size_t>(most), within, from, near.cloud.rows, is_earlier);
    const Eigen::VectorXd there = (*all_)(telling_, from);
#ifndef __clang_analyzer__  // it follows nodes with one child, of which nanoflann builds none
    near.tree.findNeighbors(found, there.data(), nanoflann::SearchParams());
#endif
    return found.rows();
  }

 private:
  struct Planted {
    Cloud cloud;
    Tree tree;

    Planted(Eigen::MatrixXd at, const std::vector<Index>& rows)
        : cloud{std::move(at), rows},
          tree(static_cast<int>(cloud.at.rows()), cloud, nanoflann::KDTreeSingleIndexAdaptorParams(12)) {
      tree.buildIndex();
    }
  };

  const Planted& with_all_before(Index from) const {
    const auto rank_of = [&](Index row) { return (*rank_)[static_cast<std::size_t>(row)]; };
    const auto end =
        std::partition_point(rows_.begin(), rows_.end(), [&](Index row) { return rank_of(row) < rank_of(from); });
    const auto before = static_cast<std::size_t>(end - rows_.begin());
    std::size_t k = 0;
    while (k + 1 < trees_.size() && trees_[k + 1]->cloud.rows.size() >= before) ++k;
    return *trees_[k];
  }

  static constexpr std::size_t fewest = 64;  // below, a smaller tree saves nothing
  const Eigen::MatrixXd* all_;
  const std::vector<Index>* rank_;
  std::vector<Index> rows_;
  std::vector<Index> telling_;                         // dimensions
  std::vector<std::unique_ptr<const Planted>> trees_;  // the largest first
};

// At most `most` rows: `instead` at the end, and the first of the others.
std::vector<Index> with_last(std::vector<Index> rows, const std::vector<Index>& instead, std::size_t most) {
  std::erase_if(rows, [&](Index row) { return std::find(instead.begin(), instead.end(), row) != instead.end(); });
  rows.resize(std::min(rows.size(), most - instead.size()));
  rows.insert(rows.end(), instead.begin(), instead.end());
  return rows;
}

std::vector<Index> random_ranks(Index n, uint64_t seed) {
  const Stream stream(combined(key_of("vecchia order"), seed));
  std::vector<std::pair<double, Index>> order;
  for (Index i = 0; i < n; ++i) order.emplace_back(stream.uniform(static_cast<uint64_t>(i)), i);
  std::sort(order.begin(), order.end());
  std::vector<Index> rank(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    rank[static_cast<std::size_t>(order[k].second)] = static_cast<Index>(k);
  return rank;
}

}  // namespace

std::vector<Index> neighbours_of(const Sites& sites, const Conditioning& conditioning) {
  constexpr double same_site = inference::thresholds::same_site;
  const Index n = sites.size();
  const auto rank = random_ranks(n, conditioning.seed);
  // Of rows of one site those of the same stream come first: what is fixed to it is known from them alone. Up to half
  // are of its other streams, without which no row would tell how two streams differ.
  Eigen::MatrixXd both = Eigen::MatrixXd::Zero(7, n);
  both.topRows(6) << sites.place, sites.anchor;
  const auto [first, last] = std::minmax_element(sites.stream.begin(), sites.stream.end());
  const bool several_streams = !sites.stream.empty() && *first != *last;
  for (std::size_t i = 0; i < sites.stream.size(); ++i) both(6, static_cast<Index>(i)) = same_site * sites.stream[i];
  std::vector<Index> by_rank(rank.size());
  for (Index i = 0; i < n; ++i) by_rank[static_cast<std::size_t>(rank[static_cast<std::size_t>(i)])] = i;
  std::erase_if(by_rank, [&](Index row) { return sites.is_alone(row); });
  std::map<int, std::vector<Index>> of_group;
  for (const Index i : by_rank) of_group[sites.group[static_cast<std::size_t>(i)]].push_back(i);
  std::map<int, Grove> groves;
  for (const auto& [group, rows] : of_group) groves.try_emplace(group, both, rows, rank);
  std::optional<Grove> everywhere;
  const Eigen::MatrixXd place = sites.place;
  if (of_group.size() > 1) everywhere.emplace(place, by_rank, rank);

  std::vector<Index> result(static_cast<std::size_t>(n * conditioning.slots()), -1);
  for (Index i = 0; i < n; ++i) {
    if (sites.is_alone(i)) continue;
    const int group = sites.group[static_cast<std::size_t>(i)];
    Index* const slots = result.data() + i * conditioning.slots();
    const Grove& own = groves.at(group);
    const auto most = static_cast<std::size_t>(conditioning.same);
    std::vector<Index> near = own.nearest(i, conditioning.same, [](Index) { return true; });
    if (several_streams) {
      const auto beside = [&](Index row) {
        return sites.stream[static_cast<std::size_t>(row)] != sites.stream[static_cast<std::size_t>(i)] &&
               (both.col(row) - both.col(i)).head(6).norm() < same_site;
      };
      const double within = same_site * same_site * (1 + std::pow(*last - *first, 2));
      near = with_last(std::move(near), own.nearest(i, conditioning.same / 2, beside, within), most);
    }
    std::copy(near.begin(), near.end(), slots);
    if (!everywhere) continue;
    const auto other = [&](Index row) { return sites.group[static_cast<std::size_t>(row)] != group; };
    const std::vector<Index> others = everywhere->nearest(i, conditioning.others, other);
    std::copy(others.begin(), others.end(), slots + conditioning.same);
  }
  return result;
}

}  // namespace muster::noise
