// Measured data that are legal and look like another unit, site or world: each is asked about, in a note of the fit.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "program.hpp"

using namespace muster::test;
using testing::HasSubstr;
using testing::Not;

namespace {

const char* const walled =
    R"(<world name="w" dt="1" until="1">
<material name="drywall" loss="2"/>
<wall name="south" from="-1 -4" to="21 -4" material="drywall"/>
<wall name="north" from="-1 4" to="21 4" material="drywall"/>
<station name="base" at="0 0 1"/>
<station name="rover" at="5 0 1"/>
<radio.multiwall tx_power="0" l0="30" n="2.5"/>
</world>)";

struct Reading {
  double x, y, z, rssi;
};

// What the fit says of readings along a zigzag, each changed.
std::string said_of_data(const std::function<void(Reading&)>& change, const std::string& column = "",
                         const std::string& station = "0,0,1", const std::string& names = "base,rover",
                         const std::string& verb = "fit") {
  const ProgramFolder folder;
  folder.write("world.xml", walled);
  std::string text = "t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],rx_x[m],rx_y[m],rx_z[m],rssi[dBm]" +
                     (column.empty() ? "" : "," + column) + "\n";
  for (int i = 0; i < 60; ++i) {
    Reading r{1 + i * 0.3, i % 7 - 3.0, 1, 0};
    r.rssi = -40 - 20 * std::log10(std::hypot(r.x, r.y)) + (i * 7 % 5 - 2) * 0.4;
    change(r);
    text += fmt::format("{},{},{},{:.6f},{:.6f},{:.3f},{:.2f}{}\n", i, names, station, r.x, r.y, r.z, r.rssi,
                        column.empty() ? "" : fmt::format(",{}", i % 3));
  }
  folder.write("data.csv", text);
  const Outcome outcome = folder.muster({verb, "world.xml", "--data", "data.csv"});
  return outcome.out + outcome.err;
}

TEST(DataDoubts, NothingIsDoubtedOfSoundData) {
  EXPECT_THAT(said_of_data([](Reading&) {}), Not(HasSubstr("are th")));
}

TEST(DataDoubts, Centimetres) {
  EXPECT_THAT(said_of_data([](Reading& r) { r.x *= 100, r.y *= 100; }),
              HasSubstr("are they centimetres? expected metres"));
}

// A robot drives around the house, too; and a station that stands where the world has it, but for the unit, moves
// nowhere.
TEST(DataDoubts, CentimetresAroundTheWallsAndOfAStation) {
  const ProgramFolder folder;
  std::string world = walled;
  const std::string place = "at=\"0 0 1\"";
  folder.write("world.xml", world.replace(world.find(place), place.size(), "at=\"0 1 1\""));
  std::string text = "t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],rx_x[m],rx_y[m],rx_z[m],rssi[dBm]\n";
  for (int i = 0; i < 60; ++i)
    text += fmt::format("{},base,rover,0,100,100,{},{},100,{:.2f}\n", i, 100 + 40 * i, i % 2 ? 850 : -850,
                        -60 + (i * 7 % 5 - 2) * 0.4);
  folder.write("data.csv", text);
  const std::string said = folder.muster({"features", "world.xml", "--data", "data.csv"}).out;
  EXPECT_THAT(said, HasSubstr("and lie in it as centimetres; are they centimetres? expected metres"));
  EXPECT_THAT(said,
              HasSubstr("data.csv:1:12: \"base\" stands at x = 0, y = 100 m in the data and at x = 0, y = 1 m in the "
                        "world (world.xml:5:1), which is the same place in centimetres; are the data's? expected "
                        "metres (a map of muster import: tx_x[m] = 0.01*COLUMN, tx_y[m] alike)"));
  EXPECT_THAT(said, Not(HasSubstr("correct the world")));
}

// A circle around the base: rounded places leave rounding errors of the distance, of which nothing can be told.
TEST(DataDoubts, OneDistanceSettlesNoExponent) {
  const std::string said = said_of_data([i = 0](Reading& r) mutable {
    const double angle = 0.1 * i++;
    r.x = std::round(300 * std::cos(angle)) / 100, r.y = std::round(300 * std::sin(angle)) / 100;
    r.rssi = -50 + (i * 7 % 5 - 2) * 0.8;
  });
  for (const char* parameter : {"l0", "n"})
    EXPECT_THAT(said, testing::ContainsRegex(std::string("radio.multiwall/") + parameter + " +not identifiable"));
  EXPECT_THAT(said,
              HasSubstr("not identifiable: changing radio.multiwall/n by 1 together with radio.multiwall/l0 by -4."));
  EXPECT_THAT(said,
              HasSubstr(" dB only; all readings are at 2.99 to 3.01 m in plan: expected readings at other distances"));
}

