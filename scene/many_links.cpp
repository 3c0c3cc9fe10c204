// Counts for many links: kernels count the clear cases, and doubtful ones are decided exactly, wall by wall.
#include <algorithm>
#include <cstring>
#include <memory>
#include <numeric>

#include "scene/crossing_link.hpp"
#include "scene/curve.hpp"
#include "scene/far_links.hpp"

namespace muster::scene {
namespace {

// Least number of receivers of one radio for which the walls are transformed to its view.
constexpr std::size_t many = 12;

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

// The nearest point of the extent. Throws std::runtime_error beyond the reach.
Point held_near(const Point& point) {
  if (is_near(point)) return point;
  near_part(point, point);  // throws
  const auto held = [](double metres) { return std::clamp(metres, -extent + 1, extent - 1); };
  return {held(point.x), held(point.y), held(point.z)};
}

// Counting sort by key(item), below `keys`; stable.
template <class Key>
std::vector<std::uint32_t> sorted(const std::vector<std::uint32_t>& items, std::size_t keys, const Key& key) {
  std::vector<std::uint32_t> next(keys + 1, 0), result(items.size());
  for (const std::uint32_t item : items) ++next[key(item) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (const std::uint32_t item : items) result[next[key(item)]++] = item;
  return result;
}

// True if most items are within a block of receivers of their sorted position.
bool nearly_sorted(const std::vector<std::uint32_t>& order) {
  std::size_t displaced = 0;
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    displaced += (order[i] > i ? order[i] - i : i - order[i]) > receivers;
  }
  return displaced * 8 <= order.size();
}

// Links in the order of their senders, and of each sender's receivers, along the curve.
std::vector<std::uint32_t> by_both_ends(const std::vector<std::uint32_t>& order, const std::vector<Pair>& links) {
  std::vector<std::uint32_t> rank(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) rank[order[i]] = i;
  std::vector<std::uint32_t> items(links.size());
  std::iota(items.begin(), items.end(), 0u);
  items = sorted(items, order.size(), [&](std::uint32_t i) { return rank[links[i].to]; });
  return sorted(items, order.size(), [&](std::uint32_t i) { return rank[links[i].from]; });
}

}  // namespace

std::vector<std::uint32_t> spatial_order(const std::vector<Point>& points) {
  std::vector<LatticePoint> places;
  places.reserve(points.size());
  for (const Point& point : points) places.push_back(snapped(held_near(point)));
  return along_curve(places);
}

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
        by_material_(by_material),
        seen_(new SeenBlock[static_cast<std::size_t>(table_.blocks)]),
        unsure_(new std::uint16_t[static_cast<std::size_t>(table_.blocks)]),
        lists_(new int[std::size(view_.lists) * (walls() + block)]),
        doubts_(new Doubt[2 * walls()]),
        counts_(new Counts[static_cast<std::size_t>(scene.materials_)]),
        counts_of_one_(static_cast<std::size_t>(scene.materials_)) {
    by_material_.resize(links.size() * static_cast<std::size_t>(scene.materials_));
    view_.seen = seen_.get();
    view_.unsure = unsure_.get();
    for (std::size_t i = 0; i < std::size(view_.lists); ++i) view_.lists[i] = lists_.get() + i * (walls() + block);
    for (const LatticePoint& point : points_) {
      x_.push_back(static_cast<float>(point.spot.x));
      y_.push_back(static_cast<float>(point.spot.y));
      z_.push_back(static_cast<float>(point.z));
    }
  }

  void count() {
    const bool worth_sorting = links_.size() >= many * points_.size() / 2;
    const auto curve = worth_sorting ? along_curve(points_) : std::vector<std::uint32_t>();
    if (worth_sorting && !nearly_sorted(curve)) sort_by(curve);
    for (std::size_t first = 0, last = 0; first < links_.size(); first = last) {
      last = end_of_sender(first);
      if (worth_sorting && !sorted_ && !ascend(first, last)) {
        sort_by(curve);
        last = 0;  // start again: counting a link twice gives the same counts
        continue;
      }
      count_from(link(first).from, first, last);
    }
  }

 private:
  struct alignas(64) Counts {
    int of[receivers];
  };

  void sort_by(const std::vector<std::uint32_t>& curve) {
    order_ = by_both_ends(curve, links_);
    sorted_ = true;
  }

  void count_from(std::uint32_t from, std::size_t first, std::size_t last) {
    view_.x = x_[from], view_.y = y_[from], view_.z = z_[from];
    if (last - first < many) {
      for (std::size_t i = first; i < last; ++i) count_one(i);
      return;
    }
    look_from(from);
    if (table_.blocks > widest_scene) sort_by_direction(from, first, last);
    shafts_.resize((last - first + receivers - 1) / receivers);
    for (std::size_t i = first; i < last; i += receivers) aim(i, last, shafts_[(i - first) / receivers]);
    for (std::size_t i = first; i < last; i += receivers) count_block(i, last, shafts_[(i - first) / receivers]);
  }

  std::size_t end_of_sender(std::size_t first) const {
    const std::uint32_t from = link(first).from;
    std::size_t last = first + 1;
    for (std::uint32_t others = 0; !sorted_ && last + receivers <= links_.size(); last += receivers) {
      for (std::size_t i = 0; i < receivers; ++i) others |= links_[last + i].from ^ from;
      if (others != 0) break;
    }
    while (last < links_.size() && link(last).from == from) ++last;
    return last;
  }

