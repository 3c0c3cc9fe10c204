// Shadowing of another strength or decorrelation distance than the world has.
#include <array>
#include <muster/plugin.hpp>

#include "link_term.hpp"
#include "radio_fading/line_integral.hpp"
#include "radio_fading/shadow_field.hpp"

namespace {

using namespace muster;

struct ShadowingCorrelation {
  static constexpr auto id = "effect.shadowing_correlation/2";
  static constexpr auto summary = "shadowing has another size or decorrelation distance";
  static constexpr auto manual =
      "Adds the shadowing of radio.fading with this size and decorrelation distance, less what the instance that `of` "
      "names has added: what is left is the new one alone. Field and random numbers are the same, so that with the "
      "same two values nothing changes. Expected: 0.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("shadowing", 4, 0, 30, "dB", "standard deviation of links much longer than the decorrelation distance")
          .free(),
      real("decorrelation", 2, 0.01, 1e4, "m", "distance over which the loss field's correlation falls to 1/e")
          .free()
          .with(MUSTER_LOG),
      text("of", "radio.fading", "the instance whose shadowing it stands in for"),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_LAW,
      "shadowing has a standard deviation of {shadowing} and decorrelates over {decorrelation}",
      "",
      places_in_plan,
      "effect.fading_law effect.room_clutter effect.obstacle",
      "drive a line much longer than the decorrelation distance twice, and the same line a metre beside it",
      "radio.fading.shadowing",
      0,
  };

  static void covariance(const double* params, const double* ends, const uint32_t* a, const uint32_t* b, uint32_t count,
                         double* out) {
    covariance_of_line_integrals(params[1], ends, a, b, count, out);
    for (uint32_t i = 0; i < count; ++i) out[i] *= params[0] * params[0];
  }
  static constexpr muster_draw draw{sizeof(muster_draw), "shadowing", "decorrelation", covariance};

  explicit ShadowingCorrelation(Setup& s)
      : shadowing(s.value("shadowing")),
        decorrelation(s.value("decorrelation")),
        pose(s.read<Pose>("endpoint/*/pose")),
        ends(s.read<Ends>("link/*/ends")),
        old(s.read<Level>("link/*/level@" + s.text("of") + ".shadowing")),
        level(s.add<Level>("link/*/level")),
        field(s.stream("shadowing")) {}

  void step(const Step& k) const {
    const auto out = k[level];
    if (k.expected() || k[shadowing] == 0) {
      for (Level& link : out) link.level = 0;
    } else {
      const auto at = field.at(places(k[pose], k[decorrelation]));
      const std::array<double*, 1> columns{column_of(out)};
      by_tiles(k[ends], k[pose].size(), columns,
               [&](std::size_t from, int place, std::size_t to, unsigned wanted, auto& values) {
                 field.between(at[from], place, at[to], wanted, k[shadowing], values[0]);
               });
    }
    for (std::size_t i = 0; i < out.size(); ++i) out[i].level -= k[old][i].level;
  }

  Value shadowing, decorrelation;
  In<Pose> pose;
  In<Ends> ends;
  In<Level> old;
  Out<Level> level;
  ShadowField field;
};

}  // namespace

MUSTER_PLUGIN_IS(ShadowingCorrelation)
