// Counts for many links: kernels find what is clear, and what is not is worked out exactly, wall by wall.
#include <algorithm>
#include <cstring>
#include <memory>
#include <numeric>

#include "scene/crossing_link.hpp"
#include "scene/curve.hpp"

namespace muster::scene {
namespace {

// From so many receivers of one radio on, it pays to look at the walls from there.
constexpr std::size_t many = 12;

// From so many blocks of walls on, receivers are taken as they lie around the radio, not as they lie together: fewer
// walls stand between.
constexpr int widest_scene = 64;

std::vector<std::uint32_t> along_curve(const std::vector<LatticePoint>& points) {
  std::vector<std::uint32_t> place, order(points.size());
  for (const LatticePoint& point : points) place.push_back(place_on_curve(point.spot));
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return place[a] < place[b]; });
  return order;
}

std::vector<LatticePoint> snapped(const std::vector<Point>& points) {
  std::vector<LatticePoint> result;
  result.reserve(points.size());
  for (const Point& point : points) result.push_back(snapped(point));
  return result;
}

// Sorts by key(item), below `keys`, and keeps the order of equals.
template <class Key>
std::vector<std::uint32_t> sorted(const std::vector<std::uint32_t>& items, std::size_t keys, const Key& key) {
  std::vector<std::uint32_t> next(keys + 1, 0), result(items.size());
  for (const std::uint32_t item : items) ++next[key(item) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (const std::uint32_t item : items) result[next[key(item)]++] = item;
  return result;
}

// In both ends, which are below 2^31: else a difference of neighbours has its highest bit set.
bool ascend(const std::vector<Pair>& links) {
  const auto key = [](const Pair& link) { return std::uint64_t{link.from} << 32 | link.to; };
  std::uint64_t differences = 0;
  for (std::size_t i = 1; i < links.size(); ++i) differences |= key(links[i]) - key(links[i - 1]) - 1;
  return differences >> 63 == 0;
}

// Most of them within a block of receivers of their place.
bool nearly_sorted(const std::vector<std::uint32_t>& order) {
  std::size_t displaced = 0;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    displaced += (order[i] > i ? order[i] - i : i - order[i]) > receivers;
  }
  return displaced * 8 <= order.size();
}

// Links in the order of their senders, and of each sender's receivers, along the curve. Empty if they are so already,
// or nearly, or are too few for it to pay.
std::vector<std::uint32_t> better_order(const std::vector<LatticePoint>& points, const std::vector<Pair>& links) {
  if (links.size() < many * points.size() / 2) return {};
  const auto order = along_curve(points);
  if (nearly_sorted(order) && ascend(links)) return {};
  std::vector<std::uint32_t> rank(points.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) rank[order[i]] = i;
  std::vector<std::uint32_t> items(links.size());
  std::iota(items.begin(), items.end(), 0u);
  items = sorted(items, points.size(), [&](std::uint32_t i) { return rank[links[i].to]; });
  return sorted(items, points.size(), [&](std::uint32_t i) { return rank[links[i].from]; });
}

}  // namespace

std::vector<std::uint32_t> spatial_order(const std::vector<Point>& points) { return along_curve(snapped(points)); }

bool in_spatial_order(const std::vector<Point>& points) { return nearly_sorted(spatial_order(points)); }

const WallKernel& best_wall_kernel() { return *wall_kernels().all[wall_kernels().number - 1]; }

class Scene::ManyLinks {
 public:
  ManyLinks(const Scene& scene, const WallKernel& kernel, const std::vector<Point>& points,
            const std::vector<Pair>& links, std::vector<int>& by_material)
      : scene_(scene),
        kernel_(kernel),
        table_(scene.columns_.table()),
        points_(snapped(points)),
        links_(links),
        order_(better_order(points_, links)),
        by_material_(by_material),
        seen_(new SeenBlock[static_cast<std::size_t>(table_.blocks)]),
        unsure_(new std::uint16_t[static_cast<std::size_t>(table_.blocks)]),
        lists_(new int[3 * (walls() + block)]),
        doubts_(new Doubt[2 * walls()]),
        counts_(new Counts[static_cast<std::size_t>(scene.materials_)]),
        counts_of_one_(static_cast<std::size_t>(scene.materials_)) {
    by_material_.resize(links.size() * static_cast<std::size_t>(scene.materials_));
    view_.seen = seen_.get();
    view_.unsure = unsure_.get();
    view_.one = lists_.get();
    view_.other = view_.one + walls() + block;
    view_.third = view_.other + walls() + block;
    for (const LatticePoint& point : points_) {
      x_.push_back(static_cast<float>(point.spot.x));
      y_.push_back(static_cast<float>(point.spot.y));
      z_.push_back(static_cast<float>(point.z));
    }
  }

