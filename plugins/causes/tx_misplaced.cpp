// A radio at another position than on the map.
#include <muster/plugin.hpp>

#include "link_term.hpp"

namespace {

using namespace muster;

struct TxMisplaced {
  static constexpr auto id = "effect.tx_misplaced/1";
  static constexpr auto summary = "a radio does not stand where the map says";
  static constexpr auto manual =
      "Puts every end of a link that is `radio` at (x, y), whatever the world or the data say; its height and heading "
      "stay.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("radio", "radio", "which radio, one that does not move").required(),
      real("x", 0, -1e6, 1e6, "m", "where it is, east").required().free().with(MUSTER_EAST),
      real("y", 0, -1e6, 1e6, "m", "where it is, north").required().free().with(MUSTER_NORTH),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_WORLD_EDIT,
      "the radio {radio} is not where the map says but at ({x}, {y})",
      "radio",
      places_in_plan,
      "effect.label_swap effect.tx_offset effect.antenna_tx effect.sector_antenna effect.plan_shifted",
      "measure its place; or measure levels close to it, all around",
      nullptr,
      MUSTER_FIRST,
  };

  explicit TxMisplaced(Setup& s)
      : radio(s.value("radio")),
        x(s.value("x")),
        y(s.value("y")),
        endpoint(s.modify<Endpoint>("endpoint/*/radio")),
        pose(s.modify<Pose>("endpoint/*/pose")) {}

  void step(const Step& k) const {
    const auto before = k.before(pose);
    const auto ends = unchanged(k, endpoint);
    const auto out = k[pose];
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i] = before[i];
      if (ends[i].radio != k[radio]) continue;
      out[i].x = k[x];
      out[i].y = k[y];
    }
  }

  Value radio, x, y;
  Stage<Endpoint> endpoint;  // unchanged: in line with other edits of either
  Stage<Pose> pose;
};

}  // namespace

MUSTER_PLUGIN_IS(TxMisplaced)
