// Reads a robot's odometry, so that the kernel adds its provider.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct TestProbe {
  static constexpr auto id = "test.probe/1";
  static constexpr auto summary = "reads odometry";
  static constexpr auto phase = MUSTER_OBSERVE;

  explicit TestProbe(Setup& s) { s.read<Odometry>("robot/*/odometry"); }
  void step(const Step&) const {}
};

}  // namespace

MUSTER_PLUGIN_IS(TestProbe)
