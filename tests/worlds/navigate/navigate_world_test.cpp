// What worlds/navigate is for: a planned way, a door that closes on it, another way; and every part in it exchanged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/folder.hpp"
#include "tests/run_world.hpp"

namespace muster::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::StartsWith;

const std::filesystem::path folder = MUSTER_SOURCE_DIR "/worlds/navigate";

struct Course {
  std::vector<std::string> said, heard;  // by the controller; by the base
  bool by_corridor = false, back_by_corridor = false;
  double reached = 0, plans = 0, cost = 0;  // cost of the first way
  double farthest = 0;                      // [m] east
};

// Words that the base has received in this tick.
void hear(const Simulation& run, std::vector<std::string>& words) {
  const Table& inbox = *run.board().find("inbox/*/message");
  const Set& radios = *run.board().find_set("radio");
  const Cells& cells = inbox.now();
  for (std::size_t i = 0; i < cells.rows; ++i) {
    const auto& message = *reinterpret_cast<const Incoming*>(cells.data.data() + i * inbox.width());
    if (cells.appended[i] != run.tick() || radios.names[static_cast<std::size_t>(message.radio)] != "base") continue;
    const auto& bytes = *cells.blobs[static_cast<std::size_t>(message.payload) - 1];
    words.emplace_back(bytes.begin(), bytes.end());
  }
}

// The world's run with its text changed.
Course course(const std::function<void(std::string&)>& change = {}) {
  const Folder copy;
  for (const char* file : {"walls.csv", "rssi.csv", "missions/rover.xml"}) copy.write(file, contents(folder / file));
  std::string text = contents(folder / "world.xml");
  if (change) change(text);
  Simulation run(read_world(copy.write("world.xml", text), standard()), standard(), {{MUSTER_PLUGINS_DIR}, 1, {}});
  Course result;
  while (!run.done()) {
    run.step();
    hear(run, result.heard);
    const Pose at = row<Pose>(run, "robot/rover/pose");
    const TableView state = run.table("instance/steer/state");
    result.farthest = std::max(result.farthest, at.x);
    const bool in_corridor = at.y > 4;
    (state.at(0, 4) > 0 ? result.back_by_corridor : result.by_corridor) |= in_corridor;
    result.reached = state.at(0, 4), result.plans = state.at(0, 5);
    if (result.plans == 1) result.cost = state.at(0, 8);
  }
  for (const auto& event : run.events()) {
    if (event.instance == "steer") result.said.push_back(event.message);
  }
  return result;
}

std::function<void(std::string&)> replacing(const std::string& what, const std::string& by) {
  return [=](std::string& text) {
    const auto at = text.find(what);
    ASSERT_NE(at, text.npos) << what;
    text.replace(at, what.size(), by);
  };
}

TEST(NavigateWorld, Row49ADoorClosesOnTheWayAndItGoesRoundByTheCorridor) {
  const Course rover = course();
  EXPECT_TRUE(rover.by_corridor);
  EXPECT_EQ(rover.reached, 2);
  EXPECT_THAT(rover.said, Contains(StartsWith("an obstacle is in the way: plans ")));
  EXPECT_THAT(rover.heard, ElementsAre("at the far end", "home"));
}

TEST(NavigateWorld, Row49WithTheDoorOpenItGoesStraightThrough) {
  const Course rover = course(replacing("value=\"closed\"", "value=\"open\""));
  EXPECT_FALSE(rover.by_corridor);
  EXPECT_EQ(rover.reached, 2);
}

TEST(NavigateWorld, Row49LaserRssiAndRoadmapAreEachExchanged) {
  const std::string laser = "laser=\"true\" ",
                    rssi = "rssi=\"rssi.csv\" station=\"base\" threshold=\"-65\" weight=\"0.05\"";
  const Course grid = course(replacing("method=\"visibility\"", "method=\"grid\" step=\"0.25\""));
  EXPECT_EQ(grid.reached, 2);
  EXPECT_TRUE(grid.by_corridor);
  const Course without_rssi = course(replacing(rssi, ""));
  EXPECT_EQ(without_rssi.reached, 2);
  EXPECT_LT(without_rssi.cost, course().cost);
  const Course careful = course(replacing("weight=\"0.05\"", "weight=\"0.5\""));
  EXPECT_EQ(careful.reached, 2);
  EXPECT_THAT(careful.said[0], testing::Not(testing::StrEq(course().said[0]))) << "the first way is another";
  const Course noisy = course(replacing("<sensors.laser name=\"laser\" noise=\"0.01\"/>",
                                        "<sensors.laser name=\"laser\" noise=\"0.03\" drop=\"0.1\" beam=\"0.006\"/>"));
  EXPECT_EQ(noisy.reached, 2);
  const Course blind = course(replacing(laser, ""));
  EXPECT_LT(blind.farthest, 8) << "the door stops it";
  EXPECT_GT(without_rssi.farthest, 10);
  EXPECT_EQ(course(replacing("physics.simbody", "physics.planar")).reached, 2);
  EXPECT_EQ(course(replacing("network.ideal", "network.lrwpan")).reached, 2);
}

}  // namespace
}  // namespace muster::test
