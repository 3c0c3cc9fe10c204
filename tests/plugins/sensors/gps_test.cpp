// Satellite positioning: geodesy, errors that last, and where there are none.
#include <muster/globe.hpp>

#include "sense_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;

constexpr double degree = 3.141592653589793 / 180;
const std::string wide = "dt=\"0.05\" until=\"1000000\" seed=\"5\"";

Gps told_by(const Simulation& run, const std::string& robot = "r") { return row<Gps>(run, "robot/" + robot + "/gps"); }

// The radii of curvature of the ellipsoid at the origin.
TEST(Globe, IsTheEllipsoidAtItsOrigin) {
  const double lat = 47.3, a = 6378137, e2 = (2 - 1 / 298.257223563) / 298.257223563;
  const double w = std::sqrt(1 - e2 * std::sin(lat * degree) * std::sin(lat * degree));
  const double meridian = a * (1 - e2) / (w * w * w), normal = a / w;
  const GlobePlane plane({lat, 8.5, 400});
  const double step = 1e-5;  // degrees: a metre
  const auto north = plane.east_north_up({lat + step, 8.5, 400}), east = plane.east_north_up({lat, 8.5 + step, 400});
  EXPECT_NEAR(north[1] / (step * degree), meridian + 400, 1);
  EXPECT_NEAR(east[0] / (step * degree), (normal + 400) * std::cos(lat * degree), 1);
  EXPECT_NEAR(plane.east_north_up({lat, 8.5, 410})[2], 10, 1e-8);
}

TEST(Globe, GoesThereAndBack) {
  Stream random(7);
  unsigned drawn = 0;
  const auto uniform = [&](double from, double to) { return from + (to - from) * random.uniform(0, drawn++); };
  for (int i = 0; i < 2000; ++i) {
    const GlobePlane plane({uniform(-89.9, 89.9), uniform(-180, 180), uniform(-100, 5000)});
    const double size = std::pow(10, uniform(0, 5.5));
    const std::array<double, 3> at{uniform(-size, size), uniform(-size, size), uniform(-100, 1e4)};
    const GlobePoint point = plane.point(at[0], at[1], at[2]);
    const auto back = plane.east_north_up(point);
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(back[k], at[k], 2e-8) << size;
  }
}

TEST(Gps, TellsWhereItsAntennaIs) {
  Folder folder;
  Simulation run = world_of(folder,
                            "<robot name=\"r\" at=\"30 -20 0\" heading=\"1.5707963267948966\"/><physics.planar/>"
                            "<sensors.gps latitude=\"47.3\" longitude=\"8.5\" altitude=\"400\" x=\"0.2\" z=\"0.5\"/>",
                            {}, wide);
  run_ticks(run, 4);
  const Gps told = told_by(run);
  const double height = row<Pose>(run, "robot/r/pose").z + 0.5;
  EXPECT_NEAR(told.east, 30, 1e-9);
  EXPECT_NEAR(told.north, -19.8, 1e-9);
  EXPECT_NEAR(told.up, height, 1e-9);
  const auto back = GlobePlane({47.3, 8.5, 400}).east_north_up({told.latitude, told.longitude, told.altitude});
  EXPECT_NEAR(back[0], told.east, 1e-8);
  EXPECT_NEAR(back[1], told.north, 1e-8);
  EXPECT_NEAR(told.altitude, 400 + height, 1e-3) << "the earth falls by 0.1 mm in 36 m";
  EXPECT_NEAR(told.t, 0.2, 1e-12);
}

struct Statistics {
  double variance = 0, covariance = 0;  // of one moment, and of moments a lag apart
};

Statistics of_errors(const std::string& attributes, int ticks, std::size_t lag) {
  Folder folder;
  Simulation run =
      world_of(folder, "<robot name=\"r\" at=\"0 0 0\"/><physics.planar/><sensors.gps rate=\"0\" " + attributes + "/>",
               {}, wide);
  std::vector<double> errors;
  for (int i = 0; i < ticks; ++i) run.step(), errors.push_back(told_by(run).east);
  Statistics result;
  const double count = static_cast<double>(errors.size() - lag);
  for (std::size_t i = 0; i + lag < errors.size(); ++i) {
    result.variance += errors[i] * errors[i] / count;
    result.covariance += errors[i] * errors[i + lag] / count;
  }
  return result;
}

