// A model of some of the readings, beside that of all.
#include "diagnosis/radio/links/fewer_readings.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/diagnosis/scratch.hpp"
#include "tests/diagnosis/worlds.hpp"

namespace muster::diagnosis {
namespace {

// Stations a, b and c, and a rover; c stands in another place once, in the fifth row of twenty.
struct Yard {
  Scratch scratch;
  std::filesystem::path world =
      scratch.write("world.xml",
                    "<world name=\"w\" dt=\"1\" until=\"1\" seed=\"1\">\n  <material name=\"brick\" loss=\"7.5\"/>\n"
                    "  <wall name=\"w\" from=\"5 0\" to=\"5 10\" height=\"3\" material=\"brick\"/>\n"
                    "  <station name=\"a\" at=\"0 0 0.5\"/>\n  <radio.multiwall/>\n</world>\n");
  std::filesystem::path table = scratch.write("readings.csv", rows());
  LinkModel all{world, table, plugins};

  static std::string rows() {
    std::string result = "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";
    for (int i = 0; i < 20; ++i) {
      const char* const from[] = {"a,rover,0,0", "b,rover,9,1", "c,rover,4,8"};
      const std::string tx = i == 4 ? "c,rover,6,8" : from[i % 3];
      result += std::to_string(i) + ',' + tx + ',' + std::to_string(0.5 * i) + ",3,-60\n";
    }
    return result;
  }
};

TEST(FewerReadings, ArePredictedAsAmongAll) {
  Yard yard;
  const std::vector<Eigen::Index> rows{3, 10, 17};
  const auto few = with_fewer_readings(yard.all, yard.table, rows);
  ASSERT_TRUE(few);
  EXPECT_LE(2 * few->model->rows(), yard.all.rows());
  EXPECT_EQ(few->model->expected()(few->rows), yard.all.expected()(rows));
  for (const double n : {2.5, 4.0}) {
    few->model->set("radio.multiwall/n", n);
    yard.all.set("radio.multiwall/n", n);
    EXPECT_EQ(few->model->expected()(few->rows), yard.all.expected()(rows));
  }
}

// Which radios there are, and that c does not stand, is in rows that nobody asked for.
TEST(FewerReadings, TellWhichRadiosThereAreAndWhichStand) {
  const Yard yard;
  const auto few = with_fewer_readings(yard.all, yard.table, {0});
  ASSERT_TRUE(few);
  EXPECT_EQ(few->model->radio_names(), yard.all.radio_names());
  std::set<double> places_of_c;
  for (const auto& ends : few->model->ends()) {
    if (few->model->radio_name(ends[0].radio) == "c") places_of_c.insert(ends[0].x);
  }
  EXPECT_EQ(places_of_c, (std::set<double>{4, 6}));
}

// A radio of the data is numbered by where it first sends, then by where it first hears.
TEST(FewerReadings, NumberTheRadiosOfAMeshAsAllDo) {
  const Scratch scratch;
  std::string rows = "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";
  for (int i = 0; i < 60; ++i) {
    const int from = i / 3 % 4, to = (from + 1 + i % 3) % 4;
    const auto node = [](int k) { return "n" + std::to_string(k); };
    const auto place = [](int k) { return "," + std::to_string(3 * k) + "," + std::to_string(k * k); };
    rows += std::to_string(i) + ',' + node(from) + ',' + node(to) + place(from) + place(to) + ",-60\n";
  }
  const auto table = scratch.write("mesh.csv", rows);
  const LinkModel all(scratch.write("mesh.xml",
                                    "<world name=\"w\" dt=\"1\" until=\"1\" seed=\"1\">"
                                    "<radio.multiwall/></world>\n"),
                      table, plugins);
  const auto few = with_fewer_readings(all, table, {31, 50});
  ASSERT_TRUE(few);
  EXPECT_EQ(few->model->radio_names(), all.radio_names());
}

TEST(FewerReadings, AreNoneWhereMostAreAskedFor) {
  const Yard yard;
  std::vector<Eigen::Index> most;
  for (Eigen::Index i = 0; i < 12; ++i) most.push_back(i);
  EXPECT_FALSE(with_fewer_readings(yard.all, yard.table, most));
}

}  // namespace
}  // namespace muster::diagnosis
