// What those write who come from ROS, Gazebo and PX4: told at the place of what is wrong, with the word that they mean.
#include <gmock/gmock.h>

#include "tests/cli/errors/program.hpp"

using namespace muster::test;

namespace {

// What `check` says of the elements, which are in lines of their own from line 2 on.
std::string refusal_of(const std::string& elements, const std::string& urdf = "", int exit = 2) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("\n" + elements + "\n"));
  if (!urdf.empty()) folder.write("bot.urdf", urdf);
  const auto outcome = folder.muster({"check", "world.xml"});
  EXPECT_EQ(outcome.exit, exit) << outcome.out;
  return outcome.err;
}

const std::string begin = "muster: error: ", rover = "<robot name=\"rover\" at=\"0 0 0\"/>\n";

TEST(Habits, ElementsOfSdfAreToldAtTheirOwnPlace) {
  EXPECT_EQ(refusal_of("<include>\n<uri>model://turtlebot3_waffle</uri></include>"),
            begin +
                "world.xml:2:1: <include> is no element of a world, which is one file and takes no models of Gazebo; "
                "expected <robot name=\"...\" model=\"waffle\" at=\"0 0 0\"/>, a model of muster or a URDF file\n");
  EXPECT_EQ(refusal_of("<plugin filename=\"libdiff.so\" name=\"d\">\n<robotNamespace>tb3</robotNamespace></plugin>"),
            begin +
                "world.xml:2:1: <plugin> is no element of a world; a plugin is an element of its own name, such as "
                "<physics.simbody/>, and what a robot's model has, as its drive and its laser, needs none: leave it "
                "out\n");
  const ProgramFolder folder;
  folder.write("world.xml", "<world xmlns:xi=\"http://www.w3.org/2001/XInclude\" until=\"1\"/>");
  EXPECT_EQ(folder.muster({"check", "world.xml"}).err,
            begin +
                "world.xml:1:8: a world has no namespaces (xmlns:xi), and includes no files: it is one file; expected "
                "the elements themselves, or <walls file=\"walls.csv\"/>, a table "
                "name,x0[m],y0[m],x1[m],y1[m],material\n");
}

TEST(Habits, AFloorIsToldByItsNameAndPlace) {
  const std::string material = "<material name=\"m\" loss=\"4\"/>\n",
                    end = "\" z=\"3\" material=\"m\"/>\n<radio.multiwall/>";
  EXPECT_EQ(refusal_of(material + "<floor name=\"slab\" corners=\"0 0 10 0 0 8 10 8" + end),
            begin +
                "world.xml:3:29: floor \"slab\": two of its edges cross; expected its corners in turn, around it: "
                "corners=\"0 0 10 0 10 8 0 8\"\n");
  EXPECT_EQ(refusal_of(material + "<floor name=\"slab\" corners=\"0 0 10 8" + end),
            begin +
                "world.xml:3:29: attribute \"corners\": \"0 0 10 8\" has 4 numbers; expected 8 numbers from -1e+06 to "
                "1e+06 m, with spaces between them (its four corners in turn: x y of each); for the rectangle "
                "between these two: corners=\"0 0 10 0 10 8 0 8\"\n");
  // What only the scene finds has the name and the line of the row, too.
  EXPECT_EQ(refusal_of(material + "<floor name=\"slab\" corners=\"0 0 1 0 2 0 3 0" + end +
                       "<control.beacon radio=\"base\"/><station name=\"base\" at=\"0 0 1\"/><network.ideal/>"),
            begin + "world.xml:3:1: floor \"slab\": has no area; expected four corners in turn\n");
}

TEST(Habits, ModelsOfOthers) {
  const std::string end = "\" at=\"0 0 0\"/>\n<physics.planar/>", robot = "<robot name=\"tb3\" model=\"";
  EXPECT_EQ(refusal_of(robot + "model.sdf" + end),
            begin +
                "world.xml:2:26: attribute \"model\": model.sdf is SDF, which muster does not read as a robot; "
                "expected URDF or MJCF: the URDF or xacro that it was made from (gz sdf -p makes SDF of URDF, and does "
                "not go back)\n");
  EXPECT_THAT(
      refusal_of(robot + "turtlebot3_burger" + end),
      testing::StartsWith(begin + "world.xml:2:26: attribute \"model\": there is no model \"turtlebot3_burger\"; "
                                  "did you mean \"waffle\"? expected one of crate, "));
}

