// Fills all cells of its table but, from the tick `at` on, the last row's.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Two {
  static constexpr const char* columns = "a b[s]";
  double a, b;
};

struct Lazy {
  static constexpr auto id = "toy.lazy/1", summary = "leaves a row unfilled";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {integer("at", 2, 0, 1000, "the tick"), flag("queue", false, "in a queue instead")};

  explicit Lazy(Setup& s) : at(s.value("at")), is_queue(s.param("queue") != 0), own{-1}, queue{-1} {
    if (is_queue)
      queue = s.write<Outgoing>("outbox/*/message");
    else
      own = s.write<Two>("robot/*/two");
  }

  void step(const Step& k) const {
    const bool lazy = k.tick() >= static_cast<uint64_t>(k[at]);
    if (is_queue) {
      const auto rows = k.append(queue, 2);
      for (std::size_t i = 0; i < (lazy ? 1 : 2); ++i) rows[i] = {0, null(), 0};
      return;
    }
    const auto rows = k[own];
    for (std::size_t i = 0; i < rows.size() - (lazy ? 1 : 0); ++i) rows[i] = {1, k.time()};
  }

  Value at;
  bool is_queue;
  Out<Two> own;
  Out<Outgoing> queue;
};

}  // namespace

MUSTER_PLUGIN_IS(Lazy)