  void count() {
    for (std::size_t first = 0, last = 0; first < links_.size(); first = last) {
      const std::uint32_t from = link(first).from;
      while (last < links_.size() && link(last).from == from) ++last;
      view_.x = x_[from], view_.y = y_[from], view_.z = z_[from];
      if (last - first < many) {
        for (std::size_t i = first; i < last; ++i) count_one(i);
        continue;
      }
      look_from(from);
      if (table_.blocks > widest_scene) sort_by_direction(from, first, last);
      for (std::size_t i = first; i < last; i += receivers) count_block(i, std::min<std::size_t>(last - i, receivers));
    }
  }

 private:
  struct alignas(64) Counts {
    int of[receivers];
  };

  std::size_t walls() const { return static_cast<std::size_t>(table_.blocks) * block; }
  std::size_t row(std::size_t i) const { return order_.empty() ? i : order_[i]; }
  const Pair& link(std::size_t i) const { return links_[row(i)]; }

  // Sorts the links [first, last) by their direction, as seen from the radio, into 256 parts of a turn.
  void sort_by_direction(std::uint32_t from, std::size_t first, std::size_t last) {
    if (order_.empty()) {
      order_.resize(links_.size());
      std::iota(order_.begin(), order_.end(), 0u);
    }
    std::uint32_t next[257] = {};
    const float from_x = x_[from], from_y = y_[from];
    directed_.resize(last - first);
    for (std::size_t i = first; i < last; ++i) {
      const std::uint32_t item = order_[i], to = links_[item].to;
      const float x = x_[to] - from_x, y = y_[to] - from_y, part = 64 * y / (std::abs(x) + std::abs(y) + 1);
      const unsigned direction = static_cast<unsigned>(static_cast<int>(x >= 0 ? 64 + part : 192 - part));
      directed_[i - first] = {direction, item};
      ++next[direction + 1];
    }
    std::partial_sum(std::begin(next), std::end(next), std::begin(next));
    for (const Directed& each : directed_) order_[first + next[each.direction]++] = each.link;
  }

  void look_from(std::uint32_t from) {
    kernel_.look(table_, view_);
    for (int i = 0; i < table_.blocks; ++i) {
      for (unsigned set = view_.unsure[i]; set != 0; set &= set - 1) make_sure(i * block + __builtin_ctz(set), from);
    }
  }

  void make_sure(int wall, std::uint32_t from) {
    const int of_scene = scene_.columns_.row(wall);
    if (of_scene < 0) return;
    const LatticeWall& exact = scene_.walls_[static_cast<std::size_t>(of_scene)];
    const Spot& at = points_[from].spot;
    const std::int64_t side = orientation(exact.a, exact.b, at);
    const Spot &a = is_right(side) ? exact.b : exact.a, &b = is_right(side) ? exact.a : exact.b;
    SeenBlock& seen = seen_[wall / block];
    const int i = wall % block;
    seen.ax[i] = static_cast<float>(a.x - at.x), seen.ay[i] = static_cast<float>(a.y - at.y);
    seen.bx[i] = static_cast<float>(b.x - at.x), seen.by[i] = static_cast<float>(b.y - at.y);
    seen.area[i] = std::abs(static_cast<float>(side));
  }

  // The material that the link crosses the wall in, or -1.
  int crossed(int wall, const Pair& link) const {
    const int of_scene = scene_.columns_.row(wall);
    Hit hit;
    const bool crosses = of_scene >= 0 && scene_.cross(Link(points_[link.from], points_[link.to]), of_scene, hit);
    return crosses ? hit.material : -1;
  }

