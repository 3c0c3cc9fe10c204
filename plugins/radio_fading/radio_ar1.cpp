// Shadowing and fading as processes of each pair of radios, for comparison with fields over places.
#include <algorithm>
#include <cstring>
#include <map>
#include <muster/plugin.hpp>
#include <string>
#include <utility>

#include "pair_process.hpp"
#include "rician.hpp"

namespace {

using namespace muster;

// All pairs, as bytes of PairProcess in the order of their rows.
struct Memory {
  static constexpr const char* columns = "pairs{}";
  double pairs;
};

struct RadioAr1 {
  static constexpr auto id = "radio.ar1/1";
  static constexpr auto summary = "shadowing and fading as AR(1) processes along the way of each pair of radios";
  static constexpr auto manual =
      R"(What network simulators do, in the place of radio.fading, for comparison. From place to place a pair's
shadowing keeps the share exp(-(a + b)/D), its complex gain J0(2 pi a/wavelength) J0(2 pi b/wavelength), where a and
b are the ways that its ends moved in the tick; the rest is drawn anew. The same both ways; still while both stand.
It forgets places: out and back by D leaves exp(-2) of the shadowing. Pairs know nothing of each other. The
correlation of fading at a distance depends on the tick: the finer, the higher. A pair that was not listed for a
tick begins anew. Expectations are those of radio.fading.)";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("shadowing", 4, 0, 30, "dB", "standard deviation"),
      real("decorrelation", 2, 0.01, 1e4, "m",
           "way of one end over which shadowing's correlation falls to 1/e; only with shadowing"),
      flag("fading", true, "small-scale fading; without, its gain is 1"),
      real("rician_k", -40, -40, 60, "dB",
           "steady over diffuse power; at -40 Rayleigh fading exactly; only with fading"),
      real("frequency", 2.44e9, 1e6, 1e12, "Hz", "carrier, for the wavelength of fading; only with fading"),
  };

  explicit RadioAr1(Setup& s)
      : sd(s.value("shadowing")),
        decorrelation(s.value("decorrelation")),
        has_fading(s.value("fading")),
        rician_k(s.value("rician_k")),
        frequency(s.value("frequency")),
        endpoint(s.read<Endpoint>("endpoint/*/radio")),
        pose(s.read<Pose>("endpoint/*/pose")),
        ends(s.read<Ends>("link/*/ends")),
        shadowing(s.add<Level>("link/*/level@shadowing")),
        gain(s.write<Fading>("link/*/fading")),
        memory(s.write<Memory>("self/memory")),
        random(s.stream("ar1")) {}

  void step(const Step& k) const {
    const double ratio = rician_ratio(k[rician_k]);
    if (k.expected()) {
      for (Level& link : k[shadowing]) link.level = 0;
      for (Fading& link : k[gain]) link.gain = k[has_fading] != 0 ? rician_typical_gain(ratio) : 1;
      k.put_bytes(memory, 0, 0, k.last_bytes(memory, 0, 0));
      return;
    }
    const Pairs before = remembered(k);
    Pairs now;
    for (std::size_t i = 0; i < k[ends].size(); ++i) {
      const PairProcess& pair = followed(k, k[ends][i], before, now);
      k[shadowing][i].level = k[sd] * pair.shadow;
      k[gain][i].gain = k[has_fading] != 0 ? rician_gain(ratio, pair.diffuse(), steady_phase(k, k[ends][i])) : 1;
    }
    std::string bytes;
    for (const auto& [rows, pair] : now) bytes.append(reinterpret_cast<const char*>(&pair), sizeof pair);
    k.put_bytes(memory, 0, 0, bytes);
  }

  using Pairs = std::map<std::pair<double, double>, PairProcess>;

  Pairs remembered(const Step& k) const {
    const auto bytes = k.last_bytes(memory, 0, 0);
    Pairs result;
    for (std::size_t at = 0; at + sizeof(PairProcess) <= bytes.size(); at += sizeof(PairProcess)) {
      PairProcess pair;
      std::memcpy(&pair, bytes.data() + at, sizeof pair);
      result.emplace_hint(result.end(), std::pair(pair.low, pair.high), pair);
    }
    return result;
  }

  // Links of one pair advance one process in turn: the reverse link has the values of the forward one.
  const PairProcess& followed(const Step& k, const Ends& link, const Pairs& before, Pairs& now) const {
    auto tx = static_cast<std::size_t>(link.tx), rx = static_cast<std::size_t>(link.rx);
    if (k[endpoint][rx].radio < k[endpoint][tx].radio) std::swap(tx, rx);
    const double low = k[endpoint][tx].radio, high = k[endpoint][rx].radio;
    auto found = now.find({low, high});
    if (found == now.end()) {
      const auto last = before.find({low, high});
      found = now.emplace(std::pair(low, high),
                          last != before.end() ? last->second : PairProcess{low, high, {}, {}, 0, 0, 0, 0})
                  .first;
    }
    const uint64_t one = k.key("radio", static_cast<std::size_t>(low));
    const uint64_t other = k.key("radio", static_cast<std::size_t>(high));
    const Stream own = random.of(combined(std::min(one, other), std::max(one, other)));
    found->second.follow(k[pose][tx], k[pose][rx], k[decorrelation], wavelength(k), own);
    return found->second;
  }

  double wavelength(const Step& k) const { return 299792458 / k[frequency]; }

  double steady_phase(const Step& k, const Ends& link) const {
    const Pose &p = k[pose][static_cast<std::size_t>(link.tx)], &q = k[pose][static_cast<std::size_t>(link.rx)];
    const double x = p.x - q.x, y = p.y - q.y, z = p.z - q.z;
    return -6.283185307179586 * std::sqrt(x * x + y * y + z * z) / wavelength(k);
  }

  Value sd, decorrelation, has_fading, rician_k, frequency;
  In<Endpoint> endpoint;
  In<Pose> pose;
  In<Ends> ends;
  Out<Level> shadowing;
  Out<Fading> gain;
  Out<Memory> memory;
  Stream random;
};

}  // namespace

MUSTER_PLUGIN_IS(RadioAr1)
