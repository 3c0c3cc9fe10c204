// Lists as many endpoints as the tick's remainder by `modulo`, plus one, and half as many links.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct List {
  static constexpr auto id = "toy.list/1", summary = "lists endpoints and links";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      integer("modulo", 5, 1, 100, "how many at most"), flag("uneven", false, "one pose too few"),
      flag("adds", false, "claims a part of a sum over its own rows"), flag("loose", false, "a link to nowhere"),
      real("spread", 0, 0, 1e6, "m", "from one endpoint to the next")};

  explicit List(Setup& s)
      : modulo(s.value("modulo")),
        uneven(s.value("uneven")),
        loose(s.value("loose")),
        spread(s.value("spread")),
        radio(s.write<Endpoint>("endpoint/*/radio")),
        pose(s.write<Pose>("endpoint/*/pose")),
        ends(s.write<Ends>("link/*/ends")) {
    if (s.param("adds") != 0) s.add<Level>("link/*/level");
  }

  void step(const Step& k) const {
    const auto rows = static_cast<std::size_t>(k.tick()) % static_cast<std::size_t>(k[modulo]) + 1;
    std::size_t i = 0, placed = 0;
    for (auto& it : k.append(radio, rows)) it = {0, static_cast<double>(i++)};
    for (auto& it : k.append(pose, rows - (k[uneven] != 0 ? 1 : 0)))
      it = {static_cast<double>(k.tick()), k[spread] * static_cast<double>(placed++), 0, 1, 0, 0, 0};
    for (auto& it : k.append(ends, (rows + 1) / 2)) it = {0, static_cast<double>(k[loose] != 0 ? rows : rows - 1)};
  }

  Value modulo, uneven, loose, spread;
  Out<Endpoint> radio;
  Out<Pose> pose;
  Out<Ends> ends;
};

}  // namespace

MUSTER_PLUGIN_IS(List)
