// Channel effects beyond the floor plan: shadowing as a field over the environment, and fading by interference of
// waves.
#include <array>
#include <muster/laws.hpp>
#include <muster/plugin.hpp>
#include <muster/reverse_links.hpp>
#include <vector>

#include "line_integral.hpp"
#include "multipath.hpp"
#include "reading_key.hpp"
#include "rician.hpp"
#include "shadow_field.hpp"

namespace {

using namespace muster;

constexpr double light_speed = 299792458;  // m/s

struct RadioFading {
  static constexpr auto id = "radio.fading/2";
  static constexpr auto summary = "shadowing that belongs to the place, and Rayleigh or Rician fading";
  static constexpr auto manual =
      R"(level@shadowing: a link's share of a random loss field over the environment, normal in dB. Its sd grows with the
link's length d: shadowing x sqrt(1 - (1 - exp(-d/D)) D/d), D = decorrelation (Agrawal and Patwari 2009). Two
links, of lengths d1 and d2, have the covariance shadowing^2 / (2 D sqrt(d1 d2)) x the double integral of exp(-r/D)
along both. r is the distance between points of the one and of the other, in three dimensions.
fading: linear power gain of mean 1, from waves that all radios share (Clarke 1968). It changes over half a
wavelength, not with time. Both are the same both ways and depend on seed and place alone.
With `per_reading` fading is drawn for each two radios, their places and their time. Both ways share a draw if their
times are equal, and not if these differ at all. A diagnosis pairs both ways up to 20 ms apart, if they scatter alike.
Asked for expectations, shadowing is 0 and fading is the gain whose dB is the mean of its dB: -2.507 dB under Rayleigh
fading, -0.956 dB for a K of 6 dB.)";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("shadowing", 4, 0, 30, "dB", "standard deviation of links much longer than the decorrelation distance"),
      real("decorrelation", 2, 0.01, 1e4, "m",
           "distance over which the loss field's correlation falls to 1/e; only with shadowing"),
      flag("fading", true, "small-scale fading; without, its gain is 1"),
      real("rician_k", -40, -40, 60, "dB",
           "steady over diffuse power; at -40 Rayleigh fading exactly; only with fading"),
      real("frequency", 2.44e9, 1e6, 1e12, "Hz", "carrier, for the wavelength of fading; only with fading"),
      flag("per_reading", false,
           "fading drawn for each two radios, places and times anew, white in space; only with fading"),
  };

  static void covariance(const double* params, const double* ends, const uint32_t* a, const uint32_t* b, uint32_t count,
                         double* out) {
    covariance_of_line_integrals(params[1], ends, a, b, count, out);
    for (uint32_t i = 0; i < count; ++i) out[i] *= params[0] * params[0];
  }
  static constexpr muster_draw draw{sizeof(muster_draw), "shadowing", "decorrelation", covariance};

  static double k_of(const double* params) { return params[2] != 0 ? params[3] : steady_k_db; }
  static void log_density(const double* params, uint32_t draws, const double* db, uint32_t count, double* out) {
    for (uint32_t i = 0; i < count; ++i) out[i] = rician_log_density(k_of(params), draws, db[i]);
  }
  static uint32_t steady(const double* params, double* db, double* probability, uint32_t) {
    *db = 0;
    *probability = 1;
    return k_of(params) >= steady_k_db ? 1 : 0;
  }
  static double mean(const double* params) { return params[2] != 0 ? rician_typical_db(params[3]) : 0; }
  static double half_a_wavelength(const double* params) { return params[5] != 0 ? 0 : light_speed / params[4] / 2; }
  static constexpr auto law = law_of_readings("rician_k", log_density)
                                  .replaces()
                                  .averaged_up_to(6)
                                  .with_atoms(steady)
                                  .with_mean(mean)
                                  .drawn_anew_after(half_a_wavelength);

  explicit RadioFading(Setup& s)
      : sd(s.value("shadowing")),
        decorrelation(s.value("decorrelation")),
        has_fading(s.value("fading")),
        rician_k(s.value("rician_k")),
        frequency(s.value("frequency")),
        per_reading(s.value("per_reading")),
        endpoint(s.read<Endpoint>("endpoint/*/radio")),
        pose(s.read<Pose>("endpoint/*/pose")),
        ends(s.read<Ends>("link/*/ends")),
        shadowing(s.add<Level>("link/*/level@shadowing")),
        gain(s.write<Fading>("link/*/fading")),
        field(s.stream("shadowing")),
        random(s.stream("fading")),
        multipath(random) {}

  void step(const Step& k) const {
    const double ratio = rician_ratio(k[rician_k]);
    const bool fades = k[has_fading] != 0 && !k.expected();
    const bool shadows = k[sd] != 0 && !k.expected(), interferes = fades && k[per_reading] == 0;
    if (!shadows) {
      for (Level& link : k[shadowing]) link.level = 0;
    }
    if (!fades) {
      const double everywhere = k[has_fading] != 0 ? rician_typical_gain(ratio) : 1;
      for (Fading& link : k[gain]) link.gain = everywhere;
    } else if (!interferes) {
      draw_each(k, ratio);
    }
    if (shadows || interferes) evaluate(k, shadows, interferes, ratio);
  }

  // Evaluates the requested ones of the two fields.
  void evaluate(const Step& k, bool shadows, bool interferes, double ratio) const {
    const auto shadow_at = shadows ? field.at(places(k[pose], k[decorrelation])) : std::vector<ShadowField::Tile>();
    const auto waves_at =
        interferes ? multipath.at(places(k[pose], light_speed / k[frequency])) : std::vector<Multipath::Tile>();
    const double size = k[sd];
    const std::array<double*, 2> columns{shadows ? column_of(k[shadowing]) : nullptr,
                                         interferes ? column_of(k[gain]) : nullptr};
    by_tiles(k[ends], k[pose].size(), columns,
             [&](std::size_t from, int place, std::size_t to, unsigned wanted, auto& values) {
               if (shadows) field.between(shadow_at[from], place, shadow_at[to], wanted, size, values[0]);
               if (interferes) multipath.gains(waves_at[from], place, waves_at[to], wanted, ratio, values[1]);
             });
  }

  void draw_each(const Step& k, double ratio) const {
    std::vector<uint64_t> keys;
    for (std::size_t i = 0; i < k[pose].size(); ++i) {
      const Endpoint& end = k[endpoint][i];
      keys.push_back(end_key(k.key("radio", static_cast<std::size_t>(end.radio)), end.t, k[pose][i]));
    }
    const auto links = k[ends];
    const auto gains = k[gain];
    const auto back = earlier_reverse(links, keys.size());
    for (std::size_t i = 0; i < links.size(); ++i) {
      const auto tx = static_cast<std::size_t>(links[i].tx), rx = static_cast<std::size_t>(links[i].rx);
      gains[i].gain =
          back[i] != no_link ? gains[back[i]].gain : rician_gain(ratio, diffuse(random, keys[tx], keys[rx]), 0);
    }
  }

  Value sd, decorrelation, has_fading, rician_k, frequency, per_reading;
  In<Endpoint> endpoint;
  In<Pose> pose;
  In<Ends> ends;
  Out<Level> shadowing;
  Out<Fading> gain;
  ShadowField field;
  Stream random;
  Multipath multipath;
};

}  // namespace

MUSTER_PLUGIN_IS(RadioFading)
