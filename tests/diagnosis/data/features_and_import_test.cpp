// Features against figures computed by hand, and foreign tables converted to the format.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/data/table_import.hpp"
#include "tests/diagnosis/scratch.hpp"
#include "tests/diagnosis/worlds.hpp"

namespace muster::diagnosis {
namespace {

TEST(Features, ByHand) {
  const Scratch scratch;
  const auto world = scratch.write("world.xml",
                                   "<world name=\"w\" dt=\"1\" until=\"1\" seed=\"1\">\n"
                                   "  <material name=\"brick\" loss=\"6\"/>\n  <material name=\"glass\" loss=\"1\"/>\n"
                                   "  <wall name=\"a\" from=\"2 -5\" to=\"2 5\" material=\"brick\"/>\n"
                                   "  <wall name=\"b\" from=\"3 -5\" to=\"3 5\" height=\"1\" material=\"glass\"/>\n"
                                   "  <station name=\"s\" at=\"0 0 0.5\"/>\n  <radio.multiwall/>\n</world>\n");
  const auto file =
      scratch.write("d.csv",
                    "tx,rx,tx_x[m],tx_y[m],tx_z[m],tx_yaw[rad],rx_x[m],rx_y[m],rx_z[m],rx_yaw[rad],rssi[dBm]\n"
                    "s,r,0,0,0.5,0,4,0,0.5,0,-50\n"                     // straight through both
                    "s,r,0,0,0.5,0,4,4,2.5,1.5707963267948966,-51\n"    // at 45 degrees, over the glass
                    "s,r,0,0,0.5,1.5707963267948966,0,3,0.5,0,-52\n");  // along the free side
  const Features f = features_of(LinkModel(world, file, plugins));
  const double pi = 3.141592653589793;
  EXPECT_DOUBLE_EQ(f.distance[0], 4);
  EXPECT_DOUBLE_EQ(f.distance[1], 6);
  EXPECT_EQ(f.by_material, (std::vector<std::vector<int>>{{1, 1, 0}, {1, 0, 0}}));
  EXPECT_NEAR(f.azimuth[1], pi / 4, 1e-12);
  EXPECT_NEAR(f.elevation[1], std::atan2(2, std::sqrt(32.0)), 1e-12);
  EXPECT_NEAR(f.tx_bearing[2], 0, 1e-12);
  EXPECT_NEAR(f.rx_bearing[0], pi, 1e-12);
  EXPECT_NEAR(f.rx_bearing[1], 3 * pi / 4,
              1e-9);  // to the south-west, with a heading to the north: behind, to the left
  EXPECT_NEAR(f.incidence[0], 0, 1e-9);
  EXPECT_TRUE(std::isnan(f.incidence[2]));
  EXPECT_EQ(f.crossed, (std::vector<int>{0, 1, 0}));
}

// A floor counts by its material, and not as a wall.
TEST(Features, OfAFloor) {
  const Scratch scratch;
  const auto world = scratch.write("world.xml",
                                   "<world name=\"w\" dt=\"1\" until=\"1\" seed=\"1\">\n"
                                   "  <material name=\"brick\" loss=\"6\"/>\n"
                                   "  <wall name=\"a\" from=\"3 -5\" to=\"3 5\" height=\"6\" material=\"brick\"/>\n"
                                   "  <floor name=\"f\" corners=\"0 -5 9 -5 9 5 0 5\" z=\"3\" material=\"brick\"/>\n"
                                   "  <station name=\"s\" at=\"0 0 1\"/>\n  <radio.multiwall/>\n</world>\n");
  const auto file = scratch.write("d.csv",
                                  "tx,rx,tx_x[m],tx_y[m],tx_z[m],rx_x[m],rx_y[m],rx_z[m],rssi[dBm]\n"
                                  "s,r,0,0,1,4,0,5,-50\ns,r,0,0,1,2,0,5,-50\ns,r,0,0,1,4,0,2,-50\n");
  const Features f = features_of(LinkModel(world, file, plugins));
  EXPECT_EQ(f.by_material, (std::vector<std::vector<int>>{{2, 1, 1}}));
  EXPECT_EQ(f.crossed, (std::vector<int>{0, 0}));
  EXPECT_EQ(f.first, (std::vector<std::size_t>{0, 1, 1, 2}));
  EXPECT_NEAR(f.incidence[1], std::atan2(2, 4), 1e-12);
}

TEST(Features, AnglesAreWrapped) {
  EXPECT_NEAR(wrapped(7), 7 - 2 * 3.141592653589793, 1e-12);
  EXPECT_DOUBLE_EQ(wrapped(-3.141592653589793), 3.141592653589793);
}

const char* wide_map =
    "# three anchors that hear one robot\n"
    "for i = 1 2\n"
    "table anchors = anchors.csv id {i}\n"
    "none rssi = 0\n"
    "t[s] = 0.001*ms - 5\n"
    "tx = \"robot\"\n"
    "rx = \"anchor{i}\"\n"
    "tx_x[m] = 0.001*px\n"
    "tx_y[m] = 0.001*py\n"
    "tx_yaw[rad] = 0.017453292519943295*heading\n"
    "rx_x[m] = anchors.x\n"
    "rx_y[m] = anchors.y\n"
    "rssi[dBm] = rssi_{i}\n"
    "phone = name phone\n";

TEST(Import, WideToLongWithUnitsAndAnchors) {
  const Scratch scratch;
  scratch.write("anchors.csv", "id,x,y\n1,5,0\n2,0,7.5\n");
  const auto file = scratch.write(
      "wide.csv",
      ";ms;px;py;heading;rssi_1;rssi_2;phone\n0;5000;1000;2000;90;-50;nan;p\n1;5500;1500;2000;180;-51.5;0;p\n");
  const auto map = scratch.write("wide.map", wide_map);
  const Imported done = import_table({file}, map, scratch / "out.csv");
  EXPECT_EQ(done.rows, 4u);
  EXPECT_EQ(done.empty, 2u);
  EXPECT_EQ(contents(scratch / "out.csv"),
            "t[s],tx,rx,tx_x[m],tx_y[m],tx_yaw[rad],rx_x[m],rx_y[m],rssi[dBm],phone\n"
            "0,robot,anchor1,1,2,1.5707963267948966,5,0,-50,p\n"
            "0,robot,anchor2,1,2,1.5707963267948966,0,7.5,,p\n"
            "0.5,robot,anchor1,1.5,2,3.141592653589793,5,0,-51.5,p\n"
            "0.5,robot,anchor2,1.5,2,3.141592653589793,0,7.5,,p\n");
  const auto said = [&](const std::string& words) {
    return std::any_of(done.assumed.begin(), done.assumed.end(),
                       [&](const std::string& s) { return s.find(words) != s.npos; });
  };
  EXPECT_TRUE(said("cells are separated by ';'"));
  EXPECT_TRUE(said("tx_x[m] = 0.001 x \"px\""));
  EXPECT_TRUE(said("each row of the file gives 2 readings"));
  EXPECT_TRUE(said("columns that are not used: \"column1\""));
  EXPECT_TRUE(said("radians"));
}

TEST(Import, AColumnNamedAfterAnotherUnitIsAskedAbout) {
  const Scratch scratch;
  const auto file =
      scratch.write("a.csv", "x_cm,y (mm),t_ms,power_mW,yaw_deg,x_min,rssi\n1,2,3,4,5,6,-50\n2,3,4,5,6,7,-51\n");
  const auto map =
      scratch.write("m.map",
                    "tx = \"a\"\nrx = \"b\"\ntx_x[m] = x_min\ntx_y[m] = 0.01*x_cm\nrx_x[m] = x_cm\nrx_y[m] = y "
                    "(mm)\nrx_yaw[rad] = yaw_deg\nrssi[dBm] = rssi\n");
  const Imported done = import_table({file}, map, scratch / "out.csv");
  const auto said = [&](const std::string& line) {
    return std::count(done.assumed.begin(), done.assumed.end(), line) == 1;
  };
  EXPECT_TRUE(
      said("rx_x[m] = \"x_cm\", taken to be in m; is it in cm? expected rx_x[m] = 0.01*x_cm in line 5 of the map"));
  EXPECT_TRUE(said(
      "rx_y[m] = \"y (mm)\", taken to be in m; is it in mm? expected rx_y[m] = 0.001*y (mm) in line 6 of the map"));
  EXPECT_TRUE(
      said("rx_yaw[rad] = \"yaw_deg\", taken to be in rad; is it in deg? expected rx_yaw[rad] = "
           "0.017453292519943295*yaw_deg in line 7 of the map"));
  EXPECT_TRUE(said("tx_x[m] = \"x_min\", taken to be in m"));
  EXPECT_TRUE(said("tx_y[m] = 0.01 x \"x_cm\""));
}

TEST(Import, WhatDoesNotFitIsNamed) {
  const Scratch scratch;
  scratch.write("anchors.csv", "id,x,y\n1,5,0\n");
  const auto file = scratch.write("wide.csv", "ms,px,py,heading,rssi_1,rssi_2,phone\n5000,1000,2000,90,-50,-50,p\n");
  const auto failing = [&](const std::string& text) {
    const auto map = scratch.write("m.map", text);
    return complaint([&] { import_table({file}, map, scratch / "out.csv"); });
  };
  EXPECT_NE(failing(wide_map).find("has no row whose \"id\" is \"2\""), std::string::npos);
  const std::string by_place = "table a = anchors.csv id {px}\ntx_x[m] = a.x\n";
  const std::string anchors = (scratch / "anchors.csv").string(), wide = (scratch / "wide.csv").string();
  EXPECT_EQ(failing(by_place),
            "m.map:2: " + anchors + " has no row whose \"id\" is \"1000\", as in line 2 of " + wide + "; expected 1");
  scratch.write("anchors.csv", "id,x,y\n90,5,0\n");
  EXPECT_EQ(failing(by_place), "m.map:1: id {px} is \"1000\" in line 2 of " + wide + ", and " + anchors +
                                   " has no such \"id\"; expected a column that has, such as {heading}");
  EXPECT_NE(failing("rssi[dBm] = rsi_1\n").find("did you mean \"rssi_1\"?"), std::string::npos);
  EXPECT_EQ(failing("for i in 1 2 3\n"), "m.map:1: \"for i in 1 2 3\" has no '='; expected for i = 1 2 3");
  EXPECT_EQ(failing("rssi[dBm] rssi_1\n"), "m.map:1: \"rssi[dBm] rssi_1\" has no '='; expected COLUMN[UNIT] = RULE");
  EXPECT_EQ(
      failing("x[m] = 0,001*px\n"),
      "m.map:1: \"0,001\" is not a number; a decimal point is written '.'; expected SCALE*COLUMN + OFFSET, such as "
      "0.001*ms + 0.5");
  EXPECT_EQ(failing("x[m] = px\nx[m] = py\n"), "m.map:2: column \"x\" is mapped twice");
  EXPECT_EQ(failing("# nothing\n"), "m.map: no column is mapped; expected lines such as rssi[dBm] = rssi");
}

// Two anchors receive from one robot. Errors name lines of the source, since the user has not seen rows of the
// result.
TEST(Import, WhatIsRefusedIsNamedAsItStandsInTheSource) {
  const Scratch scratch;
  scratch.write("anchors.csv", "id,x,y\n1,5,0\n2,0,7.5\n");
  const auto file = scratch.write("wide.csv",
                                  "ms,px,py,heading,rssi_1,rssi_2,phone\n5000,1000,2000,90,-50,-50,p\n"
                                  "6000,1000,2000,90,-51,-50,p\n\n6000,1000,2000,90,-51,-50,p\n");
  scratch.write("out.csv", "what was there before");
  const auto failing = [&](const std::string& rules) {
    const auto map = scratch.write("m.map", rules);
    std::string words = complaint([&] { import_table({file}, map, scratch / "out.csv"); });
    EXPECT_EQ(contents(scratch / "out.csv"), "what was there before");
    EXPECT_FALSE(std::filesystem::exists(scratch / "out.csv.part"));
    return words;
  };
  const auto with = [&](const std::string& rule, const std::string& other) {
    std::string rules = wide_map;
    return rules.replace(rules.find(rule), rule.size(), other);
  };
  EXPECT_EQ(failing(wide_map),
            "wide.csv:5: with i = 1: robot -> anchor1 at t = 1 s repeats line 3 with i = 1; expected each (t, tx, rx) "
            "once");
  EXPECT_EQ(failing(with("tx_y[m] =", "tx_y[cm] =")),
            "m.map:9: column \"tx_y[cm]\" has the wrong unit; expected \"tx_y[m]\": tx_y[m] = 1e-05*py");
  EXPECT_EQ(failing(with("tx_y[m] =", "rx_yaw[deg] = heading\ntx_y[m] =")),
            "m.map:9: column \"rx_yaw[deg]\" has the wrong unit; expected \"rx_yaw[rad]\": rx_yaw[rad] = "
            "0.017453292519943295*heading");
  EXPECT_EQ(failing(with("tx_y[m] =", "tx_y =")),
            "m.map:9: column \"tx_y\" has no unit; expected \"tx_y[m]\", and SCALE*COLUMN where that differs");
  EXPECT_EQ(failing(with("tx_y[m] =", "px = rx_x[m]\ntx_y[m] =")),
            "m.map:9: the rule is the wrong way round: a column of the result stands on the left, and one of " +
                file.string() + " on the right; expected rx_x[m] = px");
  EXPECT_EQ(failing(with("tx_y[m] =", "tx_y[m] = secs + 1e-9*nsecs\nnote =")),
            "m.map:9: \"1e-9*nsecs\" is no number, and a rule takes one column, SCALE*COLUMN + OFFSET; expected one of "
            "the two columns, or one that has both in it (of a stamp: t[s] = time COLUMN)");
  EXPECT_EQ(failing(with("tx_y[m] =", "none = -128\nnote =")),
            "m.map:9: none names no column; expected none COLUMN = -128, the column of the log in which that means no "
            "value");
  EXPECT_EQ(
      failing("ms;node;x_cm\n1;a;3\n"),
      "m.map:1: \"ms;node;x_cm\" has no '='; expected COLUMN[UNIT] = RULE; is this the table? expected muster import "
      "TABLE --map MAP");
  EXPECT_EQ(failing(with("tx = \"robot\"", "tx = phone")),
            "m.map:6: \"tx\" is a column of names; expected tx = name phone");
  EXPECT_EQ(failing(with("tx = \"robot\"", "tx = robot1")),
            "m.map:6: \"tx\" is a column of names, and " + std::filesystem::path(file).string() +
                " has no column robot1; expected tx = \"robot1\", the same name in all rows");
  EXPECT_EQ(failing(with("tx = \"robot\"", "tx = \"phone\"")),
            "m.map:6: \"phone\" in quotes is the same name in all rows, and " + std::filesystem::path(file).string() +
                " has a column phone, with names such as \"p\"; expected tx = name phone, or another name");
  EXPECT_EQ(failing(with("tx = \"robot\"\n", "")), "m.map: no rule makes the column \"tx\"; expected tx = name COLUMN");
  EXPECT_EQ(failing(with("rssi[dBm] =", "rsi[dBm] =")),
            "m.map: no rule makes the column \"rssi[dBm]\"; expected rssi[dBm] = COLUMN; is it \"rsi\"?");
  EXPECT_EQ(failing(with("phone = name phone", "phone = phone")),
            "wide.csv:2: column \"phone\": \"p\" is not a number; where these are names, expected phone = name phone");
}

}  // namespace
}  // namespace muster::diagnosis
