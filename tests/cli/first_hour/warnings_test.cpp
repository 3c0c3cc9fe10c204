// Worlds that run and do not do what their author meant: `check` warns of them, word for word.
#include <gmock/gmock.h>

#include "tests/cli/errors/program.hpp"

using namespace muster::test;

namespace {

// The elements are in lines of their own, from line 2 on. What `check` prints before its last line; a run lists the
// same.
std::string warnings_of(const std::string& elements) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("\n" + elements + "\n"));
  const auto outcome = folder.muster({"check", "world.xml"});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  std::string warnings = outcome.out.substr(0, outcome.out.rfind("w: "));
  const std::string run = folder.muster({"run", "world.xml"}).out;
  for (std::size_t from = 0, to = 0; (to = warnings.find('\n', from)) != warnings.npos; from = to + 1)
    EXPECT_THAT(run, testing::HasSubstr(warnings.substr(from, to - from)));
  return warnings;
}

const std::string rover = "<robot name=\"rover\" at=\"0 0 0\"/>\n";
const std::string base = "<station name=\"base\" at=\"5 0 1\"/>\n";
const std::string wall =
    "<material name=\"brick\" loss=\"8\"/><wall name=\"north\" from=\"-5 0.1\" to=\"5 0.1\" material=\"brick\"/>\n";
const std::string channel = "<radio.multiwall/><control.beacon radio=\"base\"/>\n";

TEST(FirstHour, RobotsThatStartInWallsAndInEachOther) {
  for (const std::string physics : {"<physics.simbody/>", "<physics.ode/>"}) {
    SCOPED_TRACE(physics);
    EXPECT_EQ(warnings_of(wall + rover + "<robot name=\"second\" at=\"0.1 -0.5 0\"/>\n" +
                          "<robot name=\"third\" at=\"0 -0.5 0\"/>\n" + physics),
              "warning: world.xml:3:1: robot 'rover' starts in wall 'north', 55 mm deep, and will be pushed out; "
              "expected a place (at) clear of it\n"
              "warning: world.xml:5:1: robot 'third' starts in robot 'second', 100 mm deep, and will be pushed out; "
              "expected a place (at) clear of it\n");
  }
}

TEST(FirstHour, ARobotThatStartsBelowTheGround) {
  for (const std::string physics : {"<physics.simbody/>", "<physics.ode/>", "<physics.planar/>"}) {
    EXPECT_EQ(warnings_of("<robot name=\"rover\" at=\"0 0 -1\"/>\n" + physics),
              "warning: world.xml:2:1: robot 'rover' starts 1000 mm below the ground; expected a place (at) on it, z = "
              "0 or above\n");
    const std::string above = warnings_of("<robot name=\"rover\" at=\"0 0 0.5\"/>\n" + physics);
    if (physics == "<physics.planar/>")
      EXPECT_EQ(above, "");  // there it stays at its height
    else
      EXPECT_EQ(
          above,
          "warning: world.xml:2:1: robot 'rover' starts 500 mm above the ground, and falls; expected a place (at) "
          "on it, z = 0\n");
  }
}

TEST(FirstHour, WhatNeverComesToStep) {
  EXPECT_EQ(warnings_of(rover + "<physics.simbody/>\n<control.steady robot=\"rover\" v=\"1\" every=\"100\"/>\n" +
                        "<record table=\"robot/*/pose\" every=\"11\"/>"),
            "warning: world.xml:4:44: attribute \"every\": 100 ticks are more than the run's 10, so that "
            "<control.steady> does not step after its start\n"
            "warning: world.xml:5:37: attribute \"every\": 11 ticks are more than the run's 10, so that <record> is "
            "written at its start alone\n");
  EXPECT_EQ(warnings_of(rover + "<physics.simbody/>\n<record table=\"robot/*/pose\" every=\"10\"/>"), "");
}

TEST(FirstHour, AHeadingAsTheThirdNumberOfAPlace) {
  EXPECT_THAT(warnings_of("<robot name=\"rover\" at=\"1 2 1.57\"/><physics.simbody/>"),
              testing::HasSubstr("; is the third number a heading? at=\"1 2 0\" heading=\"1.57\"\n"));
}

