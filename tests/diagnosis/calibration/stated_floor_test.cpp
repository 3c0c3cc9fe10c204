// A fit where most readings are lost below the floor that the world states.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "diagnosis/radio/links/stated_clip.hpp"
#include "diagnosis/radio/links/world_draws.hpp"
#include "muster/random.hpp"
#include "tests/diagnosis/scratch.hpp"
#include "tests/diagnosis/worlds.hpp"

namespace muster::diagnosis {
namespace {

// A tracker that drives away from a gateway, to 7 km: an exponent of 3.5, shadowing of 10 dB by stretches of 150 m,
// and normal noise of 2 dB. Those beyond a kilometre that are heard are the stronger ones, to which a line of them
// alone is too near: it leaves a quarter of the losses to the floor.
TEST(StatedFloor, ReadingsThatEndThereAreLostBelowIt) {
  const Scratch scratch;
  const auto world =
      scratch.write("world.xml",
                    "<world name=\"w\" dt=\"0.1\" until=\"1\"><station name=\"gateway\" at=\"0 0 10\"/>"
                    "<station name=\"tracker\" at=\"100 0 1\"/><radio.multiwall tx_power=\"0\" l0=\"20\" n=\"3.5\"/>"
                    "<radio.receiver sensitivity=\"-137\"/></world>\n");
  std::string table = "t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],rx_x[m],rx_y[m],rx_z[m],rssi[dBm]\n";
  const Stream random(key_of("stated floor"));
  for (uint64_t i = 0; i < 1400; ++i) {
    const double x = 100 + 5 * static_cast<double>(i);
    const double level = -20 - 35 * std::log10(x) + 10 * random.of(1).normal(static_cast<uint64_t>(x / 150)) +
                         2 * random.of(2).normal(i);
    table +=
        fmt::format("{},tracker,gateway,{},0,1,0,0,10,{}\n", i, x, level < -137 ? "" : fmt::format("{:.0f}", level));
  }
  const auto file = scratch.write("data.csv", table);
  LinkModel model(world, file, plugins);
  const Fit fitted = fit(model, read_dataset(file), {});
  EXPECT_GT(fitted.missing.count, 700u);
  EXPECT_TRUE(fitted.missing.censored);
  EXPECT_NEAR(parameter(fitted, "radio.multiwall/n").value, 3.5, 0.6);
}

constexpr const char* table_of_two =
    "t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],rx_x[m],rx_y[m],rx_z[m],rssi[dBm]\n0,a,b,0,0,1,900,0,1,-131\n"
    "1,a,b,0,0,1,950,0,1,-133\n";

std::string two_stations(const std::string& receiver) {
  return "<world name=\"w\" dt=\"0.1\" until=\"1\"><station name=\"a\" at=\"0 0 1\"/>"
         "<station name=\"b\" at=\"900 0 1\"/><radio.multiwall tx_power=\"0\" l0=\"40\" n=\"3\"/>"
         "<radio.fading shadowing=\"2\" per_reading=\"true\"/>" +
         receiver + "</world>\n";
}

// A receiver that the world does not write hears what was measured, however weak that is.
TEST(StatedFloor, ADefaultIsNone) {
  const Scratch scratch;
  const auto file = scratch.write("data.csv", table_of_two);
  for (const bool is_written : {false, true}) {
    const auto world =
        scratch.write("world.xml", two_stations(is_written ? "<radio.receiver sensitivity=\"-95\"/>" : ""));
    const LinkModel model(world, file, plugins);
    EXPECT_EQ(silent_below(model.simulation(), -133).has_value(), is_written);
    const auto floors = unstated_floors(model.simulation(), -133);
    EXPECT_EQ(floors.empty(), is_written);
    const WorldDraw draw = WorldDraws(world, file, plugins, std::make_shared<TableCache>(), 1, floors).draw(3, {}, {});
    EXPECT_EQ(draw.drawn.allFinite(), !is_written);
  }
}

TEST(StatedFloor, ADefaultHoldsWhereReadingsAreLostBelowIt) {
  const Scratch scratch;
  const auto file = scratch.write("data.csv", table_of_two);
  const LinkModel model(scratch.write("world.xml", two_stations("")), file, plugins);
  const Simulation& world = model.simulation();
  const double none = std::nan("");
  const auto floor = [&](const Eigen::Vector3d& received) {
    const std::optional<double> end = weakest_of_some(received);
    EXPECT_EQ(unstated_floors(world, end).empty(), silent_below(world, end).has_value());
    return silent_below(world, end);
  };
  EXPECT_EQ(floor({-60, none, -94.6}), -95);
  EXPECT_EQ(floor({-60, none, -95}), -95);
  EXPECT_EQ(floor({-60, none, -92}), std::nullopt);    // nothing says that the loss lies below
  EXPECT_EQ(floor({-60, none, -95.2}), std::nullopt);  // a receiver that hears more
  EXPECT_EQ(floor({-60, -80, -95}), std::nullopt);     // nothing is lost
  EXPECT_EQ(floor({none, none, none}), std::nullopt);  // nothing is heard
}

}  // namespace
}  // namespace muster::diagnosis
