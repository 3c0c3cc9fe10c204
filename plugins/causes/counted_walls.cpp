// Walls known only by their number, from a table of readings without a plan.
#include <muster/plugin.hpp>

#include "link_term.hpp"

namespace {

using namespace muster;

struct Count {
  double walls;
};

struct CountedWalls {
  static constexpr auto id = "effect.counted_walls/1";
  static constexpr auto summary = "the walls of a material, known by their number alone, cost level";
  static constexpr auto manual =
      "Takes away `loss` x the column walls_MATERIAL of `file`, whose rows are the links in their order: the measured "
      "readings, as data.links lists them. For data that count the walls between two radios instead of placing them. "
      "The material's own loss is not asked: `loss` is all that a counted wall takes. A diagnosis takes the column "
      "from the readings and writes `file` itself.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("material", "material", "whose walls are counted").required(),
      file("file", "the measured readings, with a column walls_MATERIAL").required(),
      real("loss", 0, 0, 40, "dB", "of each wall").free().with(MUSTER_LINEAR),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "each wall of {material} takes {loss}",
      "material",
      "walls",
      "effect.dual_slope effect.multiwall_saturation",
      "measure at one distance with more and with fewer walls of this material in between",
      nullptr,
      0,
  };

  explicit CountedWalls(Setup& s)
      : loss(s.value("loss")),
        level(s.add<Level>("link/*/level")),
        counts{s.host()->file(s.host(), "file", column(s).c_str())} {
    if (counts.index < 0) throw std::runtime_error("");  // the kernel has reported the reason
  }

  static std::string column(Setup& s) {
    const auto row = static_cast<uint32_t>(s.param("material"));
    return std::string("walls_") + s.host()->row_name(s.host(), "material", row);
  }

  void step(const Step& k) const {
    const auto walls = k[counts];
    const auto out = k[level];
    if (walls.size() != out.size())
      throw BadInput("the file counts walls of " + std::to_string(walls.size()) + " readings, and there are " +
                     std::to_string(out.size()) + " links; expected the table that data.links lists");
    for (std::size_t i = 0; i < out.size(); ++i) out[i].level = -k[loss] * walls[i].walls;
  }

  Value loss;
  Out<Level> level;
  In<Count> counts;
};

}  // namespace

MUSTER_PLUGIN_IS(CountedWalls)
