// What the terms of a multi-wall channel need of each link: its length and how many walls of each material it crosses.
// Kept from step to step for links, walls and doors that stayed where they were, bit for bit; so asking again under
// other parameters costs a comparison, and a kept answer cannot differ from a new one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <muster/plugin.hpp>
#include <muster/reverse_links.hpp>
#include <scene/walls.hpp>
#include <vector>

#include "plugins/scene_rows.hpp"

namespace muster {

class LinkGeometry {
 public:
  // True if walls or doors are not what they were.
  bool set_scene(Rows<const Wall> walls, Rows<const Door> doors, Rows<const DoorState> states, std::size_t materials) {
    bool changed = keep(walls, walls_);
    changed = keep(doors, doors_) || changed;
    changed = keep(states, states_) || changed || !scene_ || materials != materials_;
    if (!changed) return false;
    at_.clear();
    materials_ = materials;
    scene_.reset();  // so that none is left if the new one is refused
    scene_ = std::make_unique<scene::Scene>(scene_walls(walls), scene_doors(doors, states, walls),
                                            static_cast<int>(materials));
    return true;
  }

  // How many links were computed anew: links that run both ways are one.
  std::size_t set_links(Rows<const Ends> links, Rows<const Pose> at) {
    if (keep(links, ends_)) {
      at_.clear();
      number(links, at.size());
    }
    std::vector<scene::Point> now;
    for (const Pose& pose : at) now.push_back({pose.x, pose.y, pose.z});
    find_moved(now);
    at_.clear();  // so that no old answer is left if a point is refused
    scene_->counts(moved_.points, moved_.pairs, counted_);
    log_distances_.resize(slots_);
    counts_.resize(slots_ * materials_);
    for (std::size_t k = 0; k < moved_.pairs.size(); ++k) {
      log_distances_[moved_.slots[k]] =
          log_distance(moved_.points[moved_.pairs[k].from], moved_.points[moved_.pairs[k].to]);
    }
    for (std::size_t m = 0; m < materials_; ++m) {
      const int* const of_material = counted_.data() + m * moved_.pairs.size();
      for (std::size_t k = 0; k < moved_.pairs.size(); ++k) counts_[m * slots_ + moved_.slots[k]] = of_material[k];
    }
    at_ = std::move(now);
    return moved_.pairs.size();
  }

  // log10 of the length in metres, which is taken as at least 1 cm: nearer, no far field has formed.
  double log_distance(std::size_t link) const { return log_distances_[slot_[link]]; }
  // How many walls of a material it crosses.
  int count(std::size_t link, std::size_t material) const { return counts_[material * slots_ + slot_[link]]; }

 private:
  // The links to compute anew, each as a pair of the points that they need.
  struct Moved {
    std::vector<scene::Point> points;
    std::vector<scene::Pair> pairs;
    std::vector<std::uint32_t> slots;
  };

  // Links that run both ways share a slot for what is computed.
  void number(Rows<const Ends> links, std::size_t endpoints) {
    const auto back = earlier_reverse(links, endpoints);
    slot_.resize(links.size());
    slots_ = 0;
    for (std::size_t i = 0; i < links.size(); ++i) {
      slot_[i] = back[i] != no_link ? slot_[back[i]] : static_cast<std::uint32_t>(slots_++);
    }
  }

  void find_moved(const std::vector<scene::Point>& now) {
    std::vector<char> moved(now.size(), 1);
    for (std::size_t i = 0; i < now.size() && at_.size() == now.size(); ++i) {
      moved[i] = std::memcmp(&now[i], &at_[i], sizeof now[i]) != 0;
    }
    moved_.points.clear();
    moved_.pairs.clear();
    moved_.slots.clear();
    std::vector<std::uint32_t> place(now.size(), no_link);
    const auto place_of = [&](std::size_t end) {
      if (place[end] == no_link) {
        place[end] = static_cast<std::uint32_t>(moved_.points.size());
        moved_.points.push_back(now[end]);
      }
      return place[end];
    };
    std::uint32_t next = 0;  // the slot that the first of its links meets
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      if (slot_[i] != next) continue;
      ++next;
      const auto tx = static_cast<std::size_t>(ends_[i].tx), rx = static_cast<std::size_t>(ends_[i].rx);
      if (!moved[tx] && !moved[rx]) continue;
      const std::uint32_t from = place_of(tx);
      moved_.pairs.push_back({from, place_of(rx)});
      moved_.slots.push_back(slot_[i]);
    }
  }

  static double log_distance(const scene::Point& p, const scene::Point& q) {
    const double x = p.x - q.x, y = p.y - q.y, z = p.z - q.z;
    return std::log10(std::max(std::sqrt(x * x + y * y + z * z), 0.01));
  }

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
  std::size_t materials_ = 0;
  std::unique_ptr<scene::Scene> scene_;
  std::vector<Ends> ends_;
  std::vector<scene::Point> at_;  // where ends were; empty if nothing is known
  std::vector<std::uint32_t> slot_;
  std::size_t slots_ = 0;
  std::vector<double> log_distances_;
  std::vector<int> counts_;  // material by material
  Moved moved_;
  std::vector<int> counted_;
};

}  // namespace muster
