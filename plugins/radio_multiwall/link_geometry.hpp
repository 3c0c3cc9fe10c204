// Inputs of a multi-wall channel for each link: its length, and the numbers of walls and floors of each material that
// it crosses. Cached from step to step while links, walls, doors and floors are unchanged, bit for bit: an evaluation
// with other parameters costs a comparison, and a cached result equals a new one.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <muster/logarithm.hpp>
#include <muster/plugin.hpp>
#include <muster/reverse_links.hpp>
#include <scene/walls.hpp>
#include <utility>
#include <vector>

#include "plugins/scene_rows.hpp"

namespace muster {

class LinkGeometry {
 public:
  // True if walls, doors or floors have changed.
  bool set_scene(Rows<const Wall> walls, Rows<const Door> doors, Rows<const DoorState> states,
                 Rows<const FloorShape> floors, std::size_t materials) {
    bool changed = keep(walls, walls_);
    changed = keep(doors, doors_) || changed;
    changed = keep(floors, floors_) || changed;
    changed = keep(states, states_) || changed || !scene_ || materials != materials_;
    if (!changed) return false;
    at_.clear();
    materials_ = materials;
    scene_.reset();  // so that none is left if the new one throws
    scene_ = std::make_unique<scene::Scene>(scene_walls(walls), scene_doors(doors, states, walls),
                                            static_cast<int>(materials), scene_floors(floors));
    return true;
  }

  // Returns the number of pairs computed anew: links that run both ways are one pair.
  std::size_t set_links(Rows<const Ends> links, Rows<const Pose> at) {
    if (!are_listed(links) || at.size() != endpoints_ || !are_together(at)) order_.clear();
    endpoints_ = at.size();
    if (order_.empty()) number(links, at);
    std::vector<scene::Point> now = in_order(at);
    const std::vector<char> moved = which_moved(now);
    const bool all = std::find(moved.begin(), moved.end(), 0) == moved.end();
    if (all && !walls_.empty() && !scene::in_spatial_order(now)) {
      number(links, at);
      now = in_order(at);
    }
    at_.clear();  // so that no old result is left if a point is refused
    const std::size_t measured = all ? measure_all(now) : measure_moved(now, moved);
    if (measured > 0 || links.empty()) measure_lengths(at);
    at_ = std::move(now);
    return measured;
  }

  // For each link, log10 of the length in metres, taken as at least 1 cm: nearer, no far field has formed.
  const std::vector<double>& log_distances() const { return log_distances_; }
  // The pair of a link.
  std::size_t pair(std::size_t link) const { return pair_[link]; }
  // For each pair, the number of walls and floors of a material that it crosses.
  const int* counts(std::size_t material) const { return counts_.data() + material * pairs_.size(); }

  // For each pair, the sum over materials of its crossings times the loss of one.
  void wall_losses(const std::vector<double>& losses, std::vector<double>& out) const {
    constexpr std::size_t block = 1024;  // pairs whose sums stay in cache during the loop over materials
    out.assign(pairs_.size(), 0);
    for (std::size_t first = 0; first < out.size(); first += block) {
      const std::size_t number = std::min(block, out.size() - first);
      for (std::size_t m = 0; m < losses.size(); ++m) {
        Widest<AddLosses, const int*, double, double*, std::size_t>::run(counts(m) + first, losses[m], &out[first],
                                                                         number);
      }
    }
  }

 private:
  // From one end to consecutive ends.
  struct Run {
    std::uint32_t from, to, number;
  };

  static std::vector<Run> in_runs(Rows<const Ends> links) {
    std::vector<Run> result;
    for (const Ends& link : links) {
      const auto from = static_cast<std::uint32_t>(link.tx), to = static_cast<std::uint32_t>(link.rx);
      if (result.empty() || from != result.back().from || to != result.back().to + result.back().number) {
        result.push_back({from, to, 0});
      }
      ++result.back().number;
    }
    return result;
  }

  // True if links are those that are numbered.
  bool are_listed(Rows<const Ends> links) const {
    if (links.size() != pair_.size()) return false;
    const Ends* first = links.begin();
    for (const auto& [from, to, number] : listed_) {
      if (!run_on(first, number, from, to)) return false;
      first += number;
    }
    return true;
  }

