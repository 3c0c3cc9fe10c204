// Names of radios that slipped by some lines in the list of places.
#include <algorithm>
#include <muster/plugin.hpp>

#include "link_term.hpp"
#include "standing.hpp"

namespace {

using namespace muster;

struct LabelsShifted {
  static constexpr auto id = "effect.labels_shifted/2";
  static constexpr auto summary = "all radios that stand bear the name of another, some lines further on";
  static constexpr auto manual =
      "Of all radios that stand, in the world's order, puts the first where `first` is, heading included, the second\n"
      "where the one after `first` is, and so on; after the last comes the first again. A radio that is in the list "
      "and\n"
      "never heard has its line, too. Nothing changes where `first` moves.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("first", "radio", "which radio's place the first one has").required(),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_INSTRUMENT,
      "the names of all radios that stand are shifted in the list of places: the first one is where {first} is listed, "
      "and the others follow in the world's order",
      "first",
      places_in_plan,
      "effect.label_swap effect.plan_turned effect.column_shifted",
      "switch one of them off and see which falls silent",
      nullptr,
      MUSTER_FIRST | MUSTER_OWN_WORLD,
  };

  explicit LabelsShifted(Setup& s)
      : first(s.value("first")),
        mount(s.read<Mount>("radio/*/mount")),
        endpoint(s.modify<Endpoint>("endpoint/*/radio")),
        pose(s.modify<Pose>("endpoint/*/pose")) {}

  void step(const Step& k) const {
    const auto before = k.before(pose);
    const auto ends = unchanged(k, endpoint);
    const auto out = k[pose];
    const Standing standing(ends, before, k[mount]);
    const auto& radios = standing.radios();
    const auto place_of = [&](double radio) {
      return static_cast<std::size_t>(std::find(radios.begin(), radios.end(), static_cast<std::size_t>(radio)) -
                                      radios.begin());
    };
    const std::size_t by = place_of(k[first]);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const bool shifts = by < radios.size() && standing(ends[i].radio);
      out[i] = shifts ? standing.place_of(radios[(place_of(ends[i].radio) + by) % radios.size()]) : before[i];
    }
  }

  Value first;
  In<Mount> mount;
  Stage<Endpoint> endpoint;  // unchanged: in line with other edits of either
  Stage<Pose> pose;
};

}  // namespace

MUSTER_PLUGIN_IS(LabelsShifted)
