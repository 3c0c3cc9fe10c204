// A column of a log that slipped by some rows against the others.
#include <cstdint>
#include <muster/plugin.hpp>

#include "link_term.hpp"
#include "standing.hpp"

namespace {

using namespace muster;

struct ColumnShifted {
  static constexpr auto id = "effect.column_shifted/1";
  static constexpr auto summary = "a column of the log, of names or of places, is some rows off";
  static constexpr auto manual =
      "Reads the column from the row `by` further on, for all rows that have one: a row bears what belongs to the row\n"
      "`by` before it. Rows are all of the table, in its order: of all pairs, and of lost readings that have one.\n"
      "`column` names: which radio that stands an end is, with its place. `column` places: where an end that\n"
      "moves is. Senders take from senders, receivers from receivers, if both stand (names) or both move (places).\n"
      "It is a fault of a list of readings (data.links): live links do not change.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      choice("column", "names|places", "which column").with(MUSTER_EACH),
      integer("by", 1, -3, 3, "how many rows late; negative: early").with(MUSTER_EACH),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_INSTRUMENT,
      "the column of {column} in the log is {by} rows late (negative: early)",
      "",
      places_in_plan,
      "effect.labels_shifted effect.outliers",
      "log again, with the names and places in the message itself",
      nullptr,
      MUSTER_FIRST | MUSTER_OWN_WORLD,
  };

  explicit ColumnShifted(Setup& s)
      : column(s.value("column")),
        by(s.value("by")),
        mount(s.read<Mount>("radio/*/mount")),
        ends(s.read<Ends>("link/*/ends")),
        endpoint(s.modify<Endpoint>("endpoint/*/radio")),
        pose(s.modify<Pose>("endpoint/*/pose")) {}

  void step(const Step& k) const {
    const auto radios = k.before(endpoint);
    const auto poses = k.before(pose);
    const auto radios_out = k[endpoint];
    const auto poses_out = k[pose];
    for (std::size_t i = 0; i < radios.size(); ++i) {
      radios_out[i] = radios[i];
      poses_out[i] = poses[i];
    }
    const auto links = k[ends];
    if (radios.size() != 2 * links.size()) return;  // live radios
    const Standing standing(radios, poses, k[mount]);
    const bool names = k[column] == 0;
    const auto late = static_cast<std::int64_t>(k[by]), count = static_cast<std::int64_t>(links.size());
    for (std::int64_t row = 0; row < count; ++row) {
      const std::int64_t other = row + late;
      if (other < 0 || other >= count) continue;
      for (const bool sends : {true, false}) {
        const std::size_t here = end(links, row, sends), there = end(links, other, sends);
        if (standing(radios[here].radio) != names || standing(radios[there].radio) != names) continue;
        if (names) radios_out[here].radio = radios[there].radio;
        poses_out[here] = poses[there];
      }
    }
  }

  static std::size_t end(Rows<const Ends> links, std::int64_t row, bool sends) {
    const Ends& link = links[static_cast<std::size_t>(row)];
    return static_cast<std::size_t>(sends ? link.tx : link.rx);
  }

  Value column, by;
  In<Mount> mount;
  In<Ends> ends;
  Stage<Endpoint> endpoint;
  Stage<Pose> pose;
};

}  // namespace

MUSTER_PLUGIN_IS(ColumnShifted)