  // True if endpoints that shared a place still do.
  bool are_together(Rows<const Pose> at) const {
    return std::all_of(together_.begin(), together_.end(),
                       [&](const auto& two) { return same(point_of(at[two.first]), point_of(at[two.second])); });
  }

  static scene::Point point_of(const Pose& p) { return {p.x, p.y, p.z}; }
  static bool same(const scene::Point& a, const scene::Point& b) { return !std::memcmp(&a, &b, sizeof a); }

  // Sorts the endpoints that have links in spatial order, and numbers pairs by it, so that results of neighbours are
  // adjacent. Endpoints at one point share a place, as for a stationary radio with one endpoint per measured link. A
  // pair runs from the place that has more links.
  void number(Rows<const Ends> links, Rows<const Pose> at) {
    at_.clear();
    order_.clear();
    together_.clear();
    const auto used = with_links(links, at.size());
    std::vector<scene::Point> points;
    for (const std::uint32_t end : used) points.push_back(point_of(at[end]));
    std::vector<std::uint32_t> place(at.size());
    for (const std::uint32_t i : scene::spatial_order(points)) {
      if (!order_.empty() && same(points[i], point_of(at[order_.back()]))) {
        together_.emplace_back(order_.back(), used[i]);
      } else {
        order_.push_back(used[i]);
      }
      place[used[i]] = static_cast<std::uint32_t>(order_.size() - 1);
    }
    const auto back = earlier_reverse(links, at.size());
    std::vector<std::uint32_t> partners(order_.size());
    for (const Ends& link : links) {
      for (const double end : {link.tx, link.rx}) ++partners[place[static_cast<std::size_t>(end)]];
    }
    std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted;  // places of both ends, link
    for (std::uint32_t i = 0; i < links.size(); ++i) {
      if (back[i] != no_link) continue;
      const std::uint64_t tx = place[static_cast<std::size_t>(links[i].tx)];
      const std::uint64_t rx = place[static_cast<std::size_t>(links[i].rx)];
      const bool turned = std::pair(partners[rx], tx) > std::pair(partners[tx], rx);
      sorted.emplace_back(turned ? rx << 32 | tx : tx << 32 | rx, i);
    }
    std::sort(sorted.begin(), sorted.end());
    pairs_.clear();
    pair_.resize(links.size());
    for (const auto& [places, link] : sorted) {
      pair_[link] = static_cast<std::uint32_t>(pairs_.size());
      pairs_.push_back({static_cast<std::uint32_t>(places >> 32), static_cast<std::uint32_t>(places)});
    }
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (back[i] != no_link) pair_[i] = pair_[back[i]];
    }
    listed_ = in_runs(links);
  }

  static std::vector<std::uint32_t> with_links(Rows<const Ends> links, std::size_t endpoints) {
    std::vector<char> has_links(endpoints, 0);
    for (const Ends& link : links) {
      has_links[static_cast<std::size_t>(link.tx)] = has_links[static_cast<std::size_t>(link.rx)] = 1;
    }
    std::vector<std::uint32_t> result;
    for (std::uint32_t end = 0; end < endpoints; ++end) {
      if (has_links[end]) result.push_back(end);
    }
    return result;
  }

  std::vector<scene::Point> in_order(Rows<const Pose> at) const {
    std::vector<scene::Point> result;
    result.reserve(order_.size());
    for (const std::uint32_t end : order_) result.push_back(point_of(at[end]));
    return result;
  }

  // For each place, whether its endpoint has moved.
  std::vector<char> which_moved(const std::vector<scene::Point>& now) const {
    std::vector<char> moved(now.size(), 1);
    for (std::size_t i = 0; i < now.size() && at_.size() == now.size(); ++i) {
      moved[i] = !same(now[i], at_[i]);
    }
    return moved;
  }

  std::size_t measure_all(const std::vector<scene::Point>& now) {
    scene_->counts(now, pairs_, counts_);
    return pairs_.size();
  }

