// Does next to nothing: one cell of its own, filled each tick.
#include <muster/plugin.hpp>

struct Cell {
  static constexpr const char* columns = "value";
  double value;
};

struct NoOp {
  static constexpr auto id = "bench.no_op/1", summary = "fills one cell";
  static constexpr auto phase = MUSTER_OBSERVE;
  explicit NoOp(muster::Setup& setup) : cell(setup.write<Cell>("self/cell")) {}
  void step(const muster::Step& k) const { k[cell]->value = k.time(); }
  muster::Out<Cell> cell;
};
MUSTER_PLUGIN_IS(NoOp)
