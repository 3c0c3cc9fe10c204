// What is sought of a cause, as attributes of its plugin.
#include <gtest/gtest.h>

#include "diagnosis/cause_axes.hpp"
#include "diagnosis/found_cause.hpp"

namespace muster::diagnosis {
namespace {

// exp(log(100)) lies above 100, which a plugin would refuse.
TEST(CauseShape, AParameterSoughtByItsLogarithmStaysInsideItsBounds) {
  muster_param permittivity{};
  permittivity.name = "permittivity";
  permittivity.unit = "";
  permittivity.min = 1.5;
  permittivity.max = 100;
  permittivity.flags = MUSTER_LOG;
  CauseShape shape;
  const auto axis = axis_of(permittivity, Survey{}, shape, true);
  ASSERT_TRUE(axis);
  shape.axes = {*axis};
  for (const double end : {axis->lower, axis->upper}) {
    const double value = shape.parameters(Eigen::Vector2d(0, end)).at("permittivity");
    EXPECT_GE(value, permittivity.min);
    EXPECT_LE(value, permittivity.max);
  }
}

// Between two that are tried a swing loses little: half a cycle off over the data, a wave keeps 40 % of its energy.
TEST(CauseShape, SwingsOfManyCyclesAreSought) {
  muster_param period{};
  period.name = "period";
  period.unit = "s";
  period.min = 0.1;
  period.max = 1e6;
  period.flags = MUSTER_LOG;
  CauseShape shape;
  shape.wave = "phase";
  Survey survey;
  survey.time.low = 100;
  survey.time.high = 1300;
  const auto axis = axis_of(period, survey, shape, true);
  ASSERT_TRUE(axis);
  for (double cycles = 2; cycles < 120; cycles += 0.37) {
    double nearest = 1e9;
    for (const double value : axis->values) nearest = std::min(nearest, std::abs(1200 / std::exp(value) - cycles));
    EXPECT_LE(nearest, 0.4) << cycles;
    EXPECT_LT(axis->lower, std::log(1200 / cycles));
  }
}

// A factor of e either way: 1.96 of those, and not 216 dB about 100.
TEST(FoundCause, IntervalOfAParameterSoughtByItsLogarithmIsAFactor) {
  muster_param knee{};
  knee.name = "knee";
  knee.unit = "dB";
  knee.min = 1;
  knee.max = 1e4;
  knee.flags = MUSTER_LOG;
  muster_cause meaning{};
  meaning.title = meaning.ranges_over = meaning.tell_apart = "";
  muster_plugin plugin{};
  plugin.params = &knee;
  plugin.param_count = 1;
  plugin.cause = &meaning;
  auto shape = std::make_shared<CauseShape>();
  shape->cause.plugin = &plugin;
  shape->axes = {*axis_of(knee, Survey{}, *shape, true)};
  search::Finding found;
  found.theta = Eigen::Vector2d(0, std::log(100));
  for (const double way : {-1, 1}) found.thetas.push_back(Eigen::Vector2d(0, std::log(100) + way));
  const FoundCause cause = found_cause(found, {shape, {}});
  ASSERT_EQ(cause.values.size(), 1u);
  EXPECT_NEAR(cause.values[0].lower95, 100 * std::exp(-1.96), 1e-9);
  EXPECT_NEAR(cause.values[0].upper95, 100 * std::exp(1.96), 1e-9);
}

}  // namespace
}  // namespace muster::diagnosis
