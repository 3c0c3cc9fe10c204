// Another channel: the level falls by so many dB a metre, whatever stands between.
#include <cmath>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct TestSlope {
  static constexpr auto id = "test.slope/1";
  static constexpr auto summary = "level = -30 dBm - slope x distance";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {real("slope", 1.5, 0, 100, "dB/m", "loss of a metre")};

  explicit TestSlope(Setup& s)
      : slope(s.value("slope")),
        pose(s.read<Pose>("endpoint/*/pose")),
        ends(s.read<Ends>("link/*/ends")),
        level(s.add<Level>("link/*/level")) {}

  void step(const Step& k) const {
    for (std::size_t i = 0; i < k[level].size(); ++i) {
      const Pose& a = k[pose][static_cast<std::size_t>(k[ends][i].tx)];
      const Pose& b = k[pose][static_cast<std::size_t>(k[ends][i].rx)];
      k[level][i].level = -30 - k[slope] * std::hypot(a.x - b.x, a.y - b.y);
    }
  }

  Value slope;
  In<Pose> pose;
  In<Ends> ends;
  Out<Level> level;
};

}  // namespace

MUSTER_PLUGIN_IS(TestSlope)
