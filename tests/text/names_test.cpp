#include "text/names.hpp"

#include <gtest/gtest.h>

namespace muster {
namespace {

const std::vector<std::string> elements = {"wall", "walls", "robot", "material", "station", "door"};

TEST(Names, FindsTheNearest) {
  EXPECT_EQ(nearest("wlal", elements), "wall");
  EXPECT_EQ(nearest("robt", elements), "robot");
  EXPECT_EQ(nearest("ROBOT", elements), "robot");
  EXPECT_EQ(nearest("matreial", elements), "material");
  EXPECT_EQ(nearest("walls", elements), "walls");
  EXPECT_EQ(nearest("tx", {"rx", "t"}), "rx");
}

TEST(Names, CountsAnExchangeOfNeighboursAsOneError) {
  EXPECT_EQ(nearest("abdc", {"abcd"}), "abcd");  // two by plain Levenshtein, where the cut-off is one
  EXPECT_EQ(nearest("badc", {"abcd"}), "");
}

TEST(Names, IsSilentWhenNothingIsNear) {
  EXPECT_EQ(nearest("quadrotor", elements), "");
  EXPECT_EQ(nearest("x", {"y"}), "");
  EXPECT_EQ(nearest("", elements), "");
  EXPECT_EQ(nearest("wall", {}), "");
  EXPECT_EQ(nearest(std::string(60'000, 'w'), elements), "");
}

TEST(Names, SuggestsInOneLine) {
  EXPECT_EQ(suggest("bb", {"aa", "bbb", "cc"}), R"(expected one of aa, bbb, cc; did you mean "bbb"?)");
  EXPECT_EQ(suggest("quadrotor", elements), "expected one of wall, walls, robot, material, station, door");
  EXPECT_EQ(suggest("nmae", {"name"}), R"(expected name; did you mean "name"?)");
  EXPECT_EQ(suggest("name", {}), "none is expected here");
  const std::string list = expected_one_of(std::vector<std::string>(1000, "x"));
  EXPECT_TRUE(list.ends_with("x, x, ... (1000 in all)"));
  EXPECT_LT(list.size(), 150u);
}

TEST(Names, KnowsWhatOtherSimulatorsCallThings) {
  const std::vector<std::string> of_robot = {"name", "model", "at", "heading"}, of_station = {"name", "at", "yaw"};
  EXPECT_EQ(did_you_mean("yaw", of_robot), R"(; did you mean "heading"?)");
  EXPECT_EQ(did_you_mean("heading", of_station), R"(; did you mean "yaw"?)");
  EXPECT_EQ(did_you_mean("pose", of_robot), R"(; did you mean "at"?)");
  EXPECT_EQ(did_you_mean("duration", {"name", "dt", "until", "seed"}), R"(; did you mean "until"?)");
  EXPECT_EQ(did_you_mean("rate", {"every", "radio", "period"}), R"(; did you mean "period"?)");
  EXPECT_EQ(did_you_mean("rate", {"radio"}), "");  // what it means is not there
  EXPECT_EQ(did_you_mean("modle", of_robot), R"(; did you mean "model"?)");
}

TEST(Names, FindsANameByItsBeginningBeforeANearerOne) {
  EXPECT_EQ(did_you_mean("robot/*/odom", {"robot/*/body", "robot/*/odometry"}),
            R"(; did you mean "robot/*/odometry"?)");
  EXPECT_EQ(did_you_mean("robot/*/od", {"robot/*/body", "robot/*/odometry"}), "");  // too short to tell
  EXPECT_EQ(did_you_mean("radio.mult", {"radio.multiwall/none"}), R"()");  // that of a whole name, not of its path
}

TEST(Names, FindsANameByItsEnd) {
  EXPECT_EQ(did_you_mean("simbody", {"control.goal2d", "physics.simbody"}), R"(; did you mean "physics.simbody"?)");
  EXPECT_EQ(did_you_mean("speed", {"steer/turn_speed", "steer/speed"}), R"(; did you mean "steer/speed"?)");
  EXPECT_EQ(did_you_mean("n", {"radio.multiwall/n"}), "");  // would be found in too many
}

TEST(Names, OfALongListTheQuestionStandsFirst) {
  std::vector<std::string> many(25, "x");
  many[20] = "steer/speed";
  const std::string text = suggest("steer.speed", many);
  EXPECT_EQ(text.rfind(R"(did you mean "steer/speed"? expected one of x, x, )", 0), 0u) << text;
  EXPECT_EQ(suggest("nothing", many).rfind("expected one of x, x, ", 0), 0u);
}

TEST(Names, QuotesStayOnOneShortLine) {
  EXPECT_EQ(quote("a\nb\x7f"), R"("a\x0ab\x7f")");
  EXPECT_EQ(quote(std::string(61, 'a')), '"' + std::string(60, 'a') + "...\"");
  EXPECT_EQ(quote(std::string(59, 'a') + "é"), '"' + std::string(59, 'a') + "...\"");  // é has two bytes
}

TEST(Names, APathIsMeantByItsPartsAndByWhatTheyMeanElsewhere) {
  const std::vector<std::string> tables = {"robot/*/odometry", "robot/*/pose", "scan/*/message"};
  EXPECT_EQ(did_you_mean("/robot1/scan", tables), "; did you mean \"scan/*/message\"?");
  EXPECT_EQ(did_you_mean("/tf", tables), "; did you mean \"robot/*/pose\"?");
  EXPECT_EQ(did_you_mean("/robot1/pose", tables), "; did you mean \"robot/*/pose\"?");
  EXPECT_EQ(did_you_mean("/battery", tables), "");
  EXPECT_EQ(did_you_mean("robot/*/battery", {"robot/*/contact", "robot/*/drive"}), "");  // alike in what all have
  EXPECT_EQ(did_you_mean("goal_tolerance", {"goals", "tolerance"}), "; did you mean \"tolerance\"?");
  EXPECT_EQ(did_you_mean("node", {"controller", "robot"}), "; did you mean \"controller\"?");
}

}  // namespace
}  // namespace muster
