// Commands a rate for each of four rotors, plus a part that changes from tick to tick.
#include <cmath>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Lift {
  static constexpr auto id = "conformance.lift/1", summary = "asks rotors for rates";
  static constexpr auto phase = MUSTER_ACTUATE;
  static constexpr Param params[] = {real("rate", 0, 0, 2000, "rad/s", "of each rotor"),
                                     real("swing", 0, 0, 2000, "rad/s", "largest deviation from it, each its own")};

  explicit Lift(Setup& s)
      : rate(s.value("rate")), swing(s.value("swing")), drive(s.write<RotorDrive>("robot/*/rotor_drive")) {}

  void step(const Step& k) const {
    const double t = k.time();
    for (RotorDrive& d : k[drive]) {
      d = {k[rate] + k[swing] * std::sin(3 * t), k[rate] - k[swing] * std::sin(2 * t), k[rate] + k[swing] * std::cos(t),
           k[rate] - k[swing] * std::cos(2.5 * t)};
    }
  }

  Value rate, swing;
  Out<RotorDrive> drive;
};

}  // namespace

MUSTER_PLUGIN_IS(Lift)
