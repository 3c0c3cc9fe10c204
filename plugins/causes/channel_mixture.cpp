// Frequency hopping: each channel has a level of its own, and the record lacks the channel.
#include <cmath>
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
  };

  explicit ChannelMixture(Setup& s)
      : sd(s.value("sd")), channels(s.value("channels")), random(s.stream("channel")), links(s) {}

  void step(const Step& k) const {
    const double count = k[channels], spacing = k[sd] * std::sqrt(12 / (count * count - 1));
    links.add(k, [&](const End& from, const End& to) {
      if (k.expected()) return 0.0;
      const double drawn = random.of(pair_key(k, from.radio, to.radio)).uniform(time_key(to.t));
      return spacing * (std::floor(drawn * count) - (count - 1) / 2);
    });
  }

  Value sd, channels;
  Stream random;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(ChannelMixture)
