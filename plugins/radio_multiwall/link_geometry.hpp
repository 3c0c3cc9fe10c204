// What the terms of a multi-wall channel need of each link: its length and how many walls of each material it crosses.
// Kept from step to step for links, walls and doors that stayed where they were, bit for bit; so asking again under
// other parameters costs a comparison, and a kept answer cannot differ from a new one.
#pragma once

#include <algorithm>
#include <array>
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
    links_.clear();
    materials_ = materials;
    scene_.reset();  // so that none is left if the new one is refused
    scene_ = std::make_unique<scene::Scene>(scene_walls(walls), scene_doors(doors, states, walls),
                                            static_cast<int>(materials));
    return true;
  }

  // How many links were computed anew.
  std::size_t set_links(Rows<const Ends> links, Rows<const Pose> at) {
    links_.resize(links.size());
    counts_.resize(links.size() * materials_);
    const auto back = earlier_reverse(links, at.size());
    New found(at.size());
    for (std::size_t i = 0; i < links.size(); ++i) {
      const auto tx = static_cast<std::size_t>(links[i].tx), rx = static_cast<std::size_t>(links[i].rx);
      const std::array<scene::Point, 2> ends{{{at[tx].x, at[tx].y, at[tx].z}, {at[rx].x, at[rx].y, at[rx].z}}};
      if (links_[i].known && !std::memcmp(&ends, &links_[i].ends, sizeof ends)) continue;
      links_[i] = {ends, 0, false};  // so that no old answer is left if a point is refused
      (back[i] != no_link ? found.reverse : found.forth).push_back(i);
      if (back[i] == no_link) found.pairs.push_back({found.place(tx, ends[0]), found.place(rx, ends[1])});
    }
    std::vector<int> counted;
    scene_->counts(found.points, found.pairs, counted);
    for (std::size_t k = 0; k < found.forth.size(); ++k) {
      const std::size_t i = found.forth[k];
      for (std::size_t m = 0; m < materials_; ++m) counts_[i * materials_ + m] = counted[m * found.forth.size() + k];
      links_[i] = {links_[i].ends, log_distance(links_[i].ends[0], links_[i].ends[1]), true};
    }
    for (const std::size_t i : found.reverse) {  // counted already, the other way
      std::copy_n(counts(back[i]), materials_, counts_.data() + i * materials_);
      links_[i] = {links_[i].ends, links_[back[i]].log_distance, true};
    }
    return found.forth.size();
  }

  // log10 of the length in metres, which is taken as at least 1 cm: nearer, no far field has formed.
  double log_distance(std::size_t link) const { return links_[link].log_distance; }
  // Walls crossed, by material.
  const int* counts(std::size_t link) const { return counts_.data() + link * materials_; }

 private:
  struct Link {
    std::array<scene::Point, 2> ends;
    double log_distance = 0;
    bool known = false;
  };

  // Links that moved, those that an earlier link already runs along the other way, and the places that matter.
  struct New {
    explicit New(std::size_t endpoints) : places(endpoints, no_link) {}

    std::uint32_t place(std::size_t endpoint, const scene::Point& at) {
      if (places[endpoint] == no_link) {
        places[endpoint] = static_cast<std::uint32_t>(points.size());
        points.push_back(at);
      }
      return places[endpoint];
    }

    std::vector<std::uint32_t> places;
    std::vector<scene::Point> points;
    std::vector<scene::Pair> pairs;
    std::vector<std::size_t> forth, reverse;
  };

  static double log_distance(const scene::Point& p, const scene::Point& q) {
    const double x = p.x - q.x, y = p.y - q.y, z = p.z - q.z;
    return std::log10(std::max(std::sqrt(x * x + y * y + z * z), 0.01));
  }

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
  std::vector<Link> links_;
  std::vector<int> counts_;
};

}  // namespace muster