TEST(Habits, AUrdfIsToldByItsOwnPlaceAndName) {
  const std::string robot = "<robot name=\"r\" model=\"bot.urdf\" at=\"0 0 0\"/>\n<physics.planar/>";
  EXPECT_EQ(
      refusal_of(robot, "<robot name=\"r\">\n<link name=\"a\"><inertial>\n<mass>5.0</mass></inertial></link></robot>"),
      begin + "bot.urdf:3: link 'a': <mass> has the text \"5.0\", as in SDF; expected <mass value=\"5.0\"/>\n");
  EXPECT_EQ(refusal_of(robot,
                       "<robot name=\"r\">\n<link name=\"a\"/><link name=\"b\"/>\n<joint name=\"j\" "
                       "type=\"continuous\"><parent link=\"a\"/><child link=\"b\"/>\n<axis><xyz>0 0 "
                       "1</xyz></axis></joint></robot>"),
            begin + "bot.urdf:4: <axis> has no element <xyz>, as in SDF; expected <axis xyz=\"0 0 1\"/>\n");
}

TEST(Habits, APluginIsMeantByItsSenseAndNotByTheWordOfItsKind) {
  EXPECT_THAT(refusal_of(rover + "<sensors.lidar robot=\"rover\"/>", "", 3),
              testing::EndsWith("; did you mean \"sensors.laser\"?\n"));
  EXPECT_THAT(refusal_of(rover + "<sensors.compass robot=\"rover\"/>", "", 3),
              testing::Not(testing::HasSubstr("did you mean")));
  EXPECT_THAT(refusal_of(rover + "<sensors.lasre/>", "", 3), testing::EndsWith("; did you mean \"sensors.laser\"?\n"));
}

TEST(Habits, TopicsAreNoTables) {
  const std::string no_topics = "; tables are SET/ROW/QUANTITY, and no topics; did you mean ";
  for (const auto& [topic, table] : {std::pair("/tf", "robot/*/pose"), std::pair("/r1/odom", "robot/*/odometry"),
                                     std::pair("/cmd_vel", "robot/*/command"), std::pair("/scan", "scan/*/message"),
                                     std::pair("/fix", "robot/*/gps")}) {
    EXPECT_THAT(refusal_of(rover +
                           "<physics.planar/><robots.drive/><robots.odometry/><sensors.laser/>"
                           "<control.steady robot=\"rover\"/>\n"
                           "<record table=\"" +
                           topic + "\"/>"),
                testing::StartsWith(begin + "world.xml:4:1: record: there is no table \"" + topic + '"' + no_topics +
                                    '"' + table + "\"? expected one of "));
  }
}

