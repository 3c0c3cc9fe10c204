// A receiver that reports its lowest level for all that is weaker, as the world states it.
#include <gtest/gtest.h>

#include <sstream>

#include "tests/diagnosis/scratch.hpp"
#include "tests/diagnosis/worlds.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

// Every fourth reading of the hall, none below the level.
std::string hall_above(double level) {
  std::istringstream in(contents(hall / "measured_plain.csv"));
  std::string line, text;
  for (int i = 0; std::getline(in, line); ++i) {
    const std::size_t comma = line.rfind(',') + 1;
    if (i > 0 && parse_real(line.substr(comma)).value() < level) line = line.substr(0, comma) + print_real(level);
    if (i == 0 || i % 4 == 1) text += line + '\n';
  }
  return text;
}

TEST(StatedFloor, ReadingsThereAreUpperBoundsOfTheFit) {
  const Scratch scratch;
  std::string world = contents(hall / "world.xml");
  world.insert(world.rfind("</world>"), R"(<effect.rssi_floor name="floor" level="-40" silent="false"/>)");
  scratch.write("walls.csv", contents(hall / "walls.csv"));
  const std::filesystem::path data = scratch.write("d.csv", hall_above(-40));
  const Dataset readings = read_dataset(data);
  LinkModel model(scratch.write("world.xml", world), data, plugins);
  const Fit fitted = fit(model, readings, {{}, {"floor/level"}});
  EXPECT_GT(fitted.readings.censored.size(), 800u);
  EXPECT_NEAR(parameter(fitted, "radio.multiwall/n").value, 1.7, 0.15);
  EXPECT_NEAR(parameter(fitted, "material/drywall/loss").value, 4.0, 0.4);
}

}  // namespace
}  // namespace muster::diagnosis