  void count_one(std::size_t i) {
    std::fill(counts_of_one_.begin(), counts_of_one_.end(), 0);
    const Pair& link = this->link(i);
    const int doubts =
        kernel_.count_one(table_, view_, x_[link.to], y_[link.to], z_[link.to], counts_of_one_.data(), doubts_.get());
    for (int k = 0; k < doubts; ++k) {
      for (unsigned set = doubts_[k].lanes; set != 0; set &= set - 1) {
        const int material = crossed(doubts_[k].wall + __builtin_ctz(set), link);
        if (material >= 0) ++counts_of_one_[material];
      }
    }
    for (std::size_t m = 0; m < counts_of_one_.size(); ++m)
      by_material_[m * links_.size() + row(i)] = counts_of_one_[m];
  }

  void count_block(std::size_t first, std::size_t number) {
    float x[receivers], y[receivers], z[receivers];
    const std::uint32_t to = link(first).to;
    const bool in_row = number == receivers && consecutive(first);
    for (std::size_t i = 0; i < receivers && !in_row; ++i) {
      const std::uint32_t each = link(first + std::min(i, number - 1)).to;
      x[i] = x_[each], y[i] = y_[each], z[i] = z_[each];
    }
    const int doubts = in_row
                           ? kernel_.count(table_, view_, &x_[to], &y_[to], &z_[to], counts_.get()->of, doubts_.get())
                           : kernel_.count(table_, view_, x, y, z, counts_.get()->of, doubts_.get());
    for (int k = 0; k < doubts; ++k) {
      for (unsigned set = doubts_[k].lanes & ~0u >> (receivers - number); set != 0; set &= set - 1) {
        const int lane = __builtin_ctz(set);
        const int material = crossed(doubts_[k].wall, link(first + lane));
        if (material >= 0) ++counts_[material].of[lane];
      }
    }
    for (int m = 0; m < scene_.materials_; ++m) {
      const int* const counted = counts_[m].of;
      int* const out = by_material_.data() + static_cast<std::size_t>(m) * links_.size();
      if (in_row) {
        std::memcpy(out + first, counted, receivers * sizeof *counted);  // of a size that the compiler knows
      } else if (order_.empty()) {
        std::copy_n(counted, number, out + first);
      } else {
        for (std::size_t i = 0; i < number; ++i) out[order_[first + i]] = counted[i];
      }
    }
  }

  // Whether a whole block of receivers follow one another as points do, too.
  bool consecutive(std::size_t first) const {
    if (!order_.empty()) return false;
    std::uint32_t gaps = 0;
    for (std::uint32_t i = 0; i < receivers; ++i) gaps |= links_[first + i].to - links_[first].to - i;
    return gaps == 0;
  }

  const Scene& scene_;
  const WallKernel& kernel_;
  const WallTable table_;
  const std::vector<LatticePoint> points_;
  const std::vector<Pair>& links_;
  std::vector<std::uint32_t> order_;
  struct Directed {
    std::uint32_t direction, link;
  };
  std::vector<Directed> directed_;
  std::vector<int>& by_material_;
  // Not filled before they are used: a few links must not pay for all walls.
  const std::unique_ptr<SeenBlock[]> seen_;
  const std::unique_ptr<std::uint16_t[]> unsure_;
  const std::unique_ptr<int[]> lists_;
  const std::unique_ptr<Doubt[]> doubts_;
  const std::unique_ptr<Counts[]> counts_;
  std::vector<int> counts_of_one_;
  std::vector<float> x_, y_, z_;  // of points, in lattice steps
  WallView view_ = {};
};

void Scene::counts(const std::vector<Point>& points, const std::vector<Pair>& links, std::vector<int>& by_material,
                   const WallKernel& kernel) const {
  if (walls_.empty()) {
    snapped(points);  // which are refused beyond the scene all the same
    by_material.assign(links.size() * static_cast<std::size_t>(materials_), 0);
    return;
  }
  ManyLinks(*this, kernel, points, links, by_material).count();
}

}  // namespace muster::scene
