// A corridor that no wall of the map shows is found at its whole length, through the radios that stand in it.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "diagnosis/pipeline/diagnose.hpp"
#include "tests/diagnosis/pipeline/drawn_log.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

std::filesystem::path world_with(const Scratch& scratch, const std::string& name, const std::string& more) {
  std::filesystem::path file = scratch / name;
  std::ofstream(file) << "<world name=\"corridor\" dt=\"0.1\" until=\"1\" seed=\"4\">"
                      << "<station name=\"west\" at=\"4 8.2 2\"/><station name=\"east\" at=\"55 7.7 2\"/>"
                      << "<radio.multiwall tx_power=\"10\" l0=\"40\" n=\"2.6\"/>"
                      << "<radio.fading shadowing=\"2\" decorrelation=\"1.5\" rician_k=\"9\" per_reading=\"true\"/>"
                      << "<radio.receiver sensitivity=\"-200\"/>" << more << "</world>";
  return file;
}

// A tour of 60 x 16 m, lanes 1.6 m apart and those of the corridor 0.6 m, a reading of each station every 1.2 m.
TEST(Corridor, IsFoundWithoutWalls) {
  const Scratch scratch;
  std::vector<std::string> rows;
  double t = 0;
  for (const double y : {1.0, 2.6, 4.2, 5.8, 7.4, 8.0, 8.6, 10.2, 11.8, 13.4, 15.0}) {
    for (double x = 0.5; x < 60; x += 1.2, t += 2) {
      for (const char* station : {"west,rover,4,8.2,2", "east,rover,55,7.7,2"})
        rows.push_back(print_real(t) + ',' + station + ',' + print_real(x) + ',' + print_real(y) + ",1");
    }
  }
  const std::string hidden = "<effect.corridor x0=\"0\" y0=\"8\" x1=\"60\" y1=\"8\" width=\"2.4\" gain=\"0.9\"/>";
  const auto measured = drawn_log(scratch, world_with(scratch, "true.xml", hidden),
                                  "t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],rx_x[m],rx_y[m],rx_z[m]", rows, rows);
  const Diagnosis found = diagnose(world_with(scratch, "world.xml", ""), measured, plugins);
  ASSERT_EQ(found.causes.size(), 1u);
  const CauseEstimate& corridor = found.causes[0];
  EXPECT_EQ(corridor.id, "effect.corridor");
  for (const CauseValue& v : corridor.values) {
    const bool is_gain = v.name == "gain", is_aside = v.name == "y0" || v.name == "y1";
    if (is_gain || is_aside) {
      EXPECT_NEAR(v.value, is_gain ? 0.9 : 8, is_gain ? 0.25 : 0.6) << v.name;
    }
  }
}

}  // namespace
}  // namespace muster::diagnosis
