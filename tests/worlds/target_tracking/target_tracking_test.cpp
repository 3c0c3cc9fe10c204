// worlds/target_tracking: robots meet no obstacle, say what they see, and come back where their link is lost.
#include <gtest/gtest.h>

#include "tests/worlds/target_tracking/tracked.hpp"

namespace muster::test {
namespace {

// The bodies of the obstacles are squares inside of their discs; a Scarab's corner is 0.12 m from its middle.
TEST(TargetTracking, NoScoutTouchesAnObstacleOrLeavesTheRoom) {
  const std::vector<tracking::Disc> obstacles{{-4, 5, 2}, {6, -6, 2.5}, {10, 7, 2}}, room{{0, 0, 30}};
  for (const bool aware : {true, false}) {
    Tracked run(aware);
    const tracking::NavigationFunction free({0, 0}, room, obstacles, 5);
    double least = INFINITY;
    while (!run.done()) {
      run.step();
      for (const char* scout : {"scout1", "scout2", "scout3"}) least = std::min(least, free.room(run.place(scout)));
    }
    EXPECT_GT(least, 0.13) << (aware ? "aware" : "unaware");
  }
}

TEST(TargetTracking, WhatIsHeardIsWhatWasDelivered) {
  Tracked run(true);
  while (!run.done()) run.step();
  double delivered = 0;
  for (const char* scout : {"scout1", "scout2", "scout3"})
    delivered += row<Traffic>(run, std::string("radio/") + scout + "/traffic").delivered;
  EXPECT_EQ(run.known().heard, delivered);
  EXPECT_GT(delivered, 100);
  const tracking::Vector2 target = run.place("target");
  EXPECT_NEAR(run.known().error, std::hypot(run.known().x - target.x, run.known().y - target.y), 1e-9);
}

// With next to no noise and no losses the base is two ticks late, by 3.5 cm, and goes straight on where the target
// turns.
TEST(TargetTracking, WithoutLossesTheBaseKnowsWhereTheTargetIs) {
  World world = tracking_world(false, 1);
  Simulation run(std::move(world), standard(), {{MUSTER_PLUGINS_DIR}, 1, {}});
  const auto with = [&](const std::string& id, const std::string& name,
                        const std::vector<std::pair<std::string, std::string>>& attributes) {
    InstanceDeclaration made{id, name, 1, {}, {}, {}, {"test"}};
    for (const auto& [key, value] : attributes) made.attributes.push_back({key, value, {"test"}, {"test"}});
    run.swap(name, made);
  };
  with("network.ideal", "network.ideal", {{"sensitivity", "-200"}});
  with("sensors.sighting", "sensors.sighting", {{"target", "target"}, {"noise", "0.01"}, {"growth", "0"}});
  double sum = 0, count = 0;
  while (!run.done()) {
    run.step();
    const Estimate known = row<Estimate>(run, "instance/known/estimate");
    if (run.time() > 20) sum += known.error, ++count;
  }
  EXPECT_LT(sum / count, 0.06);
}

TEST(TargetTracking, AnObstacleOfNegativeRadiusIsRefused) {
  const Folder folder;
  World world = tracking_world(true, 1);
  const std::string discs = folder.write("discs.csv", "x[m],y[m],radius[m]\n3,2,0.5\n4,2,-0.5\n").string();
  for (InstanceDeclaration& each : world.instances)
    for (XmlAttribute& given : each.attributes)
      if (given.name == "obstacles") given.value = discs;
  try {
    Simulation run(std::move(world), standard(), {{MUSTER_PLUGINS_DIR}, 1, {}});
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what())
                  .find(discs + ":3:5: column \"radius[m]\": -0.5 is negative; expected a number from 0, in m"),
              std::string::npos)
        << error.what();
  }
}

TEST(TargetTracking, KeepsTheLinkThatTheUnawareLose) {
  Tracked aware(true), unaware(false);
  double silence_aware = 0, silence_unaware = 0;
  while (!aware.done()) {
    aware.step(), unaware.step();
    silence_aware = std::max(silence_aware, aware.known().silence);
    silence_unaware = std::max(silence_unaware, unaware.known().silence);
  }
  EXPECT_LT(aware.lost(), unaware.lost());
  EXPECT_LT(silence_aware, silence_unaware);
}

}  // namespace
}  // namespace muster::test
