// Mean received level by the one-slope law: a whole environment in two numbers.
#include <cmath>
#include <muster/plugin.hpp>
using namespace muster;

struct OneSlope {
  static constexpr auto id = "radio.one_slope/1", summary = "mean level from distance alone";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {real("l0", 40, 0, 150, "dB", "loss at 1 m").free(),
                                     real("n", 2, 0, 10, "", "path-loss exponent").free()};
  explicit OneSlope(Setup& s)
      : l0(s.value("l0")), n(s.value("n")), pose(s.read<Pose>("endpoint/*/pose")), ends(s.read<Ends>("link/*/ends")),
        level(s.add<Level>("link/*/level")) {}
  void step(const Step& k) const {
    for (size_t i = 0; i < k[ends].size(); ++i) {
      const Pose &a = k[pose][size_t(k[ends][i].tx)], &b = k[pose][size_t(k[ends][i].rx)];
      k[level][i].level = -k[l0] - 10 * k[n] * std::log10(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z));
    }
  }
  Value l0, n;
  In<Pose> pose;
  In<Ends> ends;
  Out<Level> level;
};
MUSTER_PLUGIN_IS(OneSlope)