TEST(FirstHour, SecondsForTicksAndNamesForChoices) {
  const ProgramFolder folder;
  const auto refused = [&](const std::string& elements, const std::string& message) {
    folder.write("world.xml", "<world name=\"w\" dt=\"0.05\" until=\"1\"><station name=\"base\" at=\"5 0 1\"/>" +
                                  elements + "</world>");
    EXPECT_THAT(folder.muster({"check", "world.xml"}).err, testing::HasSubstr(message));
  };
  refused("<record table=\"robot/*/pose\" every=\"0.1\"/>",
          "expected an integer from 1: it counts ticks of 0.05 s; 0.1 s are every=\"2\"\n");
  const std::string made = "<robot name=\"rover\" at=\"0 0 0\"/><physics.planar/>";
  refused(made + "<sensors.range robot=\"rover\" to=\"base\"/>",
          "\"base\" is not a choice, but a radio; expected one of stations, robots, all, or peers=\"base\" in its "
          "place\n");
  refused(made + "<control.car robot=\"rover\"/>",
          "or, in the place of control.car, a controller that finds its own way, such as <control.waypoint "
          "robot=\"...\" path=\"FILE.csv\"/>\n");
}

TEST(FirstHour, ASwapForAnotherKindOfPlugin) {
  EXPECT_EQ(warnings_of(rover + "<physics.planar name=\"physics\"/><radio.multiwall/>\n" +
                        "<swap at=\"0.5\" instance=\"physics\" plugin=\"radio.multiwall\"/>"),
            "warning: world.xml:4:1: the swap puts radio.multiwall/2, of the phase RADIO, in the place of "
            "physics.planar/1, of PHYSICS, whose work nobody does then; expected a plugin of PHYSICS, or instance "
            "\"radio.multiwall\" to be swapped, radio.multiwall/2 of RADIO\n");
}

TEST(FirstHour, WallsThatThePhysicsDrivesThrough) {
  EXPECT_EQ(warnings_of(wall + rover + base + "<physics.planar/>\n" + channel + "<network.ideal/>"),
            "warning: world.xml:5:1: walls stop no robot here: physics.planar drives through them; expected "
            "physics.simbody in its place, or through_walls=\"true\" where that is meant\n");
  EXPECT_EQ(
      warnings_of(wall + rover + base + "<physics.planar through_walls=\"true\"/>\n" + channel + "<network.ideal/>"),
      "");
  EXPECT_EQ(warnings_of(rover + base + "<physics.planar/>\n" + channel + "<network.ideal/>"), "");
}

TEST(FirstHour, CommandsThatReachNoMotor) {
  EXPECT_EQ(warnings_of("<robot name=\"box\" model=\"crate\" at=\"0 0 0\"/>\n<physics.simbody/>"
                        "<control.steady robot=\"box\" v=\"1\" w=\"0\"/>"),
            "warning: world.xml:2:1: robot 'box' is commanded, but its model 'crate' has no drive, so that it does not "
            "move; expected <muster><differential left=\"\" right=\"\" .../></muster> in " MUSTER_PLUGINS_DIR
            "/models/crate.urdf, or in a file of fittings\n");
  EXPECT_EQ(warnings_of("<robot name=\"drone\" model=\"hummingbird\" at=\"0 0 1\"/>\n<physics.simbody/>"
                        "<control.steady robot=\"drone\" v=\"1\" w=\"0\"/>"),
            "warning: world.xml:2:1: robot 'drone' is commanded, but its model 'hummingbird' flies, so that a command "
            "of wheels (robot/*/command) does not move it; expected <control.velocity3d robot=\"drone\"/> and "
            "<control.path3d robot=\"drone\" path=\"...\"/>\n");
}

TEST(FirstHour, ASpeedThatIsFarBeyondTheDrive) {
  const auto at = [](const std::string& v) {
    return warnings_of(rover + "<physics.planar/><robots.drive/><control.steady robot=\"rover\" v=\"" + v + "\"/>");
  };
  EXPECT_EQ(
      at("3"),
      "warning: world.xml:2:1: robot 'rover' is asked for 3 m/s, and its drive reaches 1 m/s (max_speed 20 rad/s, "
      "wheels of radius 0.05 m); expected a lower speed of its controller, or max_speed=\"60\" in its description; "
      "is that in m/s there?\n");
  EXPECT_EQ(at("-1.9"), "");
}

TEST(FirstHour, AControllerWithoutPhysics) {
  EXPECT_EQ(warnings_of(rover + "<control.steady robot=\"rover\" v=\"1\" w=\"0\"/>"),
            "warning: world.xml:3:1: control.steady (control.steady): writes \"robot/rover/command\", which nobody "
            "reads; expected <physics.simbody/> in the world\n");
}