TEST(DataDoubts, AnotherSite) {
  EXPECT_THAT(said_of_data([](Reading& r) { r.x += 600; }),
              HasSubstr("m beside the plan of the walls, 22 x 8 m; are they of another site, or from another origin?"));
}

TEST(DataDoubts, AnotherFrame) {
  EXPECT_THAT(
      said_of_data([](Reading& r) { r.x += 150, r.y += 320; }, "", "150,320,1"),
      HasSubstr(
          ":2:1: \"base\" stands at x = 150, y = 320 m in the data and at x = 0, y = 0 m in the world "
          "(world.xml:5:1); "
          "the data's place is used; where the data are right, correct the world to at=\"150 320 1\", and where the "
          "world is, the table; all places of the data lie outside of the world's walls, and inside if they are moved "
          "by "
          "-150, -320 m: are they of another frame? expected the plan's (a map of muster import: rx_x[m] = COLUMN "
          "- 150, rx_y[m] = COLUMN - 320, and tx_x, tx_y alike)"));
}

TEST(DataDoubts, NamesExchanged) {
  EXPECT_THAT(said_of_data([](Reading&) {}, "", "0,0,1", "rover,base"),
              HasSubstr("\"base\" moves in the data and stands at x = 0, y = 0 m in the world; the data's places "
                        "are used, in which \"rover\" stands there; are tx_x, tx_y and rx_x, rx_y exchanged in the "
                        "header, or the names in tx and rx? (a map of muster import: tx = the column of rx, rx = that "
                        "of tx)"));
}

TEST(DataDoubts, FeaturesAsksTheSame) {
  EXPECT_THAT(
      said_of_data([](Reading& r) { r.x *= 100, r.y *= 100; }, "", "0,0,1", "base,rover", "features"),
      HasSubstr(
          "data.csv:1:36: places of \"rover\" reach from x = 100, y = -300 to x = 1870, y = 300 m, far beyond the "
          "plan of the walls, 22 x 8 m, and lie in it as centimetres; are they centimetres? expected metres "
          "(a map of muster import: rx_x[m] = 0.01*COLUMN, rx_y[m] alike)\n"));
}

TEST(DataDoubts, Degrees) {
  EXPECT_THAT(said_of_data([](Reading& r) { r.x = 47.3 + r.x * 1e-5, r.y = 8.5 + r.y * 1e-5; }),
              HasSubstr("beside the plan of the walls; are these latitude and longitude?"));
}

TEST(DataDoubts, Heights) {
  EXPECT_THAT(
      said_of_data([](Reading& r) { r.z = 400; }),
      HasSubstr("data.csv:1:52: \"rover\" stands 400 m high, and the walls end at 2.7 m; are these millimetres?"));
  EXPECT_THAT(
      said_of_data([](Reading& r) { r.z = -0.4; }),
      HasSubstr(
          "data.csv:1:52: \"rover\" is 0.4 m or more below the ground (z = 0), throughout; is z down in the data, as "
          "in PX4 (NED)? expected metres up (a map of muster import: rx_z[m] = -1*COLUMN)"));
}

TEST(DataDoubts, Bel) {
  EXPECT_THAT(said_of_data([](Reading& r) { r.rssi /= 10; }), HasSubstr("; are these Bel? expected dBm"));
}

TEST(DataDoubts, WallsOfNoMaterial) {
  EXPECT_THAT(said_of_data([](Reading&) {}, "walls_brick"),
              HasSubstr("note: column \"walls_brick\": the world has no material \"brick\"; expected walls_drywall"));
}

// Formerly a crash, where the world has walls of a material that no column counts.
TEST(DataDoubts, DistancesInAWorldWithWalls) {
  const ProgramFolder folder;
  folder.write("world.xml", walled);
  std::string text = "t[s],tx,rx,distance[m],path_loss[dB]\n";
  for (int i = 0; i < 60; ++i)
    text += fmt::format("{},base,rover,{},{:.2f}\n", i, 1 + 0.3 * i,
                        35 + 22 * std::log10(1 + 0.3 * i) + (i * 7 % 5 - 2) * 0.4);
  folder.write("data.csv", text);
  for (const char* more : {"--json", "--average=dB"}) {
    const Outcome outcome = folder.muster({"fit", "world.xml", "--data", "data.csv", more});
    EXPECT_LE(outcome.exit, 1) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("radio.multiwall/n"));
  }
}

}  // namespace
