// Faults of world files, reported with line, column and the nearest name: FAULTS 5, 6, 7 and 13.
#include "world_text.hpp"

namespace muster {
namespace {

using testing::HasSubstr;
using Faults = WorldText;

const std::string walls = "<material name='m' loss='3'/>\n";

TEST_F(Faults, Fault5MisspeltNames) {
  EXPECT_EQ(error("<word until='1'/>"), "world.xml:1:1: the root element is <word>; expected <world>");
  EXPECT_EQ(error("<world untill='1'/>"),
            "world.xml:1:8: <world> has no attribute \"untill\"; expected one of name, dt, until, seed; did you mean "
            "\"until\"?");
  EXPECT_EQ(error("<world/>"),
            "world.xml:1:1: <world> has no attribute \"until\", which it needs; expected the end of the run in "
            "seconds, from 0");
  EXPECT_EQ(error_with("<robbot at='0 0 0'/>"),
            "world.xml:2:1: <robbot> is no element of a world; expected a plugin (with a dot in its name) or one of "
            "at, swap, record, material, "
            "wall, walls, door, floor, mesh, station, robot; did you mean \"robot\"?");
  EXPECT_EQ(error_with("<robot name='a' att='0 0 0'/>"),
            "world.xml:2:17: <robot> has no attribute \"att\"; expected one of name, model, packages, fittings, at, "
            "heading, antenna; did you mean \"at\"?");
  EXPECT_EQ(
      error_with("<robot name='a'/>"),
      "world.xml:2:1: <robot> has no attribute \"at\", which it needs; expected 3 numbers from -1e+06 to 1e+06 m");
  EXPECT_EQ(
      error_with("<robot name='a' at='0 0 0'><wheel/></robot>"),
      "world.xml:2:28: <wheel> stands inside <robot> of line 2, which takes attributes only; expected elements side by "
      "side in <world>, each closed by \"/>\"");
  EXPECT_EQ(error_with("<a.b><c/></a.b>"),
            "world.xml:2:6: <c> stands inside <a.b> of line 2, which takes attributes only; expected elements side by "
            "side in "
            "<world>, each closed by \"/>\"");
  EXPECT_EQ(error_with("<a.b><param name='speed' value='0.4'/></a.b>"),
            "world.xml:2:6: <param> stands inside <a.b> of line 2, whose parameters are its attributes; expected <a.b "
            "... speed=\"0.4\"/>");
  EXPECT_EQ(error_with("<record tabel='x'/>"),
            "world.xml:2:1: <record> has no attribute \"table\", which it needs; expected a table's name: "
            "set/row/quantity, or set/*/quantity for all rows");
  EXPECT_EQ(error_with("<record table='x'><c/></record>"),
            "world.xml:2:19: <c> stands inside <record> of line 2, which takes attributes only; expected elements side "
            "by side in <world>, each closed by \"/>\"");
  EXPECT_EQ(
      error_with("<record table='x' evry='2'/>"),
      "world.xml:2:19: <record> has no attribute \"evry\"; expected one of table, every; did you mean \"every\"?");
  EXPECT_EQ(error_with("<a.b/>\n<swap at='1' instance='a.c' plugin='x.y'/>"),
            "world.xml:3:24: no instance is called \"a.c\"; expected a.b; did you mean \"a.b\"?");
  EXPECT_EQ(error_with("<a.b/>\n<swap at='1' instance='a.b'/>"),
            "world.xml:3:1: <swap> has no attribute \"plugin\", which it needs; expected the new plugin's id, or the "
            "plugin as an element inside");
  EXPECT_EQ(error_with(walls + "<wall from='0 0' to='1 0' material='n'/>"),
            "world.xml:3:37: no material is called \"n\"; expected m");
  EXPECT_EQ(
      error_with(walls + "<wall name='w' from='0 0' to='1 0' material='m'/>\n<wall from='0 0' to='1 0' material='w'/>"),
      "world.xml:4:37: no material is called \"w\", which is a wall (world.xml:3:1); expected m");
  EXPECT_EQ(error_with(walls + "<station name='base' at='0 0 1'/>\n<door wall='base' at='0'/>"),
            "world.xml:4:13: no wall is called \"base\", which is a station (world.xml:3:1); the world has none");
  EXPECT_EQ(error_with("<a.b/>\n<station name='base' at='0 0 1'/>\n<swap at='1' instance='base' plugin='x.y'/>"),
            "world.xml:4:24: no instance is called \"base\", which is a station (world.xml:3:1); expected a.b");
  EXPECT_EQ(error_with("<wall from='0 0' to='1 0' material='n'/>"),
            "world.xml:2:37: no material is called \"n\"; the world has none");
}

TEST_F(Faults, Fault6Numbers) {
  const auto dt = [&](const std::string& value) { return error("<world dt='" + value + "' until='10'/>"); };
  const auto loss = [&](const std::string& value) { return error_with("<material name='m' loss='" + value + "'/>"); };
  const std::string tick = "; expected the tick in seconds, from 1e-09",
                    number = "; expected a number from 0 to 100 dB";
  const std::string at_dt = "world.xml:1:12: attribute \"dt\": ", at_loss = "world.xml:2:26: attribute \"loss\": ";
  EXPECT_EQ(dt("0,1"), at_dt + "\"0,1\" is not a number; a decimal point is written '.'" + tick);
  EXPECT_EQ(loss("1,5"), at_loss + "\"1,5\" is not a number; a decimal point is written '.'" + number);
  EXPECT_EQ(loss("nan"), at_loss + "\"nan\" is not a number; it must be finite" + number);
  EXPECT_EQ(loss("inf"), at_loss + "\"inf\" is not a number; it must be finite" + number);
  EXPECT_EQ(loss("1e400"), at_loss + "\"1e400\" is out of range" + number);
  EXPECT_EQ(loss("1.5abc"), at_loss + "\"1.5abc\" is not a number; \"abc\" follows the number" + number);
  EXPECT_EQ(loss("0x10"), at_loss + "\"0x10\" is not a number; numbers are written in decimal: 16" + number);
  EXPECT_EQ(loss(""), at_loss + "\"\" is not a number; the text is empty" + number);
  EXPECT_EQ(loss(" "), at_loss + "\" \" is not a number; it has spaces in it or around it" + number);
  EXPECT_EQ(loss(" 3"), at_loss + "\" 3\" is not a number; it has spaces in it or around it" + number);
  EXPECT_EQ(loss("+3"), at_loss + "\"+3\" is not a number; a positive number is written without '+'" + number);
  EXPECT_EQ(error("<world dt='0.1' until='10' seed='-1'/>"),
            "world.xml:1:34: attribute \"seed\": -1 is out of bounds; expected an integer from 0");
  EXPECT_EQ(error("<world dt='0.1' until='10' seed='1.5'/>"),
            "world.xml:1:34: attribute \"seed\": \"1.5\" is not an integer; \".5\" follows the number; expected an "
            "integer from 0");
  EXPECT_EQ(error_with("<a.b every='0'/>"),
            "world.xml:2:13: attribute \"every\": 0 is out of bounds; expected an integer from 1");
  EXPECT_EQ(error_with("<a.b every='2.5'/>"),
            "world.xml:2:13: attribute \"every\": \"2.5\" is not an integer; \".5\" follows the number; expected an "
            "integer from 1: it counts ticks of the world's dt");
  EXPECT_EQ(error_with("<a.b revision='-1'/>"),
            "world.xml:2:16: attribute \"revision\": -1 is out of bounds; expected an integer from 1");
  EXPECT_THAT(error_with("<robot at='0 0'/>"), HasSubstr("world.xml:2:12: attribute \"at\": "));
  EXPECT_THAT(error_with("<robot at='0 0 0 0 0'/>"), HasSubstr("; expected 3 numbers from -1e+06 to 1e+06 m"));
}

TEST_F(Faults, Fault7Units) {
  const World world =
      read_with("<robot name='a' at='0 0 0' heading='90'/>\n<robot name='b' at='0 0 0' heading='-6.28'/>");
  ASSERT_EQ(world.warnings.size(), 1u);
  EXPECT_EQ(world.warnings[0].place.line, 2);
  EXPECT_EQ(world.warnings[0].message,
            "attribute \"heading\": 90 rad is more than a full turn; are these degrees? 90 "
            "degrees are 1.5708 rad");
  EXPECT_EQ(
      error_with("<material name='m' loss='-1'/>"),
      "world.xml:2:26: attribute \"loss\": -1 is out of bounds; expected a number from 0 to 100 dB; without the minus? "
      "losses and deviations are positive: 1");
  EXPECT_EQ(error_with(walls + "<wall from='0 0' to='1 0' height='0' material='m'/>"),
            "world.xml:3:35: attribute \"height\": 0 is out of bounds; expected a number from 0.001 to 1e+06 m");
  EXPECT_EQ(error("<world dt='0' until='10'/>"),
            "world.xml:1:12: attribute \"dt\": 0 is out of bounds; expected the tick in seconds, from 1e-09");
  EXPECT_EQ(error("<world dt='-1' until='10'/>"),
            "world.xml:1:12: attribute \"dt\": -1 is out of bounds; expected the tick in seconds, from 1e-09");
  EXPECT_EQ(error("<world dt='0.1' until='-1'/>"),
            "world.xml:1:24: attribute \"until\": -1 is out of bounds; expected the end of the run in seconds, from 0");
  EXPECT_EQ(error("<world dt='2' until='1.5'/>"),
            "world.xml:1:22: 1.5 s are less than a tick of 2 s; expected a longer time, or a smaller dt");
  EXPECT_EQ(error("<world dt='50' until='20'/>"),
            "world.xml:1:23: 20 s are less than a tick of 50 s; is dt in milliseconds? expected dt=\"0.05\", in s");
  EXPECT_EQ(error("<world dt='1e-6' until='1e6'/>"),
            "world.xml:1:25: 1e+06 s are 1e+12 ticks of 1e-06 s; expected fewer than 1e+12");
}

TEST_F(Faults, WordsOfOtherSimulatorsAreUnderstood) {
  EXPECT_THAT(error_with("<robot name='a' at='0 0 0' yaw='1'/>"), testing::EndsWith("; did you mean \"heading\"?"));
  EXPECT_THAT(error_with("<station name='a' at='0 0 0' heading='1'/>"), testing::EndsWith("; did you mean \"yaw\"?"));
  EXPECT_THAT(error("<world dt='0.1' duration='10'/>"), testing::EndsWith("; did you mean \"until\"?"));
  EXPECT_THAT(error_with("<record topic='/odom'/>"), testing::EndsWith("; is \"topic\" meant for it?"));
  EXPECT_THAT(error_with("<box size='1 1 1'/>"), testing::EndsWith("; did you mean \"wall\"?"));
  EXPECT_THAT(error_with("<plugin name='p'/>"),
              testing::EndsWith(
                  "; a plugin is an element of its own name, such as <physics.simbody/>, and what a robot's model has, "
                  "as its drive and its laser, needs none: leave it out"));
  EXPECT_EQ(error("<launch/>"),
            "world.xml:1:1: the root element is <launch>, as in a launch file of ROS; expected <world>");
}

TEST_F(Faults, UnitsThatLookLikeOthersAreDoubted) {
  const World world = read_with(walls + "<wall from='0 0' to='9 0' thickness='12' material='m'/>");
  ASSERT_EQ(world.warnings.size(), 1u);
  EXPECT_EQ(world.warnings[0].message, "attribute \"thickness\": 12 m; is this centimetres? 12 cm are 0.12 m");
  put("walls.csv",
      "name,x0[m],y0[m],x1[m],y1[m],thickness[m],material\na,0,0,1,0,0.1,m\nb,0,1,1,1,12,m\nc,0,2,1,2,12,m\n");
  const World of_file = read_with(walls + "<walls file='walls.csv'/>");
  ASSERT_EQ(of_file.warnings.size(), 1u);
  EXPECT_EQ(of_file.warnings[0].place.line, 3);
  EXPECT_EQ(of_file.warnings[0].message, "column \"thickness[m]\": 12 m; is this centimetres? 12 cm are 0.12 m");
}

TEST_F(Faults, WhatIsSetTwiceAtATimeIsWarnedOf) {
  const auto warned = [&](const std::string& elements) {
    std::vector<std::string> result;
    for (const Warning& warning : read_with("<robot name='a' at='0 0 0'/>\n" + elements).warnings)
      result.push_back(std::to_string(warning.place.line) + ": " + temporary.inside(warning.message));
    return result;
  };
  using testing::ElementsAre;
  EXPECT_THAT(warned("<at t='1'><set path='x/y' value='1'/>\n<set path='x/y' value='2'/></at>"),
              ElementsAre("4: \"x/y\" is set twice at 1 s; the first is at world.xml:3:22, and the last one counts"));
  EXPECT_THAT(warned("<at t='1'><set path='x/y' value='1'/></at>\n<at t='2'><set path='x/y' value='2'/></at>\n"
                     "<at when='robot/a/pose/x above 1'><leave robot='a'/></at><at t='3'><leave robot='a'/></at>"),
              ElementsAre());
}

TEST_F(Faults, AFileOfNoWallsIsWarnedOf) {
  put("walls.csv", "name,x0[m],y0[m],x1[m],y1[m],material\n");
  const World world = read_with(walls + "<walls file='walls.csv'/>");
  ASSERT_EQ(world.warnings.size(), 1u);
  EXPECT_EQ(world.warnings[0].message,
            "attribute \"file\": \"walls.csv\" has no rows below its header, so that it adds nothing");
}

TEST_F(Faults, DoorsThatOverlapAreToldWithAPlaceThatIsFree) {
  const std::string wall = "<material name='m' loss='3'/><wall name='a' from='0 0' to='4 0' material='m'/>";
  const auto doors = [&](const std::string& first, const std::string& second) {
    return error_with(wall + "<door name='p' wall='a' " + first + "/>\n<door name='q' wall='a' " + second + "/>");
  };
  EXPECT_EQ(
      doors("at='1' width='1'", "at='1.5' width='1'"),
      "world.xml:3:29: door \"q\" (1.5 to 2.5 m) overlaps door \"p\" (1 to 2 m, world.xml:2:79) in the same wall; "
      "expected at=\"2\" or more");
  EXPECT_THAT(doors("at='2.5' width='1'", "at='2' width='1'"), testing::EndsWith("expected at=\"1.5\" or less"));
  EXPECT_THAT(doors("at='1' width='2'", "at='1.5' width='2'"),
              testing::EndsWith("expected a narrower door, or one of the two"));
  EXPECT_EQ(doors("at='1' width='1'", "at='2' width='1'"), "no error");
  EXPECT_EQ(error_with(wall + "<wall name='b' from='0 1' to='4 1' material='m'/><door wall='a' at='1'/><door wall='b' "
                              "at='1'/>"),
            "no error");
}

TEST_F(Faults, APoseInThePlaceOfAPlace) {
  EXPECT_EQ(
      error_with("<robot at='3 2 0 0 0 1.57'/>"),
      "world.xml:2:12: attribute \"at\": \"3 2 0 0 0 1.57\" has 6 numbers (x y z roll pitch yaw?); expected three, "
      "x y z in m, and the heading as an attribute of its own: at=\"3 2 0\" heading=\"1.57\"");
  EXPECT_THAT(error_with("<robot at='3 2 0 1.57'/>"), testing::EndsWith("at=\"3 2 0\" heading=\"1.57\""));
  EXPECT_THAT(error_with("<station at='3 2 1 0 0 0.7071067811865475 0.7071067811865476'/>"),
              testing::EndsWith("at=\"3 2 1\" yaw=\"1.570796\""));
  EXPECT_THAT(error_with("<robot at='3 2'/>"), testing::HasSubstr("has 2 numbers; expected 3 numbers"));
}

TEST_F(Faults, ASwapOfThePluginsNameIsToldWhoseItIs) {
  const std::string world = "<a.b name='x'/>\n<c.d/>\n";
  const std::string expected = ": no instance is called \"a.b\", which is the plugin of \"x\"; expected instance=\"x\"";
  EXPECT_EQ(error_with(world + "<swap at='1' instance='a.b' plugin='a.c'/>"), "world.xml:4:24" + expected);
  EXPECT_EQ(error_with(world + "<at t='1'><remove instance='a.b'/></at>"), "world.xml:4:29" + expected);
  EXPECT_EQ(error_with(world + "<at t='1'><swap instance='a.b'><a.c/></swap></at>"), "world.xml:4:27" + expected);
  EXPECT_EQ(error_with(world + "<swap at='1' instance='y' plugin='a.c'/>"),
            "world.xml:4:24: no instance is called \"y\"; expected one of c.d, x");
}

TEST_F(Faults, TimesAndLengthsWithUnitsAreToldAsNumbers) {
  EXPECT_THAT(error("<world dt='0.1' until='1min'/>"), testing::EndsWith("from 0; 1min are 60 s"));
  EXPECT_THAT(error_with("<at t='500ms'><leave robot='a'/></at>"), testing::EndsWith("from 0; 500ms are 0.5 s"));
  EXPECT_THAT(error_with("<robot at='0 0 0' heading='90deg'/>"), testing::EndsWith(" rad; 90deg are 1.570796327 rad"));
}

TEST_F(Faults, Fault13OneNameTwice) {
  EXPECT_EQ(error_with("<robot name='a' at='0 0 0'/>\n<robot name='a' at='1 0 0'/>"),
            "world.xml:3:1: a second robot is called \"a\"; the first is at world.xml:2:1; expected another name for "
            "one of them");
  EXPECT_EQ(
      error_with("<robot name='a' at='0 0 0'/>\n<station name='a' at='1 0 0'/>"),
      "world.xml:3:16: station \"a\" has the name of robot \"a\" at world.xml:2:1, and each is a radio by its name; "
      "expected another name for one of them");
  EXPECT_EQ(
      error_with("<at t='1'><station name='a' at='0 0 0'/></at>\n<robot name='a' at='1 0 0'/>"),
      "world.xml:3:14: robot \"a\" has the name of station \"a\" at world.xml:2:11, and each is a radio by its name; "
      "expected another name for one of them");
  EXPECT_EQ(error_with("<a.b/>\n<a.b/>"),
            "world.xml:3:1: a second instance is called \"a.b\"; the first is at world.xml:2:1; give one of them a "
            "name=\"...\" of its own");
  EXPECT_EQ(error_with("<a.b name='x'/>\n<c.d name='x'/>"),
            "world.xml:3:1: a second instance is called \"x\"; the first is at world.xml:2:1; give one of them a "
            "name=\"...\" of its own");
  EXPECT_EQ(error_with("<robot name='a b' at='0 0 0'/>"),
            "world.xml:2:14: attribute \"name\": \"a b\" is not a name; expected letters, digits, _, - and .");
  EXPECT_EQ(error_with("<robot name='a/b' at='0 0 0'/>"),
            "world.xml:2:14: attribute \"name\": \"a/b\" is not a name; expected letters, digits, _, - and .");
  EXPECT_EQ(error_with("<a.b name=''/>"),
            "world.xml:2:12: attribute \"name\": \"\" is not a name; expected letters, digits, _, - and .");
}

}  // namespace
}  // namespace muster
