// physics.simbody in a world: a run is a function of its tables, independent of instances and workers.
#include "physics_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;

const std::string course = std::string(two_scarabs) + R"(<test.wheels v="0.3" dv="0.1" dw="0.6"/>)";

TEST(Simbody, IsTheBackendOfAWorldThatNamesNone) {
  Folder folder;
  Simulation run = world_of(folder, two_scarabs + std::string(R"(<test.wheels v="0.3"/><robots.odometry/>)"));
  run_to(run, 200);
  const auto pose = row<Pose>(run, "robot/a/pose");
  EXPECT_NEAR(std::hypot(pose.x, pose.y), 0.6, 0.02);
  EXPECT_NEAR(std::atan2(pose.y, pose.x), 0.3, 1e-3);
}

TEST(Simbody, ArcHasRadiusOfSpeedOverTurnRate) {
  Folder folder;
  Simulation run = world_of(folder, R"(<robot name="a" at="0 0 0"/><test.wheels v="0.3" w="0.5"/><physics.simbody/>)");
  run_to(run, 200);  // it has settled
  const auto start = row<Pose>(run, "robot/a/pose");
  const double yaw = 2 * std::atan2(start.qz, start.qw), radius = 0.6;
  const double cx = start.x - radius * std::sin(yaw), cy = start.y + radius * std::cos(yaw);
  for (int k = 0; k < 600; ++k) {
    run.step();
    const auto pose = row<Pose>(run, "robot/a/pose");
    ASSERT_NEAR(std::hypot(pose.x - cx, pose.y - cy), radius, 1e-3 * radius);
  }
}

TEST(Simbody, DigestIsTheSameForAnyWorkersAndAfterRemaking) {
  for (const char* integrator : {"midpoint", "rk3"}) {
    Folder folder;
    const std::string world = course + "<physics.simbody name=\"physics\" step=\"0.005\" integrator=\"" + integrator +
                              "\"/><robots.odometry/>";
    Simulation straight = world_of(folder, world);
    run_to(straight, 60);
    Simulation three = world_of(folder, world, 3);
    run_to(three, 60);
    EXPECT_EQ(straight.digest(), three.digest()) << integrator;
    Simulation remade = world_of(folder, world);
    while (remade.tick() < 60) {
      if (remade.tick() % 17 == 5) remade.remake("physics");
      remade.step();
    }
    EXPECT_EQ(straight.digest(), remade.digest()) << integrator;
  }
}

TEST(Simbody, RestoredRunGoesOnWithTheSameBits) {
  Folder folder;
  const std::string world = course + "<physics.simbody/>";
  Simulation run = world_of(folder, world);
  run_to(run, 40);
  run.snapshot().save(folder / "at40");
  run_to(run, 80);
  Simulation again = world_of(folder, world);
  again.restore(Snapshot::load(folder / "at40"));
  run_to(again, 80);
  EXPECT_EQ(run.digest(), again.digest());
}

TEST(Simbody, RowIsAsHandedInBeforeTheFirstStep) {
  Folder folder;
  Simulation run = world_of(folder, R"(<robot name="a" at="1.1 2.2 0" heading="0.7"/><physics.simbody/>)");
  const auto pose = row<Pose>(run, "robot/a/pose");
  EXPECT_EQ(pose.x, 1.1);
  EXPECT_EQ(pose.qz, std::sin(0.35));
}

TEST(Simbody, StepCanBeChangedInMidRun) {
  Folder folder;
  Simulation run = world_of(folder, course + "<physics.simbody name=\"physics\"/>");
  run_to(run, 20);
  run.set_parameter("physics/step", 0.01);
  run_to(run, 40);
  Simulation other = world_of(folder, course + "<physics.simbody name=\"physics\"/>");
  run_to(other, 40);
  const auto a = row<Pose>(run, "robot/a/pose"), b = row<Pose>(other, "robot/a/pose");
  EXPECT_NE(a.x, b.x);
  EXPECT_NEAR(a.x, b.x, 1e-4);
}

// A wall half a metre ahead, with a door where the robot meets it.
double reached(const std::string& door) {
  Folder folder;
  Simulation run = world_of(
      folder, R"(<material name="board" loss="1"/>
    <wall name="w" from="0.5 -1" to="0.5 1" thickness="0.1" material="board"/>)" +
                  door + R"(<robot name="a" at="0 0 0"/><test.wheels v="0.3"/><physics.simbody step="0.01"/>)");
  run_to(run, 400);
  return row<Pose>(run, "robot/a/pose").x;
}

