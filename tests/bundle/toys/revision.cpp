// Counts, by as much a tick as its build says: two revisions of one plugin.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Revised {
  static constexpr auto id = TOY_ID, summary = "counts";
  static constexpr auto phase = MUSTER_OBSERVE;
  static constexpr Param params[] = {file("list", "a table that is read")};

  struct Cell {
    static constexpr const char* columns = "value";
    double value;
  };
  explicit Revised(Setup& s) : cell(s.write<Cell>("self/count")) {}
  void step(const Step& k) const { k[cell]->value = static_cast<double>(k.tick() * TOY_STEP); }

  Out<Cell> cell;
};

}  // namespace

MUSTER_PLUGIN_IS(Revised)
