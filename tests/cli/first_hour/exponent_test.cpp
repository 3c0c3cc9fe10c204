// The exponent of a path loss in both logarithms: the paper of the seed does not say which it means.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/errors/program.hpp"

namespace muster::test {
namespace {

// L = 12.9 + 17 lg d, the paper's numbers with the logarithm to the base 10.
TEST(Row44, TheExponentIsToldInBothLogarithms) {
  const ProgramFolder folder;
  folder.write("world.xml",
               "<world name=\"w\" until=\"1\"><station name=\"a\" at=\"0 0 0\"/><station name=\"b\" at=\"5 0 0\"/>"
               "<radio.multiwall tx_power=\"0\" l0=\"20\" n=\"2\"/></world>");
  std::ostringstream readings;
  readings.precision(12);
  readings << "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";
  for (int i = 0; i < 200; ++i) {
    const int row = i / 20;
    const double x = 1 + 0.4 * (i % 20), y = 0.5 * row, rssi = -12.9 - 17 * std::log10(std::hypot(x, y));
    readings << i << ",a,b,0,0," << x << ',' << y << ',' << rssi << '\n';
  }
  folder.write("data.csv", readings.str());
  const std::vector<std::string> words = {"fit", "world.xml", "--data", "data.csv"};
  auto told = words, as_json = words;
  told.insert(told.end(), {"--log", "natural"});
  as_json.insert(as_json.end(), {"--log", "natural", "--json"});
  const auto json = nlohmann::json::parse(folder.muster(as_json).out);
  const auto& natural = json["natural"][0];
  EXPECT_EQ(natural["name"], "radio.multiwall/n");
  EXPECT_NEAR(natural["value"].get<double>(), 1.7 / std::log(10.0), 1e-5);
  EXPECT_NEAR(natural["reach_of_-60_dbm_m"].get<double>(), std::pow(10, 47.1 / 17), 0.1);
  EXPECT_NEAR(natural["reach_if_taken_for_base_10_m"].get<double>(), std::pow(10, 47.1 * std::log(10.0) / 17), 20);
  EXPECT_THAT(folder.muster(told).out, testing::HasSubstr("With natural logarithms, L = l0 + 10 n ln d, the same path "
                                                          "loss has radio.multiwall/n = 0.738"));
  EXPECT_THAT(folder.muster(words).out, testing::Not(testing::HasSubstr("natural")));
}

}  // namespace
}  // namespace muster::test