TEST(FirstHour, ABeaconWithoutANetwork) {
  EXPECT_EQ(warnings_of(base + "<control.beacon radio=\"base\"/>"),
            "warning: world.xml:3:1: control.beacon (control.beacon): writes \"outbox/base/message\", which nobody "
            "reads; expected <network.ideal/> in the world\n");
}

TEST(FirstHour, AChannelToWhichNothingAddsAPathLoss) {
  const std::string beacon = base + rover + "<network.ideal/><control.beacon radio=\"base\"/>\n";
  const std::string doubt = "nothing adds a path loss to link/*/level: there is only ",
                    remedy = ", so that a level does not fall with distance; expected <radio.multiwall/> beside ";
  const auto has = [&](const std::string& terms) {
    const ProgramFolder folder;
    folder.write("world.xml", world_of("\n" + beacon + terms + "\n"));
    return folder.muster({"check", "world.xml"}).out + folder.muster({"run", "world.xml"}).err;
  };
  EXPECT_THAT(has("<radio.fading shadowing=\"3\" decorrelation=\"2\"/>"),
              testing::HasSubstr("warning: world.xml:5:1: " + doubt + "radio.fading (radio.fading)" + remedy + "it\n"));
  EXPECT_THAT(
      has("<effect.rx_offset radio=\"base\" offset=\"3\"/>\n<radio.fading shadowing=\"3\" decorrelation=\"2\"/>"),
      testing::HasSubstr("warning: world.xml:5:1: " + doubt +
                         "effect.rx_offset (effect.rx_offset), radio.fading (radio.fading)" + remedy + "them\n"));
  EXPECT_THAT(has("<radio.fading shadowing=\"3\" decorrelation=\"2\"/><radio.multiwall/>"),
              testing::Not(testing::HasSubstr(doubt)));
  EXPECT_THAT(has("<radio.images/>"), testing::Not(testing::HasSubstr(doubt)));
}

TEST(FirstHour, AControllerThatGoesSidewaysOfARobotThatCannot) {
  const ProgramFolder folder;
  folder.write("way.csv", "x[m],y[m]\n0,5\n");
  const auto checked = [&](const std::string& model) {
    folder.write("world.xml",
                 world_of("<robot name=\"rover\" model=\"" + model + "\" at=\"0 0 0\"/><physics.simbody/>\n" +
                          "<control.strafe robot=\"rover\" path=\"way.csv\"/>"));
    return folder.muster({"check", "world.xml"});
  };
  expect_error(checked("scarab"), 2,
               "world.xml:2:1: control.strafe (control.strafe): the model \"scarab\" of robot \"rover\" "
               "(world.xml:1:36) has no wheels with rollers (<mecanum>), so that it cannot go sideways; expected "
               "<control.waypoint/>, which turns, or a model that has them: youbot");
  EXPECT_EQ(checked("youbot").exit, 0);
}

TEST(FirstHour, ARobotThatKeepsALinkToItself) {
  const ProgramFolder folder;
  folder.write("way.csv", "x[m],y[m]\n0,5\n");
  const auto refused = [&](const std::string& links, const std::string& words) {
    folder.write("world.xml", world_of(base + rover + channel +
                                       "<network.ideal/><physics.simbody/>\n"
                                       "<control.connectivity robot=\"rover\" roadmap=\"way.csv\" " +
                                       links + "/>"));
    expect_error(folder.muster({"check", "world.xml"}), 2, "world.xml:5:" + words);
  };
  refused("role=\"leader\" parent=\"rover\"",
          "77: attribute \"parent\": \"rover\" is the robot's own radio; expected another: base");
  refused("parent=\"base\" child=\"rover\"",
          "76: attribute \"child\": \"rover\" is the robot's own radio; expected another: base");
  refused("parent=\"base\" child=\"base\"",
          "76: attribute \"child\": \"base\" is the parent already; expected another, and the world has none; a robot "
          "without one is role=\"leader\"");
}

