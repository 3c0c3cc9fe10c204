// What `muster probe` and `muster map` say of antennas.
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/errors/program.hpp"

namespace muster::test {
namespace {

// An antenna that looks north, on a radio in the middle.
const std::string elements =
    "<station name='base' at='0 0 1' yaw='1.5707963267948966'/><station name='far' at='0 40 1'/>"
    "<radio.multiwall/><radio.receiver/><radio.antenna name='panel' radio='base' pattern='sector' depth='20'/>";

TEST(AntennaProgram, ProbeHasALineForIt) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(elements));
  const Outcome probe = folder.muster({"probe", "world.xml", "base", "far", "--json"});
  ASSERT_EQ(probe.exit, 0) << probe.err;
  const auto budget = nlohmann::json::parse(probe.out);
  double gain = 0, sum = 0, level = 0;
  for (const auto& line : budget["lines"]) {
    if (line["instance"] == "panel") gain = line["value"];
    if (line["quantity"] != "rssi") (line["instance"] == "" ? level : sum) += line["value"].get<double>();
  }
  EXPECT_GT(gain, 5);
  EXPECT_LT(level, 0);
  EXPECT_DOUBLE_EQ(sum, level);
}

TEST(AntennaProgram, MapShowsItsFrontAndItsBack) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(elements));
  const Outcome map = folder.muster(
      {"map", "world.xml", "--from", "base", "--area", "-1", "-11", "1", "11", "--cells", "11", "--out", "out"});
  ASSERT_EQ(map.exit, 0) << map.err;
  std::istringstream cells(folder.read("out/map.csv"));
  std::string line;
  std::getline(cells, line);
  std::vector<double> rssi;  // from south to north
  while (std::getline(cells, line)) rssi.push_back(std::stod(line.substr(line.rfind(',') + 1)));
  ASSERT_EQ(rssi.size(), 11u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(rssi[10 - i] - rssi[i], 20, 1e-9) << i;
}

}  // namespace
}  // namespace muster::test
