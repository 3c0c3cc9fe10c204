// A world extended by the settings of one measurement, tested on another.
#include <gtest/gtest.h>

#include "diagnosis/radio/links/link_model.hpp"
#include "tests/diagnosis/scratch.hpp"
#include "tests/diagnosis/worlds.hpp"

namespace muster::diagnosis {
namespace {

// Transmit power is 3 dB above the stated one at the lower of two settings, and 1 dB below at the higher.
const char* const extended =
    "<world name=\"w\" dt=\"1\" until=\"1\" seed=\"1\">\n"
    "  <station name=\"s\" at=\"0 0 0.5\"/>\n  <radio.multiwall l0=\"40\" n=\"2\"/>\n"
    "  <effect.power_steps file=\"then.csv\" error1=\"3\" error2=\"-1\"/>\n</world>\n";

std::string reading(int t, const std::string& power) {
  return std::to_string(t) + ",s,r,0,0,0.5,0,10,0,0.5,0,-60" + power + "\n";
}
const std::string columns =
    "t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],tx_yaw[rad],rx_x[m],rx_y[m],rx_z[m],rx_yaw[rad],rssi[dBm]";

TEST(Settings, AreThoseOfTheReadingsWhereTheyTellThem) {
  const Scratch scratch;
  const auto world = scratch.write("world.xml", extended);
  scratch.write("then.csv", "t[s],tx,power[dBm]\n0,s,-10\n5,s,0\n");
  const auto now = scratch.write("now.csv", columns + ",power[dBm]\n" + reading(0, ",0") + reading(5, ",-10"));
  EXPECT_TRUE(LinkModel(world, now, plugins).expected().isApprox(Eigen::Vector2d(-61, -57), 1e-12));
  // Readings without the setting, or with another unit, leave the world's value.
  for (const std::string name : {"", ",power[mW]"}) {
    const auto silent = scratch.write("silent.csv", columns + name + "\n" + reading(0, name.empty() ? "" : ",1") +
                                                        reading(5, name.empty() ? "" : ",0.1"));
    EXPECT_TRUE(LinkModel(world, silent, plugins).expected().isApprox(Eigen::Vector2d(-57, -61), 1e-12)) << name;
  }
}

// Plugins read the data's clock in the seconds that the data set has.
TEST(Settings, OfAClockInNanosecondsHoldInItsSeconds) {
  const Scratch scratch;
  const auto world =
      scratch.write("world.xml",
                    "<world name=\"w\" dt=\"1\" until=\"1\" seed=\"1\">\n  <station name=\"s\" at=\"0 0 0.5\"/>\n"
                    "  <radio.multiwall l0=\"40\" n=\"2\"/>\n  <effect.power_steps file=\"then.csv\" error1=\"3\" "
                    "error2=\"-1\"/>\n</world>\n");
  scratch.write("then.csv", "t[s],tx,power[dBm]\n0,s,-10\n1700000003,s,0\n");
  const auto at = [](const std::string& t) { return t + ",s,r,0,0,0.5,0,10,0,0.5,0,-60\n"; };
  const auto now = scratch.write("now.csv", columns + "\n" + at("1700000000000000000") + at("1700000005000000000"));
  EXPECT_TRUE(LinkModel(world, now, plugins).expected().isApprox(Eigen::Vector2d(-57, -61), 1e-12));
}

TEST(Settings, OfAFileThatIsNoTableAreLeftToItsReader) {
  const Scratch scratch;
  const auto world = scratch.write("world.xml", extended);
  scratch.write("then.csv", "t[s],t[s]\n");
  const auto now = scratch.write("now.csv", columns + "\n" + reading(0, ""));
  EXPECT_EQ(complaint([&] { LinkModel(world, now, plugins); }).substr(0, 8), "then.csv");
}

}  // namespace
}  // namespace muster::diagnosis
