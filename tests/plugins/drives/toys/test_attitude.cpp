// A constant command to a Hummingbird's attitude, with a thrust of its weight.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct TestAttitude {
  static constexpr auto id = "test.attitude/1";
  static constexpr auto summary = "one attitude";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {
      reference("robot", "robot", "the robot it flies").required(), real("roll", 0, -1, 1, "rad", "about x"),
      real("pitch", 0, -1, 1, "rad", "about y"), real("yaw_rate", 0, -9, 9, "rad/s", "about z")};

  explicit TestAttitude(Setup& s)
      : roll(s.value("roll")),
        pitch(s.value("pitch")),
        yaw_rate(s.value("yaw_rate")),
        asked(s.write<AttitudeThrust>("robot/{robot}/attitude_thrust")) {}

  void step(const Step& k) const {
    constexpr double weight = (0.68 + 4 * 0.009) * 9.81;  // [N]
    *k[asked] = {weight, k[roll], k[pitch], k[yaw_rate]};
  }

  Value roll, pitch, yaw_rate;
  Out<AttitudeThrust> asked;
};

}  // namespace

MUSTER_PLUGIN_IS(TestAttitude)
