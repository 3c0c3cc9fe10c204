// A term of the radio channel: mean received level from distance alone.
#include <cmath>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct SkeletonTerm {
  static constexpr auto id = "radio.skeleton/1";
  static constexpr auto summary = "mean level from distance alone";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {real("l0", 40, 0, 150, "dB", "loss at 1 m").free(),
                                     real("n", 2, 0, 10, "", "path-loss exponent").free()};

  explicit SkeletonTerm(Setup& s)
      : l0(s.value("l0")),
        n(s.value("n")),
        pose(s.read<Pose>("endpoint/*/pose")),
        ends(s.read<Ends>("link/*/ends")),
        level(s.add<Level>("link/*/level")) {}

  void step(const Step& k) const {
    for (std::size_t i = 0; i < k[ends].size(); ++i) {
      const Pose& a = k[pose][static_cast<std::size_t>(k[ends][i].tx)];
      const Pose& b = k[pose][static_cast<std::size_t>(k[ends][i].rx)];
      k[level][i].level = -k[l0] - 10 * k[n] * std::log10(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z));
    }
  }

  Value l0, n;
  In<Pose> pose;
  In<Ends> ends;
  Out<Level> level;
};

}  // namespace

MUSTER_PLUGIN_IS(SkeletonTerm)
