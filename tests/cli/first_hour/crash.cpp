// Writes through a null pointer in its third step, on the run's thread or on all of its workers.
#include <muster/parallel.hpp>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Crash {
  static constexpr auto id = "test.crash/1", summary = "crashes";
  static constexpr auto phase = MUSTER_OBSERVE;
  static constexpr Param params[] = {flag("parallel", false, "on the run's threads")};

  explicit Crash(Setup& s) : parallel(s.value("parallel")), cell(s.write<Cell>("self/cell")) {}

  void step(const Step& k) const {
    k[cell]->value = 0;
    if (k.tick() < 3) return;
    if (k[parallel] == 0) *nowhere = 1;
    each(k, 8, [](std::size_t) { *nowhere = 1; });
  }

  struct Cell {
    static constexpr const char* columns = "value";
    double value;
  };
  static int* volatile nowhere;
  Value parallel;
  Out<Cell> cell;
};

int* volatile Crash::nowhere = nullptr;

}  // namespace

MUSTER_PLUGIN_IS(Crash)
