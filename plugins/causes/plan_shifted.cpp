// A plan with another origin than the places of what moves in it.
#include <cmath>
#include <muster/plugin.hpp>

#include "link_term.hpp"
#include "standing.hpp"

namespace {

using namespace muster;

struct PlanShifted {
  static constexpr auto id = "effect.plan_shifted/1";
  static constexpr auto summary = "the stations, the robots' places or the walls are all listed some way off";
  static constexpr auto manual =
      "Undoes that the listed places are the true ones moved by (east, north). `of` stations: of radios that stand,\n"
      "as in effect.labels_shifted. `of` robots: of all others. `of` walls: the walls are moved, so all radios are\n"
      "put where they are in the walls' own coordinates. Stations listed 7 m east and 5 m south of where they stand\n"
      "have east 7 and north -5: one listed at (17, 5) is put back at (10, 10).";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      choice("of", "stations|robots|walls", "what is listed wrongly").with(MUSTER_EACH),
      real("east", 0, -1e4, 1e4, "m", "how far east of where they are they are listed").free(),
      real("north", 0, -1e4, 1e4, "m", "how far north").free(),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_WORLD_EDIT,
      "the {of} are all listed {east|east|west} and {north|north|south} of where they are",
      "",
      places_in_plan,
      "effect.plan_turned effect.tx_misplaced",
      "measure the place of one radio in the coordinates of the other places",
      nullptr,
      MUSTER_FIRST | MUSTER_OWN_WORLD,
  };

  explicit PlanShifted(Setup& s)
      : of(s.value("of")),
        east(s.value("east")),
        north(s.value("north")),
        mount(s.read<Mount>("radio/*/mount")),
        endpoint(s.modify<Endpoint>("endpoint/*/radio")),
        pose(s.modify<Pose>("endpoint/*/pose")) {}

  void step(const Step& k) const {
    const auto before = k.before(pose);
    const auto ends = unchanged(k, endpoint);
    const auto out = k[pose];
    const auto wrongly = static_cast<Listed>(static_cast<int>(k[of]));
    const Standing standing(ends, before, k[mount]);
    const double back = wrongly == Listed::walls ? 1 : -1;
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i] = before[i];
      if (!standing.concerned(ends[i].radio, wrongly)) continue;
      out[i].x += back * k[east];
      out[i].y += back * k[north];
    }
  }

  Value of, east, north;
  In<Mount> mount;
  Stage<Endpoint> endpoint;  // unchanged: in line with other edits of either
  Stage<Pose> pose;
};

}  // namespace

MUSTER_PLUGIN_IS(PlanShifted)
