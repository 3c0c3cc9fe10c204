// Small-scale fading of another law than the world has.
#include <muster/laws.hpp>
#include <muster/plugin.hpp>

#include "radio_fading/reading_key.hpp"
#include "radio_fading/rician.hpp"

namespace {

using namespace muster;

struct FadingLaw {
  static constexpr auto id = "effect.fading_law/1";
  static constexpr auto summary = "fading is more like Rayleigh, or steadier, than the world says";
  static constexpr auto manual =
      "Draws each reading's fading anew, as radio.fading does with per_reading, but with this `rician_k`; "
      "expectations follow. For readings taken apart from one another: between such that are closer than half a "
      "wavelength it keeps no likeness. Needs a radio.fading in the world.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("rician_k", 6, -40, 60, "dB", "steady over diffuse power; at -40 Rayleigh fading exactly").free(),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_LAW,
      "fading has a Rician K of {rician_k}",
      "",
      "",
      "effect.outliers effect.channel_mixture effect.shadowing_correlation",
      "stand still in many places a few decimetres apart and look at the spread of the readings",
      nullptr,
      0,
  };

  static void log_density(const double* params, uint32_t draws, const double* db, uint32_t count, double* out) {
    for (uint32_t i = 0; i < count; ++i) out[i] = rician_log_density(params[0], draws, db[i]);
  }
  static uint32_t steady(const double* params, double* db, double* probability, uint32_t) {
    *db = 0;
    *probability = 1;
    return params[0] >= steady_k_db ? 1 : 0;
  }
  static double mean(const double* params) { return rician_typical_db(params[0]); }
  static constexpr auto law =
      law_of_readings("rician_k", log_density).replaces().averaged_up_to(6).with_atoms(steady).with_mean(mean);

  explicit FadingLaw(Setup& s)
      : rician_k(s.value("rician_k")),
        endpoint(s.read<Endpoint>("endpoint/*/radio")),
        pose(s.read<Pose>("endpoint/*/pose")),
        ends(s.read<Ends>("link/*/ends")),
        gain(s.modify<Fading>("link/*/fading")),
        random(s.stream("fading")) {}

  void step(const Step& k) const {
    const double ratio = rician_ratio(k[rician_k]);
    const auto links = k[ends];
    const auto out = k[gain];
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i].gain = k.expected() ? rician_typical_gain(ratio)
                                 : rician_gain(ratio, diffuse(random, key(k, links[i].tx), key(k, links[i].rx)), 0);
    }
  }

  uint64_t key(const Step& k, double row) const {
    const Endpoint& end = k[endpoint][static_cast<std::size_t>(row)];
    return end_key(k.key("radio", static_cast<std::size_t>(end.radio)), end.t, k[pose][static_cast<std::size_t>(row)]);
  }

  Value rician_k;
  In<Endpoint> endpoint;
  In<Pose> pose;
  In<Ends> ends;
  Stage<Fading> gain;
  Stream random;
};

}  // namespace

MUSTER_PLUGIN_IS(FadingLaw)