TEST(FirstHour, AttributesThatCountOnlyBesideAnother) {
  const std::string radios = base + rover + "<physics.simbody/><network.ideal/><control.beacon radio=\"base\"/>\n";
  EXPECT_EQ(warnings_of(radios + "<radio.multiwall radius=\"8\"/>"),
            "warning: world.xml:5:26: attribute \"radius\": has no effect without model=\"disc\"; expected "
            "model=\"disc\" beside it, or no radius\n");
  EXPECT_EQ(warnings_of(radios + "<radio.multiwall model=\"disc\" radius=\"8\"/>"), "");
  EXPECT_EQ(warnings_of(radios + "<radio.multiwall name=\"walls\" radius=\"8\"/>\n"
                                 "<at t=\"0.5\"><set path=\"walls/model\" value=\"disc\"/></at>"),
            "");
  const ProgramFolder folder;
  folder.write("goals.csv", "x[m],y[m]\n1,-3\n");
  folder.write("world.xml", world_of("\n" + wall + radios + "<radio.multiwall/>\n<robots.roadmap robot=\"rover\"/>\n" +
                                     "<control.navigate robot=\"rover\" goals=\"goals.csv\" station=\"base\" "
                                     "threshold=\"-55\" reach=\"2\" weight=\"2\"/>"));
  const std::string out = folder.muster({"check", "world.xml"}).out;
  EXPECT_THAT(out,
              testing::HasSubstr("world.xml:8:60: attribute \"station\": has no effect without rssi=\"...\", nor "
                                 "has \"threshold\" or \"weight\"; expected rssi=\"...\" beside it, or no station, "
                                 "threshold and weight\n"));
  EXPECT_THAT(out, testing::HasSubstr("attribute \"reach\": has no effect without laser=\"true\"; expected "
                                      "laser=\"true\" beside it, or no reach\n"));
}

TEST(FirstHour, ASensitivityBelowThatOfTheReceiver) {
  const auto with = [](const std::string& network, const std::string& more = "") {
    return warnings_of(base + rover + "<physics.simbody/><radio.multiwall/>" + more + "\n<network.ideal " + network +
                       "/><control.beacon radio=\"base\"/>");
  };
  const std::string doubt =
      "warning: world.xml:5:29: attribute \"sensitivity\": -120 dBm is below the -95 dBm of "
      "radio.receiver, below which link/*/rssi has no value, so that it has no effect; expected ";
  EXPECT_EQ(with("sensitivity=\"-120\""),
            doubt + "<radio.receiver sensitivity=\"-120\"/> in the world, or sensitivity=\"-95\"\n");
  EXPECT_EQ(with("sensitivity=\"-120\"", "<radio.receiver/>"),
            doubt + "sensitivity=\"-120\" of radio.receiver (world.xml:4:37), or sensitivity=\"-95\"\n");
  EXPECT_EQ(with("sensitivity=\"-120\"", "<radio.receiver sensitivity=\"-120\"/>"), "");
  EXPECT_EQ(with("sensitivity=\"-80\""), "");
  EXPECT_EQ(with("", "<radio.receiver sensitivity=\"-80\"/>"), "");
}

TEST(FirstHour, CommandsBesideALogThatMovesTheRobots) {
  const ProgramFolder folder;
  folder.write("log.csv", "t[s],robot,x[m],y[m],yaw[rad]\n0,rover,0,0,0\n1,rover,1,0,0\n");
  folder.write("world.xml", world_of("\n" + rover + "<physics.replay file=\"log.csv\"/>\n" +
                                     "<control.steady robot=\"rover\" v=\"1\" w=\"0\"/>"));
  EXPECT_THAT(
      folder.muster({"check", "world.xml"}).out,
      testing::HasSubstr("warning: world.xml:4:1: control.steady (control.steady): writes "
                         "\"robot/rover/command\", which world.xml:3:1: physics.replay (physics.replay) does not "
                         "read, so that it has no effect; expected <physics.simbody/> in the place of "
                         "physics.replay, or no control.steady\n"));
}

