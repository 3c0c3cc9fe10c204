// Clutter that fills a part of a hall: no room of the plan has its size.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "diagnosis/pipeline/diagnose.hpp"
#include "tests/diagnosis/pipeline/drawn_log.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

// 28 x 16 m, with two shelves.
std::filesystem::path hall_with(const Scratch& scratch, const std::string& name, const std::string& more) {
  std::ofstream(scratch / "walls.csv") << "name,x0[m],y0[m],x1[m],y1[m],height[m],thickness[m],material\n"
                                          "south,0,0,28,0,6,0.3,block\nnorth,0,16,28,16,6,0.3,block\n"
                                          "west,0,0,0,16,6,0.3,block\neast,28,0,28,16,6,0.3,block\n"
                                          "a,12,4,12,8,2.5,0.1,sheet\nb,19,9,19,12,2.5,0.1,sheet\n";
  std::filesystem::path file = scratch / name;
  std::ofstream(file) << "<world name=\"hall\" dt=\"0.1\" until=\"1\" seed=\"6\">"
                      << "<material name=\"sheet\" loss=\"7\"/><material name=\"block\" loss=\"10\"/>"
                      << "<walls file=\"walls.csv\"/><station name=\"west\" at=\"2 9 3\"/>"
                      << "<station name=\"north\" at=\"15 15 2.4\"/><station name=\"east\" at=\"26 3 3\"/>"
                      << "<radio.multiwall tx_power=\"0\" l0=\"32\" n=\"2.2\"/>"
                      << "<radio.fading shadowing=\"2\" decorrelation=\"2\" rician_k=\"8\" per_reading=\"true\"/>"
                      << "<radio.receiver sensitivity=\"-200\"/>" << more << "</world>";
  return file;
}

TEST(Hall, ACornerOfItMayBeCluttered) {
  const Scratch scratch;
  std::vector<std::string> rows;
  double t = 0;
  for (double y = 0.8; y < 15.5; y += 1.2) {
    for (double x = 0.7; x < 27.5; x += 1, t += 2) {
      for (const char* station : {"west,rover,2,9,3", "north,rover,15,15,2.4", "east,rover,26,3,3"})
        rows.push_back(print_real(t) + ',' + station + ',' + print_real(x) + ',' + print_real(y) + ",0.5");
    }
  }
  const std::string hidden =
      "<effect.room_clutter x=\"23\" y=\"12.5\" length=\"7\" width=\"4\" depth=\"0.9\" loss=\"8\"/>";
  const auto measured = drawn_log(scratch, hall_with(scratch, "true.xml", hidden),
                                  "t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],rx_x[m],rx_y[m],rx_z[m]", rows, rows);
  const Diagnosis found = diagnose(hall_with(scratch, "world.xml", ""), measured, plugins);
  ASSERT_EQ(found.causes.size(), 1u) << names_in_words(named_causes(found));
  EXPECT_EQ(found.causes[0].id, "effect.room_clutter");
  for (const CauseValue& v : found.causes[0].values) {
    const double truth = v.name == "x"        ? 23
                         : v.name == "y"      ? 12.5
                         : v.name == "length" ? 7
                         : v.name == "width"  ? 4
                         : v.name == "loss"   ? 8
                                              : v.value;
    EXPECT_NEAR(v.value, truth, v.name == "loss" ? 2.5 : 0.6) << v.name;  // lanes 1.2 m apart
  }
}

// Without a plan, lanes 2 m apart, single readings that scatter by 5 dB. Beside the field that was fitted in its stead
// a rectangle of other edges showed a sixth of its gain.
TEST(Hall, ClutterOfAnySizeIsFoundInAField) {
  const Scratch scratch;
  const auto world = [&](const std::string& name, const std::string& more) {
    return scratch.write(name,
                         "<world name=\"hall\" dt=\"0.1\" until=\"1\" seed=\"9\">"
                         "<station name=\"a\" at=\"1 1 2.5\"/><station name=\"b\" at=\"35 1 2.5\"/>"
                         "<station name=\"c\" at=\"35 23 2.5\"/><station name=\"d\" at=\"1 23 2.5\"/>"
                         "<radio.multiwall tx_power=\"0\" l0=\"42\" n=\"2\"/>"
                         "<radio.fading shadowing=\"0\" rician_k=\"-3\" per_reading=\"true\"/>"
                         "<radio.receiver sensitivity=\"-200\"/>" +
                             more + "</world>");
  };
  std::vector<std::string> rows;
  double t = 0;
  for (double y = 2; y <= 22; y += 2) {
    for (double x = 2; x <= 34; x += 1, t += 1) {
      for (const char* station : {"a,rover,1,1,2.5", "b,rover,35,1,2.5", "c,rover,35,23,2.5", "d,rover,1,23,2.5"})
        rows.push_back(print_real(t) + ',' + station + ',' + print_real(x) + ',' + print_real(y) + ",0.3");
    }
  }
  const auto measured = drawn_log(scratch,
                                  world("true.xml",
                                        "<effect.room_clutter x=\"24.5\" y=\"12.5\" length=\"9\" width=\"7\" "
                                        "depth=\"1.5\" loss=\"10\"/>"),
                                  "t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],rx_x[m],rx_y[m],rx_z[m]", rows, rows);
  const Diagnosis found = diagnose(world("world.xml", ""), measured, plugins);
  ASSERT_EQ(found.causes.size(), 1u) << names_in_words(named_causes(found));
  EXPECT_EQ(found.causes[0].id, "effect.room_clutter");
}

}  // namespace
}  // namespace muster::diagnosis