TEST(Habits, ACommandLineOfRos) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("\n" + rover +
                                     "<physics.planar name=\"body\"/>\n<control.steady name=\"steer\" "
                                     "robot=\"rover\" v=\"0.1\"/>"));
  const auto refused = [&](const std::vector<std::string>& words, const std::string& message) {
    expect_error(folder.muster(words), 2, message);
  };
  const std::string see = "; see muster run --help";
  refused({"run", "world.xml", "until:=5"},
          "muster run: \"until:=5\" is an argument of ROS, which muster has not; did you mean --until 5?" + see);
  refused(
      {"run", "world.xml", "duration:=5"},
      "muster run: \"duration:=5\" is an argument of ROS, which muster has not; did you mean \"--until\"? (duration "
      "is no option)" +
          see);
  refused({"run", "world.xml", "gain:=5"},
          "muster run: \"gain:=5\" is an argument of ROS, which muster has not; expected options, and parameters of "
          "plugins as --set PATH=VALUE, such as --set INSTANCE/gain=5" +
              see);
  refused({"swap", "world.xml", "--instance", "body", "--plugin", "physics.planar"},
          "muster swap: --at is required: when, in seconds of the run, such as 5; see muster swap --help");
  refused({"run", "world.xml", "--set", "steer/robot=rover"},
          "\"steer/robot\" is the name of a robot, and no parameter: numbers, flags and choices are; expected "
          "robot=\"...\" in the world, at world.xml:4:1, or beside this run one with another (muster compare WORLD "
          "steer=control.steady:robot=VALUE; in a sweep <vary instance=\"steer\" plugins=\"control.steady:robot=VALUE "
          "...\"/>)");
  const auto swapped =
      folder.muster({"swap", "world.xml", "--at", "0.5", "--instance", "body", "--plugin", "control.steady"});
  EXPECT_EQ(swapped.exit, 2);
  EXPECT_THAT(swapped.err,
              testing::StartsWith(begin + "muster swap: \"body\" is of the phase PHYSICS, and control.steady "
                                          "of CONTROL; expected a plugin of PHYSICS: physics."));
  const auto recorded = folder.muster({"run", "world.xml", "--record", "/tf", "--out", "o"});
  EXPECT_THAT(recorded.err,
              testing::StartsWith(begin + "--record: there is no table \"/tf\"; tables are SET/ROW/QUANTITY, "
                                          "and no topics; did you mean \"robot/*/pose\"?"));
}

TEST(Habits, AnImportReadsColumnsWithDotsAndSaysWhatDivisionIs) {
  const ProgramFolder folder;
  folder.write("log.csv", "%time,field.x,field.rssi\n1,100,-50\n2,200,-56\n");
  const std::string map = "tx = \"a\"\nrx = \"b\"\ntx_x[m] = 0\ntx_y[m] = 0\nrx_y[m] = 0\n";
  const auto import = [&](const std::string& rules) {
    folder.write("log.map", map + rules);
    return folder.muster({"import", "log.csv", "--map", "log.map", "--out", "out.csv"});
  };
  const auto taken = import("rx_x[m] = 0.01*field.x\nrssi[dBm] = field.rssi\n");
  EXPECT_EQ(taken.exit, 0) << taken.err;
  EXPECT_THAT(folder.read("out.csv"), testing::HasSubstr("-56"));
  expect_error(import("rx_x[m] = 0.01*field.x\nrssi[dBm] = rssi\n"), 2,
               "log.map:7: log.csv has no column \"rssi\"; expected one of %time, field.x, field.rssi; did you mean "
               "\"field.rssi\"?");
  expect_error(import("rssi[dBm] = field.rssi\nrx_x[m] = field.x / 100\n"), 2,
               "log.map:7: \"field.x / 100\": a rule has no division; expected 0.01*field.x (SCALE*COLUMN + OFFSET)");
}

