// physics.ode in worlds: walls, doors and robots as obstacles; one process, several engines.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "tests/run_world.hpp"
#include "tests/sanitized.hpp"

namespace muster::test {
namespace {

// Robots that all drive forwards at 0.3 m/s.
class Forwards : public Simulation {
 public:
  Forwards(const Folder& folder, const std::string& inside, const std::string& attributes = "")
      : Simulation(read(folder, inside, attributes), standard(),
                   {{MUSTER_BUILD_DIR "/tests/conformance", MUSTER_PLUGINS_DIR}, 1, {}}) {}

  void run_to(uint64_t tick) {
    while (this->tick() < tick) step();
  }
  Pose pose(const std::string& robot) const { return row<Pose>(*this, "robot/" + robot + "/pose"); }

 private:
  static World read(const Folder& folder, const std::string& inside, const std::string& attributes) {
    folder.write("world.xml", "<world dt='0.01' until='60' seed='1'><material name='brick' loss='6'/>" + inside +
                                  "<physics.ode name='physics' " + attributes +
                                  "/><conformance.course v='0.3'/></world>");
    return read_world(folder.path(), standard());
  }
};

constexpr double front = 0.1;  // of a Scarab before its origin [m]
const std::string scarab = "<robot name='a' at='0 0 0'/>",
                  wall = "<wall name='w' from='1 -2' to='1 2' thickness='0.1' material='brick'/>";

TEST(OdeWorld, AWallStopsARobotUnlessObstaclesAreOff) {
  for (const std::string solver : {"exact", "quick"}) {
    const Folder folder;
    Forwards run(folder, scarab + wall, "solver='" + solver + "'");
    run.run_to(600);
    EXPECT_NEAR(run.pose("a").x, 0.95 - front, 2e-3) << solver;
    EXPECT_LT(std::abs(run.pose("a").z), 0.02) << solver;
  }
  const Folder folder;
  Forwards free(folder, scarab + wall, "obstacles='false'");
  free.run_to(600);
  EXPECT_NEAR(free.pose("a").x, 1.8, 0.02);
}

TEST(OdeWorld, DoorsLetThroughWhileTheyAreOpen) {
  const std::string door = scarab + wall + "<door name='d' wall='w' at='1.5' width='1' state='";
  for (const std::string state : {"open", "closed"}) {
    const Folder folder;
    Forwards run(folder, std::string(door).append(state).append("'/>"));
    run.run_to(600);
    EXPECT_NEAR(run.pose("a").x, state == "open" ? 1.8 : 0.95 - front, 0.02) << state;
  }
  const Folder folder;
  Forwards run(folder, door + "open'/><test.shut_doors at='0.5'/>");  // in front of the robot
  run.run_to(600);
  EXPECT_NEAR(run.pose("a").x, 0.95 - front, 2e-3);
}

TEST(OdeWorld, ALowDoorHasALintel) {
  const Folder folder;
  Forwards run(folder, scarab + wall + "<door name='d' wall='w' at='1.5' width='1' height='0.1' state='open'/>");
  run.run_to(600);
  EXPECT_LT(run.pose("a").x, 0.96);  // the Scarab is 15 cm high without its laser
}

TEST(OdeWorld, RobotsStopOneAnother) {
  const Folder folder;
  Forwards run(folder, scarab + "<robot name='b' at='1 0 0' heading='3.141592653589793'/>");
  run.run_to(400);
  EXPECT_NEAR(run.pose("b").x - run.pose("a").x, 2 * front, 4e-3);
}

// Contacts have an order of their own, not the one in ODE's spaces after recent motion.
TEST(OdeWorld, RemadeAmongContactsItGivesTheSameBits) {
  const std::string three = wall + "<robot name='c' at='0.5 0.3 0' heading='-1.2'/>" + scarab +
                            "<robot name='b' at='0.3 0.2 0' heading='-0.3'/>";
  for (const std::string solver : {"exact", "quick"}) {
    const Folder folder;
    Forwards run(folder, three, "solver='" + solver + "'"), remade(folder, three, "solver='" + solver + "'");
    run.run_to(200);
    while (remade.tick() < 200) {
      if (remade.tick() % 13 == 7) remade.remake("physics");
      remade.step();
    }
    EXPECT_EQ(run.digest(), remade.digest()) << solver;
  }
}

// The quick solver shuffles by ODE's global random numbers.
TEST(OdeWorld, RunsSideBySideChangeNothing) {
  const std::string two = scarab + wall + "<robot name='b' at='0.5 0.5 0' heading='-1'/>";
  const Folder folder;
  std::vector<std::unique_ptr<Forwards>> runs;
  runs.reserve(5);
  for (int i = 0; i < 5; ++i) runs.push_back(std::make_unique<Forwards>(folder, two, "solver='quick'"));
  runs[0]->run_to(150);
  std::vector<std::thread> threads;
  threads.reserve(4);
  for (int i = 1; i < 5; ++i) threads.emplace_back([&run = *runs[i]] { run.run_to(150); });
  for (std::thread& thread : threads) thread.join();
  for (int i = 1; i < 5; ++i) EXPECT_EQ(runs[i]->digest(), runs[0]->digest());
}

bool is_mapped(const std::string& library) { return contents("/proc/self/maps").find(library) != std::string::npos; }

TEST(OdeWorld, IsUnloadedWithItsLastInstance) {
  for (int round = 0; round < 3; ++round) {
    {
      const Folder folder;
      Forwards run(folder, scarab, "solver='quick'");
      run.run_to(5);
      EXPECT_TRUE(is_mapped("memfd:physics_ode.so"));
      run.reload("physics");
      run.run_to(10);
    }
    EXPECT_FALSE(is_mapped("memfd:physics_ode.so"));
  }
}

TEST(OdeWorld, WhatItLacksForARobotIsListed) {
  const std::string inertial =
      "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>";
  const auto hung = [&](const std::string& name, const std::string& kind, const std::string& on = "base") {
    return "<link name='" + name + "'>" + inertial + "</link><joint name='" + name + "_joint' type='" + kind +
           "'><parent link='" + on + "'/><child link='" + name +
           "'/><axis xyz='0 1 0'/><limit lower='0' upper='4' effort='1' velocity='1'/></joint>";
  };
  const auto message = [&](const std::string& links) -> std::string {
    const Folder folder;
    folder.write("arm.urdf", "<robot name='arm'><link name='base'>" + inertial + "</link>" + links + "</robot>");
    try {
      const Forwards run(folder, "<robot name='a' model='arm.urdf' at='0 0 0'/>");
    } catch (const Error& error) {
      EXPECT_EQ(error.exit(), Exit::invalid_input);
      return error.what();
    }
    return "nothing was thrown";
  };
  EXPECT_THAT(message(hung("lift", "planar") + hung("loose", "floating")),
              testing::HasSubstr("it lacks what the world's robots need: robot 'a' (model 'arm') needs "
                                 "joint 'lift_joint' (planar) without a motor, joint 'loose_joint' (floating) without "
                                 "a motor"));
  EXPECT_THAT(message(hung("elbow", "revolute") + hung("one", "prismatic") + hung("two", "prismatic") +
                      hung("three", "prismatic") + hung("four", "prismatic", "three")),
              testing::HasSubstr("cannot be simulated by physics.ode: joint 'elbow_joint' has limits beyond half a "
                                 "turn, which ODE does not see; it has more than four joints without motors"));
}

// With zero compliance, contacts of four points are one too many for ODE's exact solver: it gives one up and reports
// it, which is counted, not printed.
TEST(OdeWorld, ComplaintsAreCounted) {
  const Folder folder;
  Forwards run(folder, scarab + "<robot name='b' at='0.3 0 0'/>", "cfm='0' step='0.01'");
  testing::internal::CaptureStderr();
  run.run_to(100);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(run.table("instance/physics/complaints").at(0, 0), 0);
  ASSERT_FALSE(run.events().empty());
  EXPECT_EQ(run.events().back().message, "ODE complains of a step; self/complaints counts how often it does");
}

// ODE itself would end the process.
TEST(OdeWorld, AnAssertionOfOdesIsAnErrorOfItsStep) {
  const test::LeftBehind world;  // half changed
  const Folder folder;
  folder.write("heavy.urdf",
               "<robot name='heavy'><link name='base_link'><inertial><mass value='1e300'/><inertia ixx='1e300' ixy='0' "
               "ixz='0' iyy='1e300' iyz='0' izz='1e300'/></inertial><collision><geometry><box size='1 1 1'/></geometry>"
               "</collision></link></robot>");
  Forwards run(folder, "<robot name='h' model='heavy.urdf' at='0 0 1'/>");
  try {
    run.run_to(100);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit(), Exit::plugin_fault);
    EXPECT_THAT(error.what(),
                testing::HasSubstr("physics (physics.ode): step failed at tick 1 (t = 0.01 s): ODE gives up: "
                                   "assertion "));
  }
}

}  // namespace
}  // namespace muster::test
