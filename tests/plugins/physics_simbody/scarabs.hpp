// Scarabs to drive in tests.
#pragma once

#include <gtest/gtest.h>

#include "fleet.hpp"

namespace muster::simbody {

inline void expect_same_bits(const RobotState& a, const RobotState& b) {
  EXPECT_EQ(a.pose, b.pose);
  EXPECT_EQ(a.twist, b.twist);
  EXPECT_EQ(a.angle, b.angle);
  EXPECT_EQ(a.rate, b.rate);
  EXPECT_EQ(a.rotors, b.rotors);
  EXPECT_EQ(a.memory.previous_step, b.memory.previous_step);
  EXPECT_EQ(a.memory.impulse, b.memory.impulse);
  for (std::size_t k = 0; k < a.memory.kept.size(); ++k) {
    EXPECT_EQ(a.memory.kept[k].id, b.memory.kept[k].id);
    EXPECT_EQ(a.memory.kept[k].impulse, b.memory.kept[k].impulse);
  }
}

}  // namespace muster::simbody