TEST(Gps, HasErrorsThatLastAsLongAsStated) {
  // 1 s is 20 ticks; 40,000 ticks hold 1,000 independent errors.
  const Statistics lasting = of_errors("horizontal=\"2\" correlation=\"1\"", 40000, 20);
  EXPECT_NEAR(lasting.variance / 4, 1, 0.25);
  EXPECT_NEAR(lasting.covariance / lasting.variance, std::exp(-1), 0.12);
  const Statistics white = of_errors("white=\"2\"", 40000, 1);
  EXPECT_NEAR(white.variance / 4, 1, 5 * std::sqrt(2.0 / 40000));
  EXPECT_NEAR(white.covariance / white.variance, 0, 5 / std::sqrt(40000.0));
}

bool has_fix(const std::string& inside, const std::string& attributes = "",
             const std::map<std::string, std::string>& files = {}) {
  Folder folder;
  Simulation run = world_of(folder,
                            "<material name=\"brick\" loss=\"6\"/><material name=\"film\" loss=\"0.5\"/>"
                            "<robot name=\"r\" at=\"0 0 0\"/><physics.planar through_walls=\"true\"/>" +
                                inside + "<sensors.gps rate=\"0\" z=\"0.3\" " + attributes + "/>",
                            files, wide);
  run.step();
  EXPECT_EQ(told_by(run).t, 0.05) << "it tried";
  return !is_null(told_by(run).east);
}

std::string room(double half, const std::string& material = "brick") {
  const std::string h = std::to_string(half), m = "\" material=\"" + material + "\" height=\"3\"/>";
  return "<wall name=\"e\" from=\"" + h + " -" + h + "\" to=\"" + h + " " + h + m + "<wall name=\"n\" from=\"" + h +
         " " + h + "\" to=\"-" + h + " " + h + m + "<wall name=\"w\" from=\"-" + h + " " + h + "\" to=\"-" + h + " -" +
         h + m + "<wall name=\"s\" from=\"-" + h + " -" + h + "\" to=\"" + h + " -" + h + m;
}
std::string roof(double half, const std::string& material = "brick") {
  const std::string h = std::to_string(half);
  return "<floor name=\"roof\" corners=\"-" + h + " -" + h + " " + h + " -" + h + " " + h + " " + h + " -" + h + " " +
         h + "\" z=\"3\" material=\"" + material + "\"/>";
}

TEST(Gps, NeedsTheSky) {
  EXPECT_TRUE(has_fix(""));
  EXPECT_FALSE(has_fix(room(4) + roof(4))) << "indoors";
  EXPECT_TRUE(has_fix(room(4))) << "in a yard the zenith is seen, and the high ones";
  EXPECT_FALSE(has_fix(room(0.5))) << "in a shaft the zenith alone is seen, 1 of 33";
  EXPECT_TRUE(has_fix(room(0.5), "least_sky=\"0.03\""));
  EXPECT_TRUE(has_fix(roof(1))) << "a small roof";
  EXPECT_TRUE(has_fix(room(4) + roof(4), "least_sky=\"0\""));
  EXPECT_TRUE(has_fix(room(4, "film") + roof(4, "film"), "opaque=\"3\"")) << "a tent";
  EXPECT_FALSE(has_fix(room(4, "film") + roof(4, "film")));
}

TEST(Gps, IsDeniedInAreas) {
  EXPECT_FALSE(has_fix("", "areas=\"a.csv\"", {{"a.csv", "x0[m],y0[m],x1[m],y1[m]\n5,5,9,9\n1,1,-1,-1\n"}}));
  EXPECT_TRUE(has_fix("", "areas=\"a.csv\"", {{"a.csv", "x0[m],y0[m],x1[m],y1[m]\n5,5,9,9\n"}}));
}

TEST(Gps, ErrsAlikeWhereverTheWorldIs) {
  const auto errors = [](const std::string& at, double x, double y) {
    Folder folder;
    Simulation run = world_of(folder,
                              "<robot name=\"r\" at=\"" + at +
                                  " 0\"/><physics.planar/>"
                                  "<sensors.gps rate=\"0\" horizontal=\"2\" white=\"1\"/>",
                              {}, wide);
    run_ticks(run, 20);
    return std::pair(told_by(run).east - x, told_by(run).north - y);
  };
  const auto here = errors("0 0", 0, 0), there = errors("120 -340", 120, -340);
  EXPECT_NE(here.first, 0);
  EXPECT_NEAR(here.first, there.first, 1e-9);
  EXPECT_NEAR(here.second, there.second, 1e-9);
}

TEST(Gps, IsTheSameRun) {
  Folder folder;
  expect_one_run(
      [&] {
        return world_in(folder,
                        "<robot name=\"r\" at=\"0 0 0\"/><robot name=\"s\" at=\"3 0 0\"/><physics.planar/>"
                        "<robots.drive/><control.wander/><sensors.gps name=\"g\" rate=\"7\" horizontal=\"1\" "
                        "vertical=\"2\" white=\"0.1\"/>");
      },
      "g");
}

}  // namespace
