#include "diagnosis/inference/noise/neighbours.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <nanoflann.hpp>

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

// The nearest points that `admits` accepts, ties by index; nanoflann's own result set accepts all.
template <class Admits>
class Nearest {
 public:
  Nearest(std::size_t most, Admits admits) : most_(most), admits_(admits) {}

  std::size_t size() const { return found_.size(); }
  bool full() const { return found_.size() == most_; }
  double worstDist() const { return full() ? found_.back().first : std::numeric_limits<double>::max(); }
  bool addPoint(double distance, std::size_t point) {
    if (!admits_(point)) return true;
    const std::pair entry(distance, point);
    found_.insert(std::lower_bound(found_.begin(), found_.end(), entry), entry);
    if (found_.size() > most_) found_.pop_back();
    return true;
  }
  const std::vector<std::pair<double, std::size_t>>& found() const { return found_; }

 private:
  std::size_t most_;
  Admits admits_;
  std::vector<std::pair<double, std::size_t>> found_;
};

template <class Admits>
std::vector<Index> search(const Grove& grove, const Eigen::VectorXd& from, int most, Admits admits) {
  if (most == 0) return {};
  Nearest nearest(static_cast<std::size_t>(most), admits);
  grove.tree->findNeighbors(nearest, from.data(), nanoflann::SearchParams());
  std::vector<Index> result;
  for (const auto& [distance, point] : nearest.found()) result.push_back(grove.cloud.rows[point]);
  return result;
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
        search(own, both.col(i), conditioning.same, [&](std::size_t p) { return earlier(own.cloud.rows[p]); });
    if (!sites.stream.empty()) {
      near = with_last(
          std::move(near),
          search(own, both.col(i), conditioning.same / 2,
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
    const std::vector<Index> others = search(everywhere, sites.place.col(i), conditioning.others, other);
    std::copy(others.begin(), others.end(), slots + conditioning.same);
  }
  return result;
}

}  // namespace muster::noise
