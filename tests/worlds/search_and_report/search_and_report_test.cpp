// What worlds/search_and_report is for: rooms searched and reported, links held, doors opened, one lost and one joined.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/run_world.hpp"

namespace muster::test {
namespace {

// As observe.chain writes it, a link a robot.
struct ChainLink {
  double level, rssi, smooth, distance, walls, below, share, worst, constant;
};
struct Chain {
  ChainLink links[3];
};

double x_of(const Simulation& run, const std::string& robot) { return row<Pose>(run, "robot/" + robot + "/pose").x; }

// Senders of a word that the base has received in this tick.
void hear(const Simulation& run, const std::string& word, std::set<std::string>& from) {
  const Table& inbox = *run.board().find("inbox/*/message");
  const Set& radios = *run.board().find_set("radio");
  const Cells& cells = inbox.now();
  for (std::size_t i = 0; i < cells.rows; ++i) {
    if (cells.appended[i] != run.tick()) continue;
    const auto& message = *reinterpret_cast<const Incoming*>(cells.data.data() + i * inbox.width());
    if (message.payload == 0 || radios.names[static_cast<std::size_t>(message.radio)] != "base") continue;
    const auto& bytes = *cells.blobs[static_cast<std::size_t>(message.payload) - 1];
    if (std::string(bytes.begin(), bytes.end()) == word)
      from.insert(radios.names[static_cast<std::size_t>(message.from)]);
  }
}

TEST(SearchAndReport, RoomsAreReportedAndLinksAreHeld) {
  Simulation run(read_world(MUSTER_SOURCE_DIR "/worlds/search_and_report", standard()), standard(),
                 {{MUSTER_PLUGINS_DIR}, 1, {}});
  std::set<std::string> searched;
  double farthest = 0, weakest = 0;
  while (!run.done()) {
    run.step();
    hear(run, "searched", searched);
    farthest = std::max(farthest, x_of(run, "lead"));
    for (const ChainLink& link : row<Chain>(run, "instance/chain/chain").links) {
      if (!std::isnan(link.smooth)) weakest = std::min(weakest, link.smooth);
    }
  }
  EXPECT_THAT(searched, testing::ElementsAre("reserve", "scout1", "scout3", "scout4"));
  EXPECT_GT(farthest, 22.5);  // 22 m from a base that it hears at -60 dBm 10 m away
  EXPECT_GT(weakest, -61.5);
  for (const char* door : {"north2", "south2"})
    EXPECT_EQ(row<DoorState>(run, std::string("door/") + door + "/state").open, 1);
  const Set& robots = *run.board().find_set("robot");
  EXPECT_EQ(robots.names.size(), 12u);
  EXPECT_EQ(std::count(robots.alive.begin(), robots.alive.end(), 1), 11);
  for (const char* robot : {"scout1", "scout3", "scout4", "reserve"})
    EXPECT_LT(x_of(run, robot), 5) << robot << " is home";
}

}  // namespace
}  // namespace muster::test