  std::size_t measure_moved(const std::vector<scene::Point>& now, const std::vector<char>& moved) {
    std::vector<scene::Pair> some;
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      if (moved[pairs_[i].from] == 0 && moved[pairs_[i].to] == 0) continue;
      some.push_back(pairs_[i]);
      numbers.push_back(i);
    }
    std::vector<int> counted;
    scene_->counts(now, some, counted);
    for (std::size_t k = 0; k < some.size(); ++k) {
      for (std::size_t m = 0; m < materials_; ++m) {
        counts_[m * pairs_.size() + numbers[k]] = counted[m * some.size() + k];
      }
    }
    return some.size();
  }

  void measure_lengths(Rows<const Pose> at) {
    log_distances_.resize(pair_.size());
    std::array<std::vector<double>, 3> place;
    for (auto& axis : place) axis.reserve(at.size());
    for (const Pose& p : at) place[0].push_back(p.x), place[1].push_back(p.y), place[2].push_back(p.z);
    constexpr std::size_t worth_a_call = 8;  // least number of links for a batch call
    if (listed_.size() * worth_a_call > pair_.size()) return measure_lengths_one_by_one(place);
    double* out = log_distances_.data();
    for (const auto& [from, to, number] : listed_) {
      const double own[] = {place[0][from], place[1][from], place[2][from]};
      log_lengths(own, {&place[0][to], &place[1][to], &place[2][to]}, out, number);
      out += number;
    }
  }

  void measure_lengths_one_by_one(const std::array<std::vector<double>, 3>& place) {
    std::array<std::vector<double>, 3> apart;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      apart[axis].reserve(pair_.size());
      for (const auto& [from, to, number] : listed_) {
        for (std::uint32_t i = 0; i < number; ++i) apart[axis].push_back(place[axis][to + i] - place[axis][from]);
      }
    }
    constexpr double nowhere[] = {0, 0, 0};
    log_lengths(nowhere, {apart[0].data(), apart[1].data(), apart[2].data()}, log_distances_.data(), pair_.size());
  }

  static void log_lengths(const double* own, const std::array<const double*, 3>& others, double* out,
                          std::size_t number) {
    Widest<LogLengths, const double*, const double* const*, double*, std::size_t>::run(own, others.data(), out, number);
  }

  struct AddLosses {
    [[gnu::always_inline]] static void run(const int* counts, double loss, double* sums, std::size_t number) {
      for (std::size_t i = 0; i < number; ++i) sums[i] += counts[i] * loss;
    }
  };

  // The same bits both ways: differences only change sign.
  struct LogLengths {
    [[gnu::always_inline]] static double of(double x, double y, double z) {
      const double squared = x * x + y * y + z * z;
      return 0.5 * Log10::of(squared > 1e-4 ? squared : 1e-4);
    }
    [[gnu::always_inline]] static void run(const double* own, const double* const* others, double* out,
                                           std::size_t number) {
      const double x = own[0], y = own[1], z = own[2];
      const double *const to_x = others[0], *const to_y = others[1], *const to_z = others[2];
      for (std::size_t i = 0; i < number; ++i) out[i] = of(to_x[i] - x, to_y[i] - y, to_z[i] - z);
    }
  };

  // True if the rows differ from the kept ones, which they then replace.
  template <class Row>
  static bool keep(Rows<const Row> now, std::vector<Row>& kept) {
    if (now.size() == kept.size() && (now.empty() || !std::memcmp(now.begin(), kept.data(), now.size() * sizeof(Row))))
      return false;
    kept.assign(now.begin(), now.end());
    return true;
  }

  std::vector<Wall> walls_;
  std::vector<Door> doors_;
  std::vector<DoorState> states_;
  std::vector<FloorShape> floors_;
  std::size_t materials_ = 0;
  std::unique_ptr<scene::Scene> scene_;
  std::size_t endpoints_ = 0;
  std::vector<std::uint32_t> order_;  // an endpoint with links, for each place; empty if not numbered
  std::vector<std::pair<std::uint32_t, std::uint32_t>> together_;  // endpoints: that of a place, another one there
  std::vector<scene::Point> at_;                                   // last positions; empty if unknown
  std::vector<scene::Pair> pairs_;                                 // of places
  std::vector<Run> listed_;                                        // links, by endpoints
  std::vector<std::uint32_t> pair_;                                // of each link
  std::vector<double> log_distances_;
  std::vector<int> counts_;  // material by material
};

}  // namespace muster
