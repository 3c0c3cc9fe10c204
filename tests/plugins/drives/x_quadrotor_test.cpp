// A Hummingbird with its rotors in X flies as the one with a plus does: roll, pitch and turns are those of the body.
#include "driven.hpp"

namespace muster::test {
namespace {

class XQuadrotors : public testing::TestWithParam<const char*> {
 protected:
  const Folder folder;
};
INSTANTIATE_TEST_SUITE_P(Backends, XQuadrotors,
                         testing::ValuesIn(built({"physics.simbody", "physics.ode", "physics.mujoco"})), name_of);

Pose after(const Folder& folder, const std::string& model, const std::string& physics, const std::string& asked) {
  const auto file = folder.write(
      "fly.xml", "<world name=\"w\" dt=\"0.002\" until=\"60\" seed=\"1\"><robot name=\"r\" model=\"" + model +
                     "\" at=\"0 0 20\"/><" + physics +
                     " name=\"physics\"/><robots.attitude/><test.attitude robot=\"r\" " + asked + "/></world>");
  Simulation run(read_world(file, standard()), standard(), options());
  run_to(run, 1);
  return row<Pose>(run, "robot/r/pose");
}

// Rotors speed up faster than they slow down, so a roll of a plus lifts and turns it a little, and one of an X does
// not.
TEST_P(XQuadrotors, FlyAsAPlusDoes) {
  const std::string x =
      model_with(folder, "hummingbird", {{"height=\"0.01\"", "height=\"0.01\" rotor_angle=\"0.7853981633974483\""}});
  for (const std::string asked :
       {"", "roll=\"0.1\"", "pitch=\"0.1\"", "yaw_rate=\"0.5\"", "roll=\"-0.1\" yaw_rate=\"-0.5\""}) {
    const Pose a = after(folder, "hummingbird", GetParam(), asked), b = after(folder, x, GetParam(), asked);
    EXPECT_NEAR(a.x, b.x, 3e-3) << asked;
    EXPECT_NEAR(a.y, b.y, 3e-3) << asked;
    EXPECT_NEAR(a.z, b.z, 3e-3) << asked;
    EXPECT_NEAR(yaw_of(a), yaw_of(b), 3e-3) << asked;
    if (asked.empty()) {
      EXPECT_NEAR(b.x, 0, 1e-9);
      EXPECT_NEAR(b.y, 0, 1e-9);
      EXPECT_NEAR(yaw_of(b), 0, 1e-9);
    }
    if (asked == "roll=\"0.1\"") {
      EXPECT_LT(b.y, -0.2);  // to the right
    }
    if (asked == "pitch=\"0.1\"") {
      EXPECT_GT(b.x, 0.2);  // ahead
    }
    if (asked == "yaw_rate=\"0.5\"") {
      EXPECT_GT(yaw_of(b), 0.1);  // to the left
    }
  }
}

}  // namespace
}  // namespace muster::test