  // True if a sender's links, and the one after them, ascend in both ends. Row numbers are below 2^31, so a descending
  // pair of neighbours sets the highest bit of the difference.
  bool ascend(std::size_t first, std::size_t last) const {
    std::uint32_t differences = last < links_.size() ? links_[last].from - links_[first].from - 1 : 0;
    for (std::size_t i = first + 1; i < last; ++i) differences |= links_[i].to - links_[i - 1].to - 1;
    return differences >> 31 == 0;
  }

  std::size_t walls() const { return static_cast<std::size_t>(table_.blocks) * block; }
  std::size_t row(std::size_t i) const { return order_.empty() ? i : order_[i]; }
  const Pair& link(std::size_t i) const { return links_[row(i)]; }

  // Sorts the links [first, last) by their direction from the radio, in 256 sectors.
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

  // Material of the wall, or of its door, that the link crosses; -1 if it does not.
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

  // Aims a shaft at the receivers of a block of links from the first on, and before the last.
  void aim(std::size_t first, std::size_t last, Shaft& shaft) {
    const std::uint32_t to = link(first).to;
    if (consecutive(first, last)) {
      kernel_.aim(view_, &x_[to], &y_[to], &z_[to], shaft);
      return;
    }
    float x[receivers], y[receivers], z[receivers];
    for (std::size_t i = 0; i < receivers; ++i) {
      const std::uint32_t each = link(std::min(first + i, last - 1)).to;
      x[i] = x_[each], y[i] = y_[each], z[i] = z_[each];
    }
    kernel_.aim(view_, x, y, z, shaft);
  }

  void count_block(std::size_t first, std::size_t last, const Shaft& shaft) {
    const std::size_t number = std::min<std::size_t>(last - first, receivers);
    fetch_rows(first, number);
    const int doubts = kernel_.count(table_, view_, shaft, counts_.get()->of, doubts_.get());
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
      if (order_.empty() && number == receivers) {
        std::memcpy(out + first, counted, receivers * sizeof *counted);  // a size known at compile time
      } else if (order_.empty()) {
        std::copy_n(counted, number, out + first);
      } else {
        for (std::size_t i = 0; i < number; ++i) out[order_[first + i]] = counted[i];
      }
    }
  }

  // With many links the rows of materials are far apart: prefetches them during the computation.
  void fetch_rows(std::size_t first, std::size_t number) {
    constexpr std::size_t line = 64 / sizeof(int);
    for (int m = 0; m < scene_.materials_ && order_.empty(); ++m) {
      const int* const out = by_material_.data() + static_cast<std::size_t>(m) * links_.size() + first;
      for (std::size_t i = 0; i < number; i += line) __builtin_prefetch(out + i, 1);
    }
  }

  // True for a whole block of consecutive receivers.
  bool consecutive(std::size_t first, std::size_t last) const {
    if (!order_.empty() || last - first < receivers) return false;
    std::uint32_t gaps = 0;
    for (std::uint32_t i = 0; i < receivers; ++i) gaps |= links_[first + i].to - links_[first].to - i;
    return gaps == 0;
  }

  const Scene& scene_;
  const WallKernel& kernel_;
  const WallTable table_;
  const std::vector<LatticePoint> points_;
  const std::vector<Pair>& links_;
  std::vector<std::uint32_t> order_;  // of the links in processing; empty: as given
  bool sorted_ = false;               // if not, later links are processed as given
  struct Directed {
    std::uint32_t direction, link;
  };
  std::vector<Directed> directed_;
  std::vector<Shaft> shafts_;
  std::vector<int>& by_material_;
  // Filled on demand: a few links must not pay for all walls.
  const std::unique_ptr<SeenBlock[]> seen_;
  const std::unique_ptr<std::uint16_t[]> unsure_;
  const std::unique_ptr<int[]> lists_;
  const std::unique_ptr<Doubt[]> doubts_;
  const std::unique_ptr<Counts[]> counts_;
  std::vector<int> counts_of_one_;
  std::vector<float> x_, y_, z_;  // of points, in lattice steps
  WallView view_ = {};
};

// Links with an end beyond the extent become links between two further points, or from a point to itself.
void Scene::counts_of_near_parts(const std::vector<Point>& points, const std::vector<Pair>& links,
                                 std::vector<int>& by_material, const WallKernel& kernel) const {
  std::vector<Point> near = points;
  for (Point& point : near) {
    near_part(point, point);  // throws for points beyond the reach
    if (!is_near(point)) point = {};
  }
  std::vector<Pair> cut = links;
  for (Pair& link : cut) {
    if (is_near(points[link.from]) && is_near(points[link.to])) continue;
    const auto part = near_part(points[link.from], points[link.to]);
    const auto first = static_cast<std::uint32_t>(near.size());
    near.push_back(part ? part->from : Point{});
    near.push_back(part ? part->to : Point{});
    link = {first, first + 1};
  }
  counts(near, cut, by_material, kernel);
}

void Scene::counts(const std::vector<Point>& points, const std::vector<Pair>& links, std::vector<int>& by_material,
                   const WallKernel& kernel) const {
  if (!std::all_of(points.begin(), points.end(), is_near))
    return counts_of_near_parts(points, links, by_material, kernel);
  if (walls_.empty()) {
    by_material.assign(links.size() * static_cast<std::size_t>(materials_), 0);
  } else {
    ManyLinks(*this, kernel, points, links, by_material).count();
  }
  if (floors_.empty()) return;
  std::vector<Vector> places;
  for (const Point& point : points) places.push_back(vector(snapped(point)));
  for (std::size_t i = 0; i < links.size(); ++i) {
    floors_.for_each_crossing(places[links[i].from], places[links[i].to], [&](int, const LatticeFloor& floor) {
      ++by_material[static_cast<std::size_t>(floor.material) * links.size() + i];
    });
  }
}

}  // namespace muster::scene
