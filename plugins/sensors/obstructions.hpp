// Walls, closed doors and floors between two places, for waves that go straight.
#pragma once

#include <muster/floors.hpp>
#include <muster/plugin.hpp>
#include <vector>

#include "plugins/scene_rows.hpp"
#include "scene/walls.hpp"

namespace muster {

class Obstructions {
 public:
  explicit Obstructions(Setup& s)
      : wall_(s.read<Wall>("wall/*/shape")),
        door_(s.read<Door>("door/*/shape")),
        state_(s.read<DoorState>("door/*/state")),
        floor_(s.read<FloorShape>("floor/*/shape")),
        loss_(s.read<Loss>("material/*/loss")) {}

  // What a straight way crosses: how many, and the sum of their losses [dB].
  struct Crossed {
    int number = 0;
    double loss = 0;
  };

  // As they stand in a step.
  class Now {
   public:
    Now(const Obstructions& of, const Step& k)
        : losses_(k[of.loss_]),
          scene_(scene_walls(k[of.wall_]), scene_doors(k[of.door_], k[of.state_], k[of.wall_]),
                 static_cast<int>(losses_.size()), scene_floors(k[of.floor_])),
          is_open_(k[of.wall_].empty() && k[of.floor_].empty()) {}

    Crossed between(const scene::Point& from, const scene::Point& to) {
      Crossed result;
      if (is_open_) return result;
      scene_.crossings(from, to, crossings_);
      for (const scene::Crossing& crossing : crossings_) {
        ++result.number;
        result.loss += losses_[static_cast<std::size_t>(crossing.material)].loss;
      }
      return result;
    }

   private:
    Rows<const Loss> losses_;
    scene::Scene scene_;
    bool is_open_;
    std::vector<scene::Crossing> crossings_;
  };

 private:
  In<Wall> wall_;
  In<Door> door_;
  In<DoorState> state_;
  In<FloorShape> floor_;
  In<Loss> loss_;
};

}  // namespace muster
