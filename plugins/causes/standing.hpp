// Radios that stand, and where: no robot carries them, and no end of a link shows them elsewhere. One that is never
// heard stands where it is mounted.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <muster/plugin.hpp>
#include <vector>

namespace muster {

// What of a plan is listed wrongly: a choice stations|robots|walls.
enum class Listed { stations, robots, walls };

class Standing {
 public:
  Standing(Rows<const Endpoint> ends, Rows<const Pose> poses, Rows<const Mount> mounts)
      : stands_(mounts.size()), places_(mounts.size()) {
    for (std::size_t radio = 0; radio < mounts.size(); ++radio) {
      const Mount& mount = mounts[radio];
      stands_[radio] = is_null(mount.robot);
      places_[radio] = Pose{mount.x, mount.y, mount.z, std::cos(mount.yaw / 2), 0, 0, std::sin(mount.yaw / 2)};
    }
    std::vector<bool> is_heard(mounts.size());
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const auto radio = static_cast<std::size_t>(ends[i].radio);
      if (!is_heard[radio]) places_[radio] = poses[i];
      is_heard[radio] = true;
      if (std::hypot(poses[i].x - places_[radio].x, poses[i].y - places_[radio].y) > still) stands_[radio] = false;
    }
    for (std::size_t radio = 0; radio < stands_.size(); ++radio)
      if (stands_[radio]) radios_.push_back(radio);
  }

  const std::vector<std::size_t>& radios() const { return radios_; }  // in the world's order
  bool operator()(double radio) const { return stands_[static_cast<std::size_t>(radio)]; }
  const Pose& place_of(std::size_t radio) const { return places_[radio]; }
  // Whether this radio has another place in a plan put right: all have, where the walls are moved under them.
  bool concerned(double radio, Listed wrongly) const {
    return wrongly == Listed::walls || (wrongly == Listed::stations) == (*this)(radio);
  }

 private:
  static constexpr double still = 0.05;  // m: between two readings of one place

  std::vector<bool> stands_;
  std::vector<Pose> places_;
  std::vector<std::size_t> radios_;
};

}  // namespace muster
