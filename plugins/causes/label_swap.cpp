// Two radios whose names were exchanged.
#include <algorithm>
#include <muster/plugin.hpp>

#include "link_term.hpp"

namespace {

using namespace muster;

struct LabelSwap {
  static constexpr auto id = "effect.label_swap/1";
  static constexpr auto summary = "two radios bear each other's name";
  static constexpr auto manual =
      "Puts radio a where b is, heading included, and b where a is. For radios that do not move: the place of a radio "
      "is that of its first row among the ends of links, whatever element lists it. While one of the two has none, "
      "both stay where they are.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("a", "radio", "one of the two").required(),
      reference("b", "radio", "the other").required(),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_INSTRUMENT,
      "the radios {a} and {b} bear each other's name",
      "a b",
      places_in_plan,
      "effect.tx_misplaced effect.tx_offset effect.antenna_tx effect.sector_antenna",
      "switch one of the two off and see which falls silent",
      nullptr,
      MUSTER_FIRST,
  };

  explicit LabelSwap(Setup& s)
      : a(s.value("a")),
        b(s.value("b")),
        endpoint(s.modify<Endpoint>("endpoint/*/radio")),
        pose(s.modify<Pose>("endpoint/*/pose")) {
    if (s.param("a") == s.param("b"))
      s.warn("self", "a and b are the same radio, so that nothing is exchanged; expected two radios");
  }

  void step(const Step& k) const {
    const auto before = k.before(pose);
    const auto ends = unchanged(k, endpoint);
    const auto out = k[pose];
    const Pose *of_a = place(k, k[a]), *of_b = place(k, k[b]);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double radio = ends[i].radio;
      out[i] = before[i];
      if (of_a && of_b && radio == k[a]) out[i] = *of_b;
      if (of_a && of_b && radio == k[b]) out[i] = *of_a;
    }
  }

  const Pose* place(const Step& k, double radio) const {
    const auto ends = k.before(endpoint);
    const auto found = std::find_if(ends.begin(), ends.end(), [&](const Endpoint& end) { return end.radio == radio; });
    return found == ends.end() ? nullptr : &k.before(pose)[static_cast<std::size_t>(found - ends.begin())];
  }

  Value a, b;
  Stage<Endpoint> endpoint;  // unchanged: in line with other edits of either
  Stage<Pose> pose;
};

}  // namespace

MUSTER_PLUGIN_IS(LabelSwap)