TEST(Habits, AnImportHasNoFunctionsButSaysTheFactor) {
  const ProgramFolder folder;
  folder.write("log.csv", "t,heading_deg,rssi\n1,90,-50\n2,180,-56\n");
  const auto import = [&](const std::string& yaw) {
    folder.write("log.map",
                 "tx = \"a\"\nrx = \"b\"\ntx_x[m] = 0\ntx_y[m] = 0\nrx_x[m] = 1\nrx_y[m] = 0\nrssi[dBm] = rssi\n"
                 "rx_yaw[rad] = " +
                     yaw + "\n");
    return folder.muster({"import", "log.csv", "--map", "log.map", "--out", "out.csv"});
  };
  for (const std::string call : {"deg2rad", "radians", "toRadians"})
    expect_error(import(call + "(heading_deg)"), 2,
                 "log.map:8: there is no function " + call +
                     "; expected 0.017453292519943295*heading_deg, which makes degrees in rad");
  expect_error(
      import("sqrt(heading_deg)"), 2,
      "log.map:8: there is no function sqrt, only log10; expected SCALE*COLUMN + OFFSET or SCALE*log10(COLUMN) + "
      "OFFSET, such as 0.001*heading_deg");
  EXPECT_EQ(import("0.017453292519943295*heading_deg").exit, 0);
  for (const std::string rule : {"heading_deg*pi/180", "heading_deg * M_PI/180", "pi/180*heading_deg"})
    expect_error(import(rule), 2,
                 "log.map:8: \"" + rule +
                     "\": a rule is SCALE*COLUMN + OFFSET, with numbers for SCALE and OFFSET; expected "
                     "0.017453292519943295*heading_deg");
  expect_error(
      import("heading_deg * 0.0175"), 2,
      "log.map:8: \"heading_deg * 0.0175\": a rule is SCALE*COLUMN + OFFSET, with numbers for SCALE and OFFSET; "
      "expected 0.0175*heading_deg");
  expect_error(
      import("-heading_deg"), 2,
      "log.map:8: log.csv has no column \"-heading_deg\", and it is no rule; expected -1*heading_deg; expected "
      "one of t, heading_deg, rssi; did you mean \"heading_deg\"?");
  folder.write("log.csv", "t,heading_deg,rssi\ns,deg,dBm\n1,90,-50\n");
  expect_error(import("0.0175*heading_deg"), 2,
               "log.csv:2: the line holds units and no reading; expected it away: sed '2d' FILE, and the units in the "
               "rules of the map");
  folder.write("log.csv", "t,heading_deg,rssi\n1,90,-50\nt,heading_deg,rssi\n2,90,-50\n");
  expect_error(import("0.0175*heading_deg"), 2,
               "log.csv:3: the line repeats the header, as in two logs joined; expected it away: sed "
               "'3d' FILE");
  folder.write("log.csv", "t,heading_deg,rssi\n1,90,-50\nTotal,90,-50\n");
  expect_error(import("0.0175*heading_deg"), 2,
               "log.csv:3: the last line holds sums or means and no reading; expected it away: sed '3d' FILE");
}

TEST(Habits, AMapSaysWhereItIsAndRefusesCornersOutOfOrder) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("\n<station name=\"base\" at=\"0 0 1\"/>\n<radio.multiwall/>"));
  const std::vector<std::string> words = {"map", "world.xml", "--cells", "4", "--out", "o", "--area"};
  const auto map = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    return folder.muster(more);
  };
  expect_error(map({"-14", "22", "-8", "8"}), 2,
               "--area: -14 22 -8 8: Y0 = 22 is above Y1 = 8; expected X0 Y0 X1 Y1, two corners, X0 < X1 and Y0 < Y1; "
               "did you mean --area -14 -8 22 8? (from its order X0 X1 Y0 Y1)");
  expect_error(map({"8", "-4", "0", "4"}), 2,
               "--area: 8 -4 0 4: X0 = 8 is above X1 = 0; expected X0 Y0 X1 Y1, two corners, X0 < X1 and Y0 < Y1; did "
               "you mean --area 0 -4 8 4?");
  EXPECT_THAT(map({"-4", "-2", "4", "2"}).out, testing::StartsWith("w: 4 x 2 cells of 2 m, x -4 to 4, y -2 to 2 m\n"));
  EXPECT_THAT(map({"-4", "-2", "4", "2", "--height", "150"}).out,
              testing::StartsWith("warning: --height: 150 m is above everything, which reaches up to 1 m; is this "
                                  "centimetres? 150 cm are 1.5 m\n"));
}

TEST(Habits, RangesOfADatasheetInItsUnits) {
  const ProgramFolder folder;
  folder.write("world.xml",
               "<world dt=\"0.1\" until=\"1\">\n<robot name=\"r\" at=\"0 0 0\"/><physics.planar/>\n"
               "<sensors.imu robot=\"r\" gyro_range=\"250\" accel_range=\"4\"/></world>");
  const std::string out = folder.muster({"check", "world.xml"}).out;
  EXPECT_THAT(out,
              testing::HasSubstr("world.xml:3:36: attribute \"gyro_range\": 250 rad/s is 39.79 turns a second; are "
                                 "these degrees? 250 degrees a second are 4.363 rad/s"));
  EXPECT_THAT(out,
              testing::HasSubstr("world.xml:3:54: attribute \"accel_range\": 4 m/s2 is less than gravity, so that a "
                                 "robot at rest is told as 4; is this in g? 4 g are 39.24 m/s2"));
}

