// What is sought of a cause, as attributes of its plugin.
#include <gtest/gtest.h>

#include "diagnosis/cause_axes.hpp"

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

}  // namespace
}  // namespace muster::diagnosis
