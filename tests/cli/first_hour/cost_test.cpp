// What a run costs: by plugin and by link, and the same run.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/errors/program.hpp"

namespace muster::test {
namespace {

TEST(Row3, TheCostOfALinkIsTold) {
  const ProgramFolder folder;
  folder.write(
      "world.xml",
      "<world name=\"three\" dt=\"0.1\" until=\"5\"><station name=\"a\" at=\"0 0 1\"/><station name=\"b\" at=\"9 0 "
      "1\"/><station name=\"c\" at=\"0 9 1\"/><radio.multiwall name=\"channel\"/></world>");
  const auto told = [&](const std::vector<std::string>& words) {
    const Outcome outcome = folder.muster(words);
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    return outcome.out;
  };
  const auto plain = nlohmann::json::parse(told({"run", "world.xml", "--json"}));
  auto costly = nlohmann::json::parse(told({"run", "world.xml", "--json", "--cost"}));
  const nlohmann::json cost = costly["cost"];
  costly.erase("cost");
  EXPECT_EQ(costly, plain) << "the run is the same";
  EXPECT_EQ(cost["links"], 6);
  double before = 1e9;
  bool has_channel = false;
  for (const auto& each : cost["instances"]) {
    EXPECT_EQ(each["steps"], 50) << each;
    const double seconds = each["cpu_seconds"];
    EXPECT_GT(seconds, 0) << each;
    EXPECT_LE(seconds, before) << "the dearest stands first";
    before = seconds;
    if (each["instance"] != "channel") continue;
    has_channel = true;
    EXPECT_EQ(each["phase"], "RADIO");
    EXPECT_NEAR(each["seconds_a_link"], seconds / 50 / 6, 1e-12);
  }
  EXPECT_TRUE(has_channel);
  EXPECT_NE(told({"run", "world.xml", "--cost"}).find("  6 links, "), std::string::npos);
}

}  // namespace
}  // namespace muster::test
