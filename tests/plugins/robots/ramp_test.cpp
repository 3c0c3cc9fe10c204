#include "plugins/robots/ramp.hpp"

#include <gtest/gtest.h>

namespace {

using namespace muster;

TEST(Ramp, WhatNoLimitForbidsIsLeftAlone) {
  const WheelRates r = limited(WheelRates{3, -2}, 3);
  EXPECT_EQ(r.left, 3);
  EXPECT_EQ(r.right, -2);
}

TEST(Ramp, SaturationKeepsTheTurningRadius) {
  const WheelRates r = limited(WheelRates{30, 24}, 20);
  EXPECT_DOUBLE_EQ(r.left, 20);
  EXPECT_DOUBLE_EQ(r.right, 16);
  const WheelRates back = limited(WheelRates{-24, 60}, 20);
  EXPECT_DOUBLE_EQ(back.left, -8);
  EXPECT_DOUBLE_EQ(back.right, 20);
}

TEST(Ramp, NoWheelChangesByMoreThanTheLimit) {
  const WheelRates r = ramped(WheelRates{0, 0}, WheelRates{10, 5}, 2);
  EXPECT_DOUBLE_EQ(r.left, 2);
  EXPECT_DOUBLE_EQ(r.right, 1);  // half as far, so the radius holds along the ramp
}

TEST(Ramp, ArrivesExactly) {
  const WheelRates r = ramped(WheelRates{9.9, 0.1}, WheelRates{10.3, -0.3}, 0.5);
  EXPECT_EQ(r.left, 10.3);
  EXPECT_EQ(r.right, -0.3);
}

}  // namespace
