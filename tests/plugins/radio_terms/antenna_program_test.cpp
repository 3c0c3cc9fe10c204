// Output of `muster probe` and `muster map` for antennas.
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/errors/program.hpp"

namespace muster::test {
namespace {

// An antenna that points north, on a radio in the middle.
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

struct Cell {
  std::string x, y;
  double rssi;
};

// A map of one radio.
std::vector<Cell> cells_of(const ProgramFolder& folder) {
  std::istringstream lines(folder.read("out/map.csv"));
  std::string line;
  std::getline(lines, line);
  std::vector<Cell> result;
  while (std::getline(lines, line)) {
    const auto first = line.find(','), last = line.rfind(',');
    result.push_back(
        {line.substr(0, first), line.substr(first + 1, last - first - 1), std::stod(line.substr(last + 1))});
  }
  return result;
}

TEST(AntennaProgram, MapShowsItsFrontAndItsBack) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(elements));
  const Outcome map = folder.muster(
      {"map", "world.xml", "--from", "base", "--area", "-1", "-11", "1", "11", "--cells", "11", "--out", "out"});
  ASSERT_EQ(map.exit, 0) << map.err;
  std::vector<double> rssi;  // from south to north
  for (const Cell& cell : cells_of(folder)) rssi.push_back(cell.rssi);
  ASSERT_EQ(rssi.size(), 11u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(rssi[10 - i] - rssi[i], 20, 1e-9) << i;
}

TEST(AntennaProgram, ARowOfItsTableIsToldWithItsLine) {
  const ProgramFolder folder;
  folder.write("gain.csv", "azimuth[rad],elevation[rad],gain[dBi]\n0,0,0\n-180,-90,0\n");
  folder.write("world.xml", world_of("<station name='base' at='0 0 1'/><station name='far' at='9 0 1'/>"
                                     "<radio.multiwall/><radio.receiver/>"
                                     "<radio.antenna radio='base' pattern='table' file='gain.csv'/>"));
  expect_error(
      folder.muster({"run", "world.xml"}), 2,
      "gain.csv:3: row 2 is azimuth -180.000, elevation -90.000; expected radians, an azimuth within -pi and pi "
      "and an elevation within -pi/2 and pi/2; are these degrees? a degree is 0.017453293 rad");
}

// Readings around a lobe with another orientation than the world's.
TEST(AntennaProgram, FitFindsWhereTheLobeIs) {
  const ProgramFolder folder;
  const auto write = [&](const std::string& azimuth) {
    folder.write("world.xml", world_of("<station name='base' at='0 0 1'/><radio.multiwall/><radio.receiver/>"
                                       "<radio.antenna name='panel' radio='base' pattern='cosine' azimuth='" +
                                       azimuth + "'/>"));
  };
  write("0.6");
  const Outcome map =
      folder.muster({"map", "world.xml", "--area", "-10", "-10", "10", "10", "--cells", "20", "--out", "out"});
  ASSERT_EQ(map.exit, 0) << map.err;
  std::string readings = "tx,rx,tx_x[m],tx_y[m],tx_z[m],rx_x[m],rx_y[m],rx_z[m],rssi[dBm]\n";
  int wrong = 1;  // dB, one too much and one too little in turn
  for (const Cell& cell : cells_of(folder)) {
    readings += "base,rover,0,0,1," + cell.x + ',' + cell.y + ",1," + std::to_string(cell.rssi + wrong) + '\n';
    wrong = -wrong;
  }
  folder.write("readings.csv", readings);
  write("0.1");
  const Outcome fit =
      folder.muster({"fit", "world.xml", "--data", "readings.csv", "--free", "panel/azimuth", "--json"});
  ASSERT_EQ(fit.exit, 0) << fit.err;
  const auto found = nlohmann::json::parse(fit.out);
  for (const auto& parameter : found["parameters"]) {
    if (parameter["name"] != "panel/azimuth") continue;
    EXPECT_NEAR(parameter["value"].get<double>(), 0.6, 0.02);
    return;
  }
  FAIL() << fit.out;
}

}  // namespace
}  // namespace muster::test
