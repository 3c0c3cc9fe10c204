// A radio that joins the world at a tick: a copy of another, 1 m further along x.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Joiner {
  static constexpr auto id = "test.joiner/1", summary = "brings a radio";
  static constexpr auto phase = MUSTER_PHYSICS;
  static constexpr Param params[] = {
      text("radio", "", "name of the new radio").required(),
      reference("like", "radio", "which it is a copy of").required(),
      integer("at", 1, 1, 1e9, "the tick"),
  };

  explicit Joiner(Setup& s)
      : name(s.text("radio")),
        like(s.value("like")),
        at(s.value("at")),
        before(s.read<Mount>("radio/*/mount")),
        mount(s.write<Mount>("radio/*/mount", MUSTER_JOINS)) {}

  void step(const Step& k) const {
    if (static_cast<double>(k.tick()) != k[at]) return;
    const auto row = static_cast<std::size_t>(k[like]);
    const int joined = k.host()->join(k.host(), mount.index, name.c_str(), static_cast<int>(row));
    k.host()->place(k.host(), mount.index, static_cast<uint32_t>(joined), "mount", 1, k[before][row].x + 1);
  }

  std::string name;
  Value like, at;
  In<Mount> before;
  Out<Mount> mount;
};

}  // namespace

MUSTER_PLUGIN_IS(Joiner)
