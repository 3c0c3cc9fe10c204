// Frequency hopping: each channel has a level of its own, and the record lacks the channel.
#include <algorithm>
#include <cmath>
#include <limits>
#include <muster/laws.hpp>
#include <muster/plugin.hpp>

#include "link_term.hpp"
#include "reading_stream.hpp"

namespace {

using namespace muster;

struct ChannelMixture {
  static constexpr auto id = "effect.channel_mixture/1";
  static constexpr auto summary = "readings come from hopping channels of different levels";
  static constexpr auto manual =
      "Adds one of `channels` evenly spaced offsets of mean 0 and standard deviation `sd`, drawn for each pair of "
      "radios and time, both ways alike. Expected: 0. Stream: channel.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("sd", 0, 0, 20, "dB", "of the channels' levels").free().with(MUSTER_LINEAR),
      integer("channels", 3, 2, 100, "how many there are"),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_LAW,
      "readings come from {channels} hopping channels whose levels differ by a standard deviation of {sd}",
      "",
      "",
      "effect.outliers effect.fading_law effect.people",
      "fix the channel; or stand still and look for separate peaks in the histogram",
      nullptr,
      0,
  };

  static double spacing(double sd, double channels) { return sd * std::sqrt(12 / (channels * channels - 1)); }
  static void log_density(const double*, uint32_t, const double*, uint32_t count, double* out) {
    std::fill_n(out, count, -std::numeric_limits<double>::infinity());
  }
  static uint32_t levels(const double* params, double* db, double* probability, uint32_t most) {
    const uint32_t count = std::min(static_cast<uint32_t>(params[1]), most);
    for (uint32_t c = 0; c < count; ++c) {
      db[c] = spacing(params[0], count) * (c - (count - 1.0) / 2);
      probability[c] = 1.0 / count;
    }
    return count;
  }
  static constexpr double sds[] = {0.35, 0.5, 0.7, 1, 1.4, 2, 2.8, 4, 5.6}, counts[] = {2, 3, 4};
  static constexpr auto law =
      law_of_readings("sd", log_density).from(sds).with_form("channels", counts).with_atoms(levels);

  explicit ChannelMixture(Setup& s)
      : sd(s.value("sd")), channels(s.value("channels")), random(s.stream("channel")), links(s) {}

  void step(const Step& k) const {
    const double count = k[channels], apart = spacing(k[sd], count);
    links.add(k, [&](const End& from, const End& to) {
      if (k.expected()) return 0.0;
      const double drawn = random.of(pair_key(k, from.radio, to.radio)).uniform(time_key(to.t));
      return apart * (std::floor(drawn * count) - (count - 1) / 2);
    });
  }

  Value sd, channels;
  Stream random;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(ChannelMixture)
