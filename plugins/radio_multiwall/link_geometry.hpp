// What the terms of a multi-wall channel need of each link: its length and how many walls and floors of each material
// it crosses. Kept from step to step for links, walls, doors and floors that stayed where they were, bit for bit; so
// asking again under other parameters costs a comparison, and a kept answer cannot differ from a new one.
#pragma once

#include <algorithm>
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
  // True if walls, doors or floors are not what they were.
  bool set_scene(Rows<const Wall> walls, Rows<const Door> doors, Rows<const DoorState> states,
                 Rows<const FloorShape> floors, std::size_t materials) {
    bool changed = keep(walls, walls_);
    changed = keep(doors, doors_) || changed;
    changed = keep(floors, floors_) || changed;
    changed = keep(states, states_) || changed || !scene_ || materials != materials_;
    if (!changed) return false;
    at_.clear();
    materials_ = materials;
    scene_.reset();  // so that none is left if the new one is refused
    scene_ = std::make_unique<scene::Scene>(scene_walls(walls), scene_doors(doors, states, walls),
                                            static_cast<int>(materials), scene_floors(floors));
    return true;
  }

  // How many pairs were computed anew: links that run both ways are one pair.
  std::size_t set_links(Rows<const Ends> links, Rows<const Pose> at) {
    if (!are_listed(links) || at.size() != endpoints_) order_.clear();
    endpoints_ = at.size();
    if (order_.empty()) number(links, at);
    std::vector<scene::Point> now = in_order(at);
    const std::vector<char> moved = which_moved(now);
    const bool all = std::find(moved.begin(), moved.end(), 0) == moved.end();
    if (all && !walls_.empty() && !scene::in_spatial_order(now)) {
      number(links, at);
      now = in_order(at);
    }
    at_.clear();  // so that no old answer is left if a point is refused
    const std::size_t measured = all ? measure_all(now) : measure_moved(now, moved);
    if (measured > 0 || links.empty()) measure_lengths(at);
    at_ = std::move(now);
    return measured;
  }

  // Of each link, log10 of the length in metres, which is taken as at least 1 cm: nearer, no far field has formed.
  const std::vector<double>& log_distances() const { return log_distances_; }
  // The pair that it belongs to.
  std::size_t pair(std::size_t link) const { return pair_[link]; }
  // Of each pair, how many walls and floors of a material it crosses.
  const int* counts(std::size_t material) const { return counts_.data() + material * pairs_.size(); }

  // Of each pair, the sum over materials of its crossings times the loss of one.
  void wall_losses(const std::vector<double>& losses, std::vector<double>& out) const {
    constexpr std::size_t block = 1024;  // pairs whose sums stay near while materials are gone through
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
  // From one end to ends that follow one another.
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

  // Whether links are those that are numbered.
  bool are_listed(Rows<const Ends> links) const {
    if (links.size() != pair_.size()) return false;
    const Ends* first = links.begin();
    for (const auto& [from, to, number] : listed_) {
      if (!run_on(first, number, from, to)) return false;
      first += number;
    }
    return true;
  }

  // Gives those endpoints that have links their places in spatial order, and numbers pairs by them: what is computed
  // for neighbours then lies side by side.
  void number(Rows<const Ends> links, Rows<const Pose> at) {
    at_.clear();
    order_.clear();
    const auto used = with_links(links, at.size());
    std::vector<scene::Point> points;
    for (const std::uint32_t end : used) points.push_back({at[end].x, at[end].y, at[end].z});
    std::vector<std::uint32_t> place(at.size());
    for (const std::uint32_t i : scene::spatial_order(points)) {
      place[used[i]] = static_cast<std::uint32_t>(order_.size());
      order_.push_back(used[i]);
    }
    const auto back = earlier_reverse(links, at.size());
    std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted;  // places of both ends, link
    for (std::uint32_t i = 0; i < links.size(); ++i) {
      if (back[i] != no_link) continue;
      const std::uint64_t tx = place[static_cast<std::size_t>(links[i].tx)];
      const std::uint64_t rx = place[static_cast<std::size_t>(links[i].rx)];
      sorted.emplace_back(std::min(tx, rx) << 32 | std::max(tx, rx), i);
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
    for (const std::uint32_t end : order_) result.push_back({at[end].x, at[end].y, at[end].z});
    return result;
  }

  // Of each place, whether somebody is there who was not.
  std::vector<char> which_moved(const std::vector<scene::Point>& now) const {
    std::vector<char> moved(now.size(), 1);
    for (std::size_t i = 0; i < now.size() && at_.size() == now.size(); ++i) {
      moved[i] = std::memcmp(&now[i], &at_[i], sizeof now[i]) != 0;
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
    std::vector<double> x, y, z;
    for (const Pose& p : at) x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
    double* out = log_distances_.data();
    for (const auto& [from, to, number] : listed_) {
      const double own[] = {x[from], y[from], z[from]}, *const others[] = {&x[to], &y[to], &z[to]};
      Widest<LogLengths, const double*, const double* const*, double*, std::size_t>::run(own, others, out, number);
      out += number;
    }
  }

  struct AddLosses {
    [[gnu::always_inline]] static void run(const int* counts, double loss, double* sums, std::size_t number) {
      for (std::size_t i = 0; i < number; ++i) sums[i] += counts[i] * loss;
    }
  };

  // The same bits both ways: differences change their sign alone.
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

  // True if the rows are not those that are kept, which they then are.
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
  std::vector<std::uint32_t> order_;  // endpoints that have links, by place; empty if they are not numbered
  std::vector<scene::Point> at_;      // where they were; empty if nothing is known
  std::vector<scene::Pair> pairs_;    // of places
  std::vector<Run> listed_;           // links, by endpoints
  std::vector<std::uint32_t> pair_;   // of each link
  std::vector<double> log_distances_;
  std::vector<int> counts_;  // material by material
};

}  // namespace muster
