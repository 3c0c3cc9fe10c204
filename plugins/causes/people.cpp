// People who cross the line between two radios.
#include <cmath>
#include <muster/plugin.hpp>

#include "link_term.hpp"
#include "reading_stream.hpp"

namespace {

using namespace muster;

struct People {
  static constexpr auto id = "effect.people/1";
  static constexpr auto summary = "people cross the line between two radios and take level for a while";
  static constexpr auto manual =
      "Time is cut into windows of `duration`. In a share of `share` of them, drawn for each pair of radios, somebody "
      "stands in the way and `loss` is taken, both ways alike. Expected: -share x loss. With `radio` on its links "
      "alone, and with `other` on those between the two. Stream: people.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("radio", "radio", "one end; without it, all links"),
      reference("other", "radio", "the other end; without it, any"),
      real("loss", 0, 0, 40, "dB", "while somebody is in the way").free().with(MUSTER_LINEAR),
      real("share", 0.1, 0, 1, "", "of the time").free(),
      real("duration", 2, 0.1, 1e4, "s", "of one crossing").free().with(MUSTER_LOG),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_LAW,
      "people cross the line between {radio} and {other} for a share of {share} of the time and take {loss}",
      "radio",
      "t",
      "effect.outliers effect.periodic effect.channel_mixture",
      "measure over the same link, both radios standing, with nobody about",
      nullptr,
      MUSTER_FIRST,
  };
  static constexpr muster_burst burst{sizeof(muster_burst), "radio", "other", "loss", "share", "duration"};

  explicit People(Setup& s)
      : radio(s.value("radio")),
        other(s.value("other")),
        loss(s.value("loss")),
        share(s.value("share")),
        duration(s.value("duration")),
        random(s.stream("people")),
        links(s) {
    if (s.param("radio") >= 0 && s.param("radio") == s.param("other"))
      s.warn("self",
             "radio and other are the same radio, which has no link to itself, so that nobody is in the way; "
             "expected two radios");
  }

  void step(const Step& k) const {
    links.add(k, [&](const End& from, const End& to) {
      if (!concerns(k[radio], from, to) || !concerns(k[other], from, to)) return 0.0;
      if (k.expected()) return -k[share] * k[loss];
      const double window = std::floor(to.t / k[duration]);
      const double drawn = random.of(pair_key(k, from.radio, to.radio)).uniform(time_key(window));
      return drawn < k[share] ? -k[loss] : 0.0;
    });
  }

  Value radio, other, loss, share, duration;
  Stream random;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(People)
