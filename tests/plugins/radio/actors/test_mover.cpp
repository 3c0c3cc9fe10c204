// Robots that go 3 m out and back along the x axis every 2 s; robot i on the line y = i.
#include <algorithm>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Mover {
  static constexpr auto id = "test.mover/1", summary = "robots that go out and back";
  static constexpr auto phase = MUSTER_PHYSICS;

  explicit Mover(Setup& s) : pose(s.write<Pose>("robot/*/pose")) {}

  void step(const Step& k) const {
    // In whole ticks, so that out and back pass the same places to the last bit.
    const auto ticks = static_cast<double>(k.tick() % 20);
    const double away = 0.3 * std::min(ticks, 20 - ticks);
    for (std::size_t i = 0; i < k[pose].size(); ++i) {
      k[pose][i] = {1 + away, static_cast<double>(i), 0.2, 1, 0, 0, 0};
    }
  }

  Out<Pose> pose;
};

}  // namespace

MUSTER_PLUGIN_IS(Mover)
