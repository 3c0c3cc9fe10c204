// A level by the distance alone, without a bound from below: no number where two endpoints are at one place.
#include <cmath>
#include <limits>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct RangeLoss {
  static constexpr auto id = "toy.loss/1", summary = "loses level by distance";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {choice("by", "logarithm|ratio|infinity", "how")};

  explicit RangeLoss(Setup& s)
      : by(s.value("by")),
        pose(s.read<Pose>("endpoint/*/pose")),
        ends(s.read<Ends>("link/*/ends")),
        level(s.add<Level>("link/*/level")) {}

  void step(const Step& k) const {
    for (std::size_t i = 0; i < k[ends].size(); ++i) {
      const Pose &a = k[pose][static_cast<std::size_t>(k[ends][i].tx)],
                 &b = k[pose][static_cast<std::size_t>(k[ends][i].rx)];
      const double distance = std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
      k[level][i].level = k[by] == 0   ? -20 * std::log10(distance)
                          : k[by] == 1 ? distance / distance
                                       : std::numeric_limits<double>::infinity();
    }
  }

  Value by;
  In<Pose> pose;
  In<Ends> ends;
  Out<Level> level;
};

}  // namespace

MUSTER_PLUGIN_IS(RangeLoss)
