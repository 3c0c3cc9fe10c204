// Commands the wheels of Scarabs: v + dv sin(1.3 t) + a t and w + dw sin(0.9 t), t counted from the end of the first
// tick: linear over each tick where `rated`, else held as at its start.
#include <cmath>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Course {
  static constexpr auto id = "conformance.course/1", summary = "asks wheels for a course";
  static constexpr auto phase = MUSTER_ACTUATE;
  static constexpr Param params[] = {real("v", 0, -9, 9, "m/s", "speed"),
                                     real("dv", 0, -9, 9, "m/s", "swing of speed"),
                                     real("a", 0, -9, 9, "m/s2", "acceleration"),
                                     real("w", 0, -9, 9, "rad/s", "turn rate"),
                                     real("dw", 0, -9, 9, "rad/s", "swing of turn rate"),
                                     flag("rated", true, "slopes are given")};

  explicit Course(Setup& s)
      : v(s.value("v")),
        dv(s.value("dv")),
        a(s.value("a")),
        w(s.value("w")),
        dw(s.value("dw")),
        rated(s.value("rated")),
        drive(s.write<Drive>("robot/*/drive")) {}

  void step(const Step& k) const {
    constexpr double radius = 0.05, half_base = 0.105;  // of the Scarab [m]
    const auto rate = [&](double t, double side) {
      const double speed = k[v] + k[dv] * std::sin(1.3 * t) + k[a] * t;
      return (speed + side * half_base * (k[w] + k[dw] * std::sin(0.9 * t))) / radius;
    };
    const double end = k.time() - k.dt(), begin = end - k.dt();
    for (Drive& d : k[drive]) {
      d = {rate(begin, -1), rate(begin, 1), 0, 0};
      if (k[rated] == 0) continue;
      d.left_rate = (rate(end, -1) - d.left) / k.dt();
      d.right_rate = (rate(end, 1) - d.right) / k.dt();
    }
  }

  Value v, dv, a, w, dw, rated;
  Out<Drive> drive;
};

}  // namespace

MUSTER_PLUGIN_IS(Course)
