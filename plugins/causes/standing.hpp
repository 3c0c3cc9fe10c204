// Radios that stand, and where: of all ends of links, those whose radio no robot carries and that never move.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <muster/plugin.hpp>
#include <vector>

namespace muster {

class Standing {
 public:
  Standing(Rows<const Endpoint> ends, Rows<const Pose> poses, Rows<const Mount> mounts)
      : first_(mounts.size(), nowhere) {
    std::vector<bool> moves(mounts.size());
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const auto radio = static_cast<std::size_t>(ends[i].radio);
      if (first_[radio] == nowhere) first_[radio] = i;
      const Pose &here = poses[i], &there = poses[first_[radio]];
      if (!is_null(mounts[radio].robot) || std::hypot(here.x - there.x, here.y - there.y) > still) moves[radio] = true;
    }
    for (std::size_t radio = 0; radio < moves.size(); ++radio) {
      if (moves[radio]) first_[radio] = nowhere;
      if (first_[radio] != nowhere) radios_.push_back(radio);
    }
  }

  const std::vector<std::size_t>& radios() const { return radios_; }  // in the world's order
  bool operator()(double radio) const { return first_[static_cast<std::size_t>(radio)] != nowhere; }
  // Row of the first end of a radio that stands.
  std::size_t end_of(std::size_t radio) const { return first_[radio]; }

 private:
  static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);
  static constexpr double still = 0.05;  // m: between two readings of one place

  std::vector<std::size_t> first_, radios_;
};

}  // namespace muster
