// Shapes of smooths along a column.
#include "diagnosis/inference/state/smooths.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/diagnosis/inference/synthetic.hpp"

namespace muster::inference {
namespace {

TEST(Smooths, AColumnThatIsCalledLikeTimeIsNoTime) {
  for (const char* time : {"time", "time*position", "time_per_tx"}) EXPECT_TRUE(is_time(time)) << time;
  for (const char* other : {"airtime", "uptime", "time_of_flight", "timer", "airtime*position", "speed"})
    EXPECT_FALSE(is_time(other)) << other;
}

TEST(Bend, IsFlatOnOneSide) {
  const auto world = synthetic::world_of(synthetic::varied(7, 300));
  const Candidate c = bend("battery", world.battery);
  EXPECT_EQ(c.id, "bend~battery");
  ASSERT_FALSE(c.design.grid.empty());
  for (const Eigen::VectorXd& theta : c.design.grid) {
    const Eigen::VectorXd column = c.design.columns(theta);
    for (Index i = 0; i < column.size(); ++i) {
      const double beyond = theta[1] * (world.battery[i] - theta[0]);
      EXPECT_NEAR(column[i], std::max(beyond, 0.0), 1e-12) << theta.transpose();
    }
    EXPECT_GT((column.array() > 0).count(), 25) << theta.transpose();
  }
}

}  // namespace
}  // namespace muster::inference