TEST(Simbody, WallsAndClosedDoorsStopRobotsAndOpenDoorsDoNot) {
  EXPECT_NEAR(reached(""), 0.35, 1e-3);
  EXPECT_NEAR(reached(R"(<door name="d" wall="w" at="0.5" width="1" state="closed"/>)"), 0.35, 1e-3);
  EXPECT_NEAR(reached(R"(<door name="d" wall="w" at="0.5" width="1" state="open"/>)"), 1.2, 0.05);
  EXPECT_NEAR(reached(R"(<door name="d" wall="w" at="0.5" width="1" height="0.1" state="open"/>)"), 0.35, 1e-3);
}

// Six robots that push towards one place.
std::string jam() {
  std::string inside;
  for (int i = 0; i < 6; ++i) {
    const double angle = 1.0471975511965976 * i;
    inside += "<robot name=\"r" + std::to_string(i) + "\" at=\"" + std::to_string(0.4 * std::cos(angle)) + " " +
              std::to_string(0.4 * std::sin(angle)) + " 0\" heading=\"" + std::to_string(angle + 3.2) + "\"/>";
  }
  return inside + R"(<test.wheels v="0.3"/><physics.simbody name="physics" step="0.01"/>)";
}

TEST(Simbody, JamIsTheSameForAnyWorkersAfterRestoreAndAfterRemaking) {
  Folder folder;
  Simulation run = world_of(folder, jam());
  run_to(run, 150);
  run.snapshot().save(folder / "at150");
  run_to(run, 300);
  const auto a = row<Pose>(run, "robot/r0/pose"), b = row<Pose>(run, "robot/r3/pose");
  EXPECT_LT(std::hypot(a.x - b.x, a.y - b.y), 0.7);  // they are in each other's way,
  EXPECT_GT(std::hypot(a.x - b.x, a.y - b.y), 0.2);  // not in each other
  Simulation three = world_of(folder, jam(), 3);
  run_to(three, 300);
  EXPECT_EQ(run.digest(), three.digest());
  Simulation restored = world_of(folder, jam());
  restored.restore(Snapshot::load(folder / "at150"));
  run_to(restored, 300);
  EXPECT_EQ(run.digest(), restored.digest());
  Simulation remade = world_of(folder, jam());
  while (remade.tick() < 300) {
    if (remade.tick() % 17 == 5) remade.remake("physics");
    remade.step();
  }
  EXPECT_EQ(run.digest(), remade.digest());
}

TEST(Simbody, ModelsItCannotHoldAreRefused) {
  Folder folder;
  const std::string mass =
      "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>";
  folder.write("box.urdf", "<robot name='box'><link name='l'>" + mass + "</link><link name='loose'>" + mass +
                               "</link><joint name='j' type='floating'><parent link='l'/><child link='loose'/></joint>"
                               "</robot>");
  for (const std::string backend : {"simbody", "planar"}) {
    try {
      world_of(folder, "<robot name=\"a\" at=\"0 0 0\" model=\"" + (folder / "box.urdf").string() + "\"/><physics." +
                           backend + "/>");
      FAIL() << "nothing was thrown";
    } catch (const Error& error) {
      EXPECT_EQ(error.exit(), Exit::invalid_input);
      EXPECT_THAT(std::string(error.what()),
                  testing::HasSubstr("it lacks what the world's robots need: robot 'a' (model 'box') needs joint 'j' "
                                     "(floating) without a motor"));
      EXPECT_THAT(std::string(error.what()), testing::HasSubstr("physics." + backend));
    }
  }
}

TEST(Simbody, ModelBesideTheWorldIsFound) {
  Folder folder;
  std::filesystem::copy(MUSTER_SOURCE_DIR "/plugins/robots/models/hokuyo.stl", folder / "hokuyo.stl");
  std::filesystem::copy(MUSTER_SOURCE_DIR "/plugins/robots/models/scarab.urdf", folder / "mine.urdf");
  Simulation run = world_of(folder, "<robot name=\"a\" at=\"0 0 0\" model=\"mine.urdf\"/><physics.simbody/>");
  run.step();
  EXPECT_THROW(world_of(folder, "<robot name=\"a\" at=\"0 0 0\" model=\"yours.urdf\"/><physics.simbody/>"), Error);
}

TEST(Simbody, BadModelIsRefusedWithItsLine) {
  Folder folder;
  const std::string urdf = folder.write("bad.urdf",
                                        "<robot name='r'>\n<link name='l'><inertial><mass value='-1'/>"
                                        "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>"
                                        "</link></robot>");
  try {
    world_of(folder, "<robot name=\"a\" at=\"0 0 0\" model=\"" + urdf + "\"/><physics.simbody/>");
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.exit(), Exit::invalid_input);
    EXPECT_THAT(std::string(error.what()),
                testing::HasSubstr(urdf + ":2: link 'l': <mass value=\"-1\"/>; expected the mass in kg, above 0"));
  }
}

}  // namespace
