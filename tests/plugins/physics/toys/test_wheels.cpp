// Commands a course for all wheels: v + dv sin(t), w + dw sin(2 t), linear over each step. The Scarab's wheels.
#include <cmath>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct TestWheels {
  static constexpr auto id = "test.wheels/1";
  static constexpr auto summary = "asks wheels for a course";
  static constexpr auto phase = MUSTER_ACTUATE;
  static constexpr Param params[] = {real("v", 0, -9, 9, "m/s", "speed"), real("dv", 0, -9, 9, "m/s", "swing of speed"),
                                     real("w", 0, -9, 9, "rad/s", "turn rate"),
                                     real("dw", 0, -9, 9, "rad/s", "swing of turn rate")};

  explicit TestWheels(Setup& s)
      : v(s.value("v")),
        dv(s.value("dv")),
        w(s.value("w")),
        dw(s.value("dw")),
        drive(s.write<Drive>("robot/*/drive")) {}

  void step(const Step& k) const {
    const auto rates = [&](double t, double side) {
      return (k[v] + k[dv] * std::sin(t) + side * (k[w] + k[dw] * std::sin(2 * t)) * 0.105) / 0.05;
    };
    for (Drive& d : k[drive]) {
      const double t = k.time() - k.dt();
      d.left = rates(t, -1), d.right = rates(t, 1);
      d.left_rate = (rates(k.time(), -1) - d.left) / k.dt();
      d.right_rate = (rates(k.time(), 1) - d.right) / k.dt();
    }
  }

  Value v, dv, w, dw;
  Out<Drive> drive;
};

}  // namespace

MUSTER_PLUGIN_IS(TestWheels)
