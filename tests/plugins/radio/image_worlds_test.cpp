// Reflections in running worlds: the term's contribution to a link, reciprocal, and doors that reflect while closed.
#include <cmath>

#include "world_of.hpp"

namespace muster {
namespace {

const std::string mirror =
    "<material name=\"brick\" loss=\"7.5\"/>\n<wall name=\"w\" from=\"-50 0\" to=\"50 0\" height=\"3\" "
    "material=\"brick\"/>\n";
const std::string quiet = "<radio.multiwall/><radio.receiver sensitivity=\"-250\"/>\n";
const char* const paths = "link/*/level@radio.images.paths";

TEST(ImageTerm, IsTheInterferenceOfTwoWaves) {
  for (const bool coherent : {true, false}) {
    const Folder folder;
    Simulation world = world_of(folder, mirror + station("a", "0 3 1") + station("b", "8 3 1") +
                                            "<radio.images permittivity=\"4\" reflection=\"0.5\" frequency=\"1e9\"" +
                                            (coherent ? "" : " coherent=\"false\"") + "/>" + quiet);
    run(world, 1);
    // d = 8, e = 10; the cosine to the normal is 0.6.
    const double inside = std::sqrt(3 + 0.36), share = 0.5 * (0.6 - inside) / (0.6 + inside) * 0.8;
    const double behind = 2 * M_PI * 2 * 1e9 / 299792458;
    const double power = 1 + share * share + (coherent ? 2 * share * std::cos(behind) : 0);
    EXPECT_NEAR(by_pair(world, paths).at({"a", "b"}), 10 * std::log10(power), 1e-9);
    const double level = by_pair(world, "link/*/level").at({"a", "b"});
    EXPECT_NEAR(level, -40 - 20 * std::log10(8) + 10 * std::log10(power), 1e-9);
  }
}

// The direct wave passes a floor that the reflected one, by the mirror beside it, goes round.
TEST(ImageTerm, GoesRoundAFloor) {
  const auto gained = [](const std::string& floor) {
    const Folder folder;
    Simulation world = world_of(folder,
                                "<material name=\"brick\" loss=\"7.5\"/>\n"
                                "<wall name=\"w\" from=\"-50 0\" to=\"50 0\" height=\"6\" material=\"brick\"/>\n" +
                                    floor + station("a", "0 3 1") + station("b", "8 3 5") +
                                    "<radio.images coherent=\"false\"/>" + quiet);
    run(world, 1);
    return std::pow(10, by_pair(world, paths).at({"a", "b"}) / 10) - 1;  // power of the reflected wave to the direct's
  };
  const double free = gained("");
  EXPECT_GT(free, 0.01);
  const std::string floor = "<floor corners=\"2 2 6 2 6 4 2 4\" z=\"3\" material=\"brick\"/>\n";
  EXPECT_NEAR(gained(floor) / free, std::pow(10, 0.75), 1e-9);
}

TEST(ImageTerm, IsTheSameBothWaysBitForBit) {
  const Folder folder;
  std::string walls = mirror;
  for (int i = 0; i < 12; ++i) {
    const std::string x = std::to_string(i * 1.37 - 7), y = std::to_string(4.1 - i * 0.3);
    walls += "<wall name=\"w" + std::to_string(i) + "\" from=\"" + x + ' ' + y + "\" to=\"" + y + ' ' + x +
             "\" height=\"3\" material=\"brick\"/>\n";
  }
  Simulation world =
      world_of(folder, walls + station("a", "0 3 1") + station("b", "8.1 3.3 1.2") + station("c", "-3.3 1.1 0.2") +
                           station("d", "-3.3 5.2 2") + "<radio.images bounces=\"2\"/>" + quiet);
  run(world, 1);
  const auto values = by_pair(world, paths);
  ASSERT_EQ(values.size(), 12u);
  int reflected = 0;
  for (const auto& [pair, value] : values) {
    EXPECT_TRUE(same_bits(value, values.at({pair.second, pair.first})));
    reflected += value != 0;
  }
  EXPECT_EQ(reflected, 12);
}

// Behind a screen of 40 dB, a wave by the side wall keeps the link alive.
TEST(ImageTerm, GoesRoundAScreen) {
  const std::string screened = mirror +
                               "<material name=\"steel\" loss=\"40\"/><wall name=\"screen\" from=\"4 2\" to=\"4 9\" "
                               "height=\"3\" material=\"steel\"/>\n";
  const Folder folder;
  Simulation world = world_of(
      folder, screened + station("a", "0 3 1") + station("b", "8 3 1") + "<radio.images coherent=\"false\"/>" + quiet);
  run(world, 1);
  const double inside = std::sqrt(4 + 0.36), share = (0.6 - inside) / (0.6 + inside) * 0.8;
  EXPECT_NEAR(by_pair(world, "link/*/level").at({"a", "b"}),
              -40 - 20 * std::log10(8) - 40 + 10 * std::log10(1 + share * share * 1e4), 1e-9);
}

}  // namespace
}  // namespace muster