TEST(FirstHour, AWayInSpaceOfARobotOnTheGround) {
  const ProgramFolder folder;
  folder.write("way.csv", "x[m],y[m],z[m]\n0,5,1\n");
  const auto checked = [&](const std::string& model) {
    folder.write("world.xml", world_of("<robot name=\"rover\" model=\"" + model +
                                       "\" at=\"0 0 0\"/><physics.simbody/>\n"
                                       "<control.path3d robot=\"rover\" path=\"way.csv\"/>"
                                       "<control.velocity3d robot=\"rover\"/>"));
    return folder.muster({"check", "world.xml"});
  };
  expect_error(checked("scarab"), 2,
               "world.xml:2:1: control.path3d (control.path3d): the model \"scarab\" of robot \"rover\" "
               "(world.xml:1:36) is on the ground and does not fly; expected <control.waypoint/>, or a model that "
               "flies: hummingbird");
  EXPECT_EQ(checked("hummingbird").exit, 0);
  folder.write("world.xml", world_of("<robot name=\"rover\" model=\"scarab\" at=\"0 0 0\"/><physics.simbody/>\n"
                                     "<control.velocity3d robot=\"rover\"/>"));
  expect_error(folder.muster({"check", "world.xml"}), 2,
               "world.xml:2:1: control.velocity3d (control.velocity3d): the model \"scarab\" of robot \"rover\" "
               "(world.xml:1:36) has no rotors (<muster>, <quadrotor>) and does not fly; expected <control.waypoint/>, "
               "which drives, or a model that flies: hummingbird");
}

TEST(FirstHour, WhatComesAfterTheEnd) {
  EXPECT_EQ(
      warnings_of(rover + "<physics.simbody/>\n<at t=\"45\"><leave robot=\"rover\"/></at>"),
      "warning: world.xml:4:1: <at> comes at 45 s, and the run ends at 1 s, so that it never does; expected a time "
      "below 1 s, or a longer run (until)\n");
}

TEST(FirstHour, AMeshInMillimetresIsAskedAbout) {
  const ProgramFolder folder;
  const std::string faces = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const auto warned = [&](int units, const std::string& more = "") {
    std::string vertices;
    for (int i = 0; i < 8; ++i) {
      const bool far_x = i % 4 == 1 || i % 4 == 2, far_y = i % 4 >= 2;
      vertices += "v " + std::to_string(far_x ? units : 0) + ' ' + std::to_string(far_y ? units : 0) + ' ' +
                  std::to_string(i >= 4 ? units : 0) + '\n';
    }
    folder.write("press.obj", vertices + faces);
    folder.write(
        "world.xml",
        world_of("<material name=\"steel\" loss=\"12\"/>\n<mesh name=\"press\" file=\"press.obj\" "
                 "material=\"steel\" at=\"5 2 0\"" +
                 more + "/>\n" + base + rover + channel + "<network.ideal/><physics.simbody/><radio.meshes/>"));
    return folder.muster({"check", "world.xml"}).out;
  };
  EXPECT_THAT(warned(900),
              testing::HasSubstr("warning: world.xml:2:1: mesh \"press\" is 900.000 m long, and all radios "
                                 "are within 5.000 m; is its file in millimetres? expected "
                                 "scale=\"0.001\"\n"));
  EXPECT_THAT(warned(90), testing::Not(testing::HasSubstr("millimetres")));
  EXPECT_THAT(warned(900, " scale=\"0.5\""), testing::Not(testing::HasSubstr("millimetres")));
}

TEST(FirstHour, AJammerOutsideOfTheNetworksBand) {
  const std::string jammer =
      "<station name=\"noise\" at=\"0 5 1\"/><radio.jammer radio=\"noise\" bandwidth=\"20e6\" frequency=";
  const std::pair<const char*, const char*> networks[] = {{"network.lrwpan", "2402.500 to 2407.500"},
                                                          {"network.wifi", "2402.000 to 2422.000"},
                                                          {"network.bluetooth", "2401.500 to 2480.500"}};
  for (const auto& [network, band] : networks) {
    SCOPED_TRACE(network);
    const std::string world = base + channel + "<" + network + "/>\n" + jammer;
    EXPECT_EQ(warnings_of(world + "\"5.2e9\"/>"),
              std::string("warning: world.xml:4:1: radio 'noise' jams at 5190.000 to 5210.000 MHz, outside of this "
                          "network's ") +
                  band + " MHz, and does nothing to it; expected a frequency inside\n");
    EXPECT_EQ(warnings_of(world + "\"2.41e9\"/>"), "");
  }
}

TEST(FirstHour, AJammerOfANetworkThatFeelsNone) {
  EXPECT_EQ(warnings_of(base + channel + "<network.ideal/>\n<radio.jammer radio=\"base\"/>"),
            "warning: world.xml:5:1: radio.jammer (radio.jammer): writes \"radio/base/emission\", which the network "
            "of this world, network.ideal (world.xml:4:1), does not read, so that it has no effect; expected "
            "network.wifi, network.lrwpan or network.bluetooth\n");
}

}  // namespace
