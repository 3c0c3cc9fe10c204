// Walls behind walls cost less and less: waves find paths around them.
#include <cmath>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct MultiwallSaturation {
  static constexpr auto id = "effect.multiwall_saturation/1";
  static constexpr auto summary = "many walls cost less than the sum of each";
  static constexpr auto manual =
      "Where walls take W dB together, gives back W - knee (1 - exp(-W / knee)), so that never more than `knee` is "
      "lost. At the highest knee nothing is given back. W is the part `walls` of the level, of the instance that `of` "
      "names. That walls behind walls cost less and less is what Lott and Forkel measured (VTC Spring 2001).";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("knee", 1e4, 1, 1e4, "dB", "what walls cost at most").free().with(MUSTER_LOG),
      text("of", "radio.multiwall", "the instance that counts the walls"),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "walls behind walls cost less and less, at most {knee} together",
      "",
      "",
      "effect.incidence effect.dual_slope effect.rssi_floor effect.corridor",
      "measure behind one, two, three and more walls at about the same distance",
      nullptr,
      0,
  };

  explicit MultiwallSaturation(Setup& s)
      : knee(s.value("knee")),
        walls(s.read<Level>("link/*/level@" + s.text("of") + ".walls")),
        level(s.add<Level>("link/*/level")) {}

  void step(const Step& k) const {
    const auto out = k[level];
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double whole = -k[walls][i].level;
      out[i].level = k[knee] < 1e4 ? whole + k[knee] * std::expm1(-whole / k[knee]) : 0;
    }
  }

  Value knee;
  In<Level> walls;
  Out<Level> level;
};

}  // namespace

MUSTER_PLUGIN_IS(MultiwallSaturation)
