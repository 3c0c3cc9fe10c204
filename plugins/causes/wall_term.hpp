// Contribution of a cause to the level of links for each wall or closed door that they cross.
#pragma once

#include <array>
#include <cstring>
#include <memory>
#include <muster/plugin.hpp>
#include <optional>
#include <scene/walls.hpp>
#include <stdexcept>
#include <vector>

#include "plugins/scene_rows.hpp"

namespace muster {

class WallTerm {
 public:
  // For all walls, or for one row only.
  explicit WallTerm(Setup& s, std::optional<Value> only = std::nullopt)
      : only_(only),
        pose(s.read<Pose>("endpoint/*/pose")),
        ends(s.read<Ends>("link/*/ends")),
        wall(s.read<Wall>("wall/*/shape")),
        door(s.read<Door>("door/*/shape")),
        state(s.read<DoorState>("door/*/state")),
        loss(s.read<Loss>("material/*/loss")),
        level(s.add<Level>("link/*/level")) {}

  // term(crossing, loss of what is crossed) is in dB.
  template <class Term>
  void add(const Step& k, const Term& term) {
    try {
      update_scene(k);
      update_links(k);
    } catch (const std::runtime_error& e) {  // throws for walls, doors and places, which are the user's input
      throw BadInput(e.what());
    }
    const auto losses = k[loss];
    const auto out = k[level];
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i].level = 0;
      for (const auto& crossing : links_[i].crossings) {
        out[i].level += term(crossing, losses[static_cast<std::size_t>(crossing.material)].loss);
      }
    }
  }

 private:
  // Crossings are cached while ends, walls and doors stay the same, bit for bit: an evaluation with other parameters
  // costs a comparison.
  struct Link {
    std::array<scene::Point, 2> ends;
    std::vector<scene::Crossing> crossings;
    bool known = false;
  };

  template <class Row>
  static bool keep(Rows<const Row> now, std::vector<Row>& kept) {
    if (now.size() == kept.size() && (now.empty() || !std::memcmp(now.begin(), kept.data(), now.size() * sizeof(Row))))
      return false;
    kept.assign(now.begin(), now.end());
    return true;
  }

  void update_scene(const Step& k) {
    bool changed = keep(k[wall], walls_);
    changed = keep(k[door], doors_) || changed;
    changed = keep(k[state], states_) || changed;
    if (!changed && scene_) return;
    links_.clear();
    scene_.reset();  // so that none is left if the new one throws
    const auto walls = scene_walls(walls_);
    const auto doors = scene_doors(doors_, states_, walls_);
    const int materials = static_cast<int>(k[loss].size());
    scene_ = std::make_unique<scene::Scene>(walls, doors, materials);
    if (!only_) return;
    // Crossings of one wall do not depend on others.
    const int row = static_cast<int>(k[*only_]);
    std::vector<scene::Door> own;
    for (const scene::Door& d : doors) {
      if (d.wall != row) continue;
      own.push_back(d);
      own.back().wall = 0;
    }
    scene_ = std::make_unique<scene::Scene>(std::vector{walls[static_cast<std::size_t>(row)]}, own, materials);
  }

  void update_links(const Step& k) {
    const auto at = k[pose];
    const auto links = k[ends];
    links_.resize(links.size());
    for (std::size_t i = 0; i < links.size(); ++i) {
      const Pose& a = at[static_cast<std::size_t>(links[i].tx)];
      const Pose& b = at[static_cast<std::size_t>(links[i].rx)];
      const std::array<scene::Point, 2> now{{{a.x, a.y, a.z}, {b.x, b.y, b.z}}};
      if (links_[i].known && !std::memcmp(&now, &links_[i].ends, sizeof now)) continue;
      links_[i].known = false;
      scene_->crossings(now[0], now[1], links_[i].crossings);
      links_[i].ends = now;
      links_[i].known = true;
    }
  }

  std::optional<Value> only_;
  In<Pose> pose;
  In<Ends> ends;
  In<Wall> wall;
  In<Door> door;
  In<DoorState> state;
  In<Loss> loss;
  Out<Level> level;
  std::vector<Wall> walls_;
  std::vector<Door> doors_;
  std::vector<DoorState> states_;
  std::unique_ptr<scene::Scene> scene_;
  std::vector<Link> links_;
};

}  // namespace muster
