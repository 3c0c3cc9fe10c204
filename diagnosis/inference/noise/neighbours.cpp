#include "diagnosis/inference/noise/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <nanoflann.hpp>
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

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Adaptor<double, Cloud>, Cloud, -1>;

struct Grove {
  Cloud cloud;
  std::unique_ptr<Tree> tree;

  Grove(const Eigen::MatrixXd& all, std::vector<Index> rows) : cloud{all(Eigen::all, rows), std::move(rows)} {
    tree = std::make_unique<Tree>(static_cast<int>(all.rows()), cloud, nanoflann::KDTreeSingleIndexAdaptorParams(12));
    tree->buildIndex();
  }
};

// The nearest points that `admits` accepts. Of equally near ones, as rows of one site are, any: another choice for each
// row, as in a random order, but the same wherever they lie, so that the likelihoods of two maps differ by the maps
// alone. nanoflann's own result set accepts all, and its search leaves out points as far as the last one.
template <class Admits>
class Nearest {
 public:
  Nearest(std::size_t most, Index from, const std::vector<Index>& rows, Admits admits)
      : most_(most), from_(static_cast<uint64_t>(from)), rows_(rows), admits_(admits) {}

  std::size_t size() const { return found_.size(); }
  bool full() const { return found_.size() == most_; }
  double worstDist() const {
    constexpr double most = std::numeric_limits<double>::max();
    return full() ? std::nextafter(found_.back().distance, most) : most;
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
  uint64_t from_;
  const std::vector<Index>& rows_;
  Admits admits_;
  std::vector<Found> found_;
};

// Of row `from`, which lies there.
template <class Admits>
std::vector<Index> search(const Grove& grove, Index from, const Eigen::VectorXd& there, int most, Admits admits) {
  if (most == 0) return {};
  Nearest nearest(static_cast<std::size_t>(most), from, grove.cloud.rows, admits);
  grove.tree->findNeighbors(nearest, there.data(), nanoflann::SearchParams());
  return nearest.rows();
}

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
  const Index n = sites.size();
  const auto rank = random_ranks(n, conditioning.seed);
  // Of rows of one site those of the same stream come first: what is fixed to it is known from them alone. Up to half
  // are of its other streams, without which no row would tell how two streams differ.
  Eigen::MatrixXd both = Eigen::MatrixXd::Zero(7, n);
  both.topRows(6) << sites.place, sites.anchor;
  for (std::size_t i = 0; i < sites.stream.size(); ++i)
    both(6, static_cast<Index>(i)) = inference::thresholds::same_site * sites.stream[i];
  std::map<int, std::vector<Index>> of_group;
  std::vector<Index> all;
  for (Index i = 0; i < n; ++i) {
    if (sites.is_alone(i)) continue;
    of_group[sites.group[static_cast<std::size_t>(i)]].push_back(i);
    all.push_back(i);
  }
  std::map<int, Grove> groves;
  for (const auto& [group, rows] : of_group) groves.try_emplace(group, both, rows);
  const Grove everywhere(sites.place, all);

  std::vector<Index> result(static_cast<std::size_t>(n * conditioning.slots()), -1);
  for (const Index i : all) {
    const int group = sites.group[static_cast<std::size_t>(i)];
    const auto earlier = [&](Index j) { return rank[static_cast<std::size_t>(j)] < rank[static_cast<std::size_t>(i)]; };
    Index* const slots = result.data() + i * conditioning.slots();
    const Grove& own = groves.at(group);
    const auto most = static_cast<std::size_t>(conditioning.same);
    std::vector<Index> near =
        search(own, i, both.col(i), conditioning.same, [&](std::size_t p) { return earlier(own.cloud.rows[p]); });
    if (!sites.stream.empty()) {
      near = with_last(
          std::move(near),
          search(own, i, both.col(i), conditioning.same / 2,
                 [&](std::size_t p) {
                   const Index row = own.cloud.rows[p];
                   return sites.stream[static_cast<std::size_t>(row)] != sites.stream[static_cast<std::size_t>(i)] &&
                          (both.col(row) - both.col(i)).head(6).norm() < inference::thresholds::same_site &&
                          earlier(row);
                 }),
          most);
    }
    std::copy(near.begin(), near.end(), slots);
    if (of_group.size() < 2) continue;
    const auto other = [&](std::size_t p) {
      const Index row = everywhere.cloud.rows[p];
      return sites.group[static_cast<std::size_t>(row)] != group && earlier(row);
    };
    const std::vector<Index> others = search(everywhere, i, sites.place.col(i), conditioning.others, other);
    std::copy(others.begin(), others.end(), slots + conditioning.same);
  }
  return result;
}

}  // namespace muster::noise
