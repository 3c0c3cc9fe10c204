// One step in parts, which the threads of the run share: a long sum for each, and something wrong where asked.
#include <immintrin.h>

#include <cmath>
#include <muster/parallel.hpp>

namespace {

using namespace muster;

struct Sum {
  static constexpr const char* columns = "sum";
  double sum;
};

struct Parts {
  static constexpr auto id = "toy.parts/1", summary = "sums in parts";
  static constexpr auto phase = MUSTER_PHYSICS;
  static constexpr Param params[] = {
      choice("fault", "none|throws|rounds", "what the parts from the third on do wrong")};

  explicit Parts(Setup& s) : fault(s.value("fault")), out(s.write<Sum>("robot/*/sum")) {}

  void step(const Step& k) const {
    const auto rows = k[out];
    const int wrong = static_cast<int>(k[fault]);
    const auto tick = static_cast<double>(k.tick());
    each(k, rows.size(), [&](std::size_t i) {
      if (i >= 2 && wrong == 1) throw std::runtime_error("part " + std::to_string(i) + " came off");
      if (i >= 2 && wrong == 2) _mm_setcsr((_mm_getcsr() & ~0x6000u) | 0x4000u);
      rows[i].sum = 0;
      for (std::size_t n = 1; n <= 100 * (i + 1); ++n) rows[i].sum += std::sqrt(static_cast<double>(n) * tick);
    });
  }

  Value fault;
  Out<Sum> out;
};

}  // namespace

MUSTER_PLUGIN_IS(Parts)