TEST(Habits, TimesInMilliseconds) {
  const ProgramFolder folder;
  folder.write("poses.csv", "t[s],robot,x[m],y[m],z[m],yaw[rad]\n0,r,0,0,0,0\n100,r,0.03,0,0,0\n10000,r,3,0,0,0\n");
  folder.write("world.xml",
               "<world dt=\"0.1\" until=\"10\"><robot name=\"r\" at=\"0 0 0\"/><physics.replay "
               "file=\"poses.csv\"/></world>");
  EXPECT_THAT(
      folder.muster({"check", "world.xml"}).out,
      testing::HasSubstr("poses.csv:2:1: the rows of robot 'r' are at t = 0 s, 100 s and later, and the run ends "
                         "at 10 s, so that only the first of them counts; are these milliseconds? expected "
                         "seconds of the run"));
}

TEST(Habits, WordsInOtherPlaces) {
  const ProgramFolder folder;
  const auto refused = [&](const std::string& inside, const std::string& message) {
    folder.write("world.xml", world_of("<robot name=\"r\" at=\"0 0 0\"/>" + inside));
    const auto outcome = folder.muster({"check", "world.xml"});
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_THAT(outcome.err, testing::HasSubstr(message));
  };
  refused("<at t=\"0.4\"><remove robot=\"r\"/></at>",
          "<remove> takes a plugin out, by instance=\"...\"; a robot leaves by <leave robot=\"r\"/>");
  refused("<at t=\"0.4\"><wall name=\"w\" from=\"0 0\" to=\"1 0\" material=\"m\"/></at>",
          "do not join a run; expected it in <world>; what opens and closes on the way is a <door> in it, by <set "
          "path=\"door/NAME/state\" value=\"closed\"/>");
  refused(
      "<at when=\"robot/r/pose/x < 4\"></at>",
      "'<' in the value of \"when\"; expected the word below: when=\"robot/rover/pose/x below 4\", or a closing \"");
}

TEST(Habits, FilesAndFoldersOfOthers) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("<robot name=\"r\" at=\"0 0 0\"/>"));
  expect_error(folder.muster({"run", "world.xml", "--out", "result.csv"}), 2,
               "--out: result.csv is called like a file, and a folder is made; expected --out result, or --wide "
               "result.csv for what is recorded, in one file");
  expect_error(folder.muster({"run", "world.xml", "--out", "plots", "--plot", "robot/r/x"}), 2,
               "--plot \"robot/r/x\": \"x\" is a column and no table; expected \"robot/r/pose/x\"");
  std::filesystem::create_directory(folder.path() / "out");
  folder.write("out/run.json", "{}");
  expect_error(folder.muster({"view", "out"}), 2,
               "there is no verb \"view\"; \"out\" is the record of a run: muster report out makes its page, "
               "out/run.html (muster --help lists the verbs)");
  folder.write("run.mcap", "\x89MCAP0\r\n");
  expect_error(folder.muster({"run", "world.xml", "--restore", "run.mcap"}), 2,
               "run.mcap: is a log of a run (MCAP), which has what was recorded and no state; expected a file that "
               "`muster run --save` wrote");
  expect_error(folder.muster({"diagnose", "--check", "world.xml"}), 2,
               "world.xml: is not what a diagnosis wrote; expected the folder that muster diagnose WORLD --data FILE "
               "--out FOLDER wrote");
  folder.write("d.csv", "t[s],tx,rx,rssi[dBm]\n0,a,b,-50\n");
  expect_error(
      folder.muster({"fit", "world.xml", "--data", "d.csv", "--table", "robot/*/odometry"}), 2,
      "d.csv:1: has readings of radios, and --table \"robot/*/odometry\" asks for rows of such a table; without "
      "--table, the channel is fitted to them");
}

}  // namespace
