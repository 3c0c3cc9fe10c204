// What goes wrong, and where, is a definition of the build: TOY_ID, TOY_CREATE, TOY_STEP, TOY_DESTROY are statements.
#pragma once

#include <cmath>
#include <limits>
#include <muster/plugin.hpp>

#ifndef TOY_PHASE
#define TOY_PHASE MUSTER_OBSERVE
#endif
#ifndef TOY_CREATE
#define TOY_CREATE
#endif
#ifndef TOY_STEP
#define TOY_STEP
#endif
#ifndef TOY_EACH_STEP
#define TOY_EACH_STEP
#endif
#ifndef TOY_MORE  // ", flag(...)": a parameter
#define TOY_MORE
#endif
#ifndef TOY_DESTROY
#define TOY_DESTROY
#endif
#ifndef TOY_COLUMN
#define TOY_COLUMN "value[m]"
#endif

#ifndef TOY_STEP_CONST
#define TOY_STEP_CONST const
#endif
#ifndef TOY_KEEPS_CACHES
#define TOY_KEEPS_CACHES false
#endif

// How often it was called in this process: state that no table holds.
inline int calls() {
  static int count = 0;
  return ++count;
}

struct Commas {
  static constexpr const char* columns = "x[m],y[m], z[m]";
  double x, y, z;
};

struct Round {
  static constexpr const char* columns = "sum(m)";
  double sum;
};

struct Cell {
  static constexpr const char* columns = TOY_COLUMN;
  double value;
};

struct Toy {
  static constexpr auto id = TOY_ID, summary = "goes wrong in one way";
  static constexpr auto phase = TOY_PHASE;
  static constexpr muster::Param params[] = {muster::real("size", 1, 0, 10, "m", "how tall it is").free() TOY_MORE};
  explicit Toy(muster::Setup& setup) : cell(setup.write<Cell>("self/cell")) { TOY_CREATE; }
  ~Toy() noexcept(false) { TOY_DESTROY; }
  static constexpr bool keeps_only_caches = TOY_KEEPS_CACHES;
  void step(const muster::Step& k) TOY_STEP_CONST {
    if (k.tick() == 5) {
      TOY_STEP;
    }
    TOY_EACH_STEP;
    k[cell]->value = static_cast<double>(k.tick());
  }
  muster::Out<Cell> cell;
  int kept = 0;
  mutable int counted = 0;
};
