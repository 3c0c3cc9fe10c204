// Copies of a world in another folder read the files that it reads.
#include "diagnosis/pipeline/extended_world.hpp"

#include <gtest/gtest.h>

#include "diagnosis/radio/links/link_model.hpp"
#include "tests/diagnosis/scratch.hpp"
#include "tests/diagnosis/worlds.hpp"

namespace muster::diagnosis {
namespace {

namespace fs = std::filesystem;

// A plan that worlds share beside the world's folder, one below it, and one in it.
TEST(ExtendedWorld, ReadsThePlanThatItsWorldReads) {
  const Scratch scratch;
  const std::string wall = "name,x0[m],y0[m],x1[m],y1[m],height[m],material\nw,5,0,5,10,3,brick\n";
  const std::string readings = "tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\na,b,0,5,10,5,-60\n";
  const auto table = scratch.write("readings.csv", readings);
  fs::create_directories(scratch.path() / "out/shared");  // beside the copy: no file of the world's
  scratch.write("out/shared/walls.csv", "name,x0[m],y0[m],x1[m],y1[m],height[m],material\nv,50,0,50,10,3,brick\n");
  for (const fs::path plan : {"../shared/walls.csv", "plans/walls.csv", "walls.csv"}) {
    fs::create_directories((scratch.path() / "own" / plan).lexically_normal().parent_path());
    scratch.write(("own" / plan).lexically_normal().string(), wall);
    const auto world = scratch.write("own/world.xml",
                                     "<world name=\"w\" dt=\"1\" until=\"1\" seed=\"1\">\n"
                                     "  <material name=\"brick\" loss=\"7.5\"/>\n  <walls file=\"" +
                                         plan.string() +
                                         "\"/>\n  <station name=\"a\" at=\"0 5 0.5\"/>\n  <radio.multiwall/>\n"
                                         "</world>\n");
    const Eigen::VectorXd given = LinkModel(world, table, plugins).expected();
    const auto extended = write_extended_world({}, world, scratch.path() / "out" / plan.stem());
    EXPECT_EQ(LinkModel(extended, table, plugins).expected(), given) << plan;
    const auto copy = copy_world(world, scratch.path() / "copy");
    EXPECT_EQ(LinkModel(copy, table, plugins).expected(), given) << plan;
    const bool is_there = contents(copy).find("file=\"walls.csv\"") != std::string::npos;
    EXPECT_EQ(is_there, plan == "walls.csv") << contents(copy);
  }
}

CauseEstimate at_place(const std::string& id) {
  CauseEstimate cause;
  cause.id = id;
  cause.values = {{"x", "m", 3, 0, 3, 3, -10, 10}, {"y", "m", 4, 0, 4, 4, -10, 10}};
  return cause;
}

// A place that was found in the world put right for a plan is one of that world: the stronger of both is told first,
// but turned first is the plan.
TEST(ExtendedWorld, WhatWasPutRightFirstStandsFirst) {
  const Scratch scratch;
  fs::create_directories(scratch.path() / "own");
  const auto world = scratch.write("own/world.xml",
                                   "<world name=\"w\" dt=\"1\" until=\"1\" seed=\"1\">\n"
                                   "  <station name=\"a\" at=\"0 5 0.5\"/>\n  <radio.multiwall/>\n</world>\n");
  Diagnosis found;
  found.causes = {at_place("effect.tx_misplaced"), at_place("effect.plan_turned")};
  found.causes[0].row_parameter = "radio";
  found.causes[0].row = "a";
  found.causes[1].words = {{"of", "stations"}, {"how", "mirrored_x"}};
  found.causes[1].corrected_first = true;
  const std::string written = contents(write_extended_world(found, world, scratch.path() / "out"));
  ASSERT_NE(written.find("<effect.tx_misplaced"), written.npos);
  EXPECT_LT(written.find("<effect.plan_turned"), written.find("<effect.tx_misplaced")) << written;
}

}  // namespace
}  // namespace muster::diagnosis
