#include "text/doubts.hpp"

#include <gtest/gtest.h>

namespace muster {
namespace {

TEST(Doubts, AnglesBeyondATurnLookLikeDegrees) {
  EXPECT_EQ(angle_doubt(90), "90 rad is more than a full turn; are these degrees? 90 degrees are 1.5708 rad");
  EXPECT_EQ(angle_doubt(-180), "-180 rad is more than a full turn; are these degrees? -180 degrees are -3.1416 rad");
  EXPECT_EQ(angle_doubt(6.28), "");
  EXPECT_EQ(unit_doubt("heading", "rad", 45),
            "45 rad is more than a full turn; are these degrees? 45 degrees are 0.7854 rad");
  EXPECT_EQ(unit_doubt("w", "rad/s", 90),
            "90 rad/s is 14.32 turns a second; are these degrees? 90 degrees a second are 1.571 rad/s");
  EXPECT_EQ(unit_doubt("w", "rad/s", -10), "");
  EXPECT_EQ(unit_doubt("gyro_range", "rad/s", 1e6), "");
}

TEST(Doubts, PowersLookLikeMilliwattsAndLevelsLikeThoseWithoutTheirSign) {
  EXPECT_EQ(unit_doubt("tx_power", "dBm", 100), "100 dBm is 1e+07 W; is this milliwatts? 100 mW are 20 dBm");
  EXPECT_EQ(unit_doubt("tx_power", "dBm", 20), "");
  EXPECT_EQ(unit_doubt("sensitivity", "dBm", 45), "45 dBm: nothing so strong arrives; is a minus missing?");
  EXPECT_EQ(unit_doubt("sensitivity", "dBm", -95), "");
  EXPECT_EQ(unit_doubt("level", "dBm", 45), "");
}

TEST(Doubts, LengthsLookLikeCentimetres) {
  EXPECT_EQ(unit_doubt("thickness", "m", 12), "12 m; is this centimetres? 12 cm are 0.12 m");
  EXPECT_EQ(unit_doubt("thickness", "m", 0.12), "");
  EXPECT_EQ(unit_doubt("antenna", "m", 30), "30 m; is this centimetres? 30 cm are 0.3 m");
  EXPECT_EQ(unit_doubt("antenna", "m", 300), "300 m; is this millimetres? 300 mm are 0.3 m");
  EXPECT_EQ(unit_doubt("thickness", "m", 240), "240 m; is this millimetres? 240 mm are 0.24 m");
  EXPECT_EQ(unit_doubt("range", "m", 30), "");
}

TEST(Doubts, WhatIsPlainlyAnotherSizeIsAskedAbout) {
  EXPECT_EQ(unit_doubt("height", "m", 270), "270 m; is this centimetres? 270 cm are 2.7 m");
  EXPECT_EQ(unit_doubt("height", "m", 30), "");
  EXPECT_EQ(unit_doubt("bandwidth", "Hz", 20), "20 Hz; is this MHz? 20 MHz are 20e6 Hz");
  EXPECT_EQ(unit_doubt("bandwidth", "Hz", 0.02), "0.02 Hz; is this GHz? 0.02 GHz are 0.02e9 Hz");
  EXPECT_EQ(unit_doubt("bandwidth", "Hz", 2e6), "");
  EXPECT_EQ(unit_doubt("frequency", "Hz", 2.44), "2.44 Hz; is this GHz? 2.44 GHz are 2.44e9 Hz");
  EXPECT_EQ(unit_doubt("frequency", "Hz", 2440), "2440 Hz; is this MHz? 2440 MHz are 2440e6 Hz");
  EXPECT_EQ(unit_doubt("frequency", "Hz", 433920), "433920 Hz; is this kHz? 433920 kHz are 433920e3 Hz");
  EXPECT_EQ(unit_doubt("frequency", "Hz", 8.68e8), "");
  EXPECT_EQ(unit_doubt("duty", "", 0), "0: it is never on");
  EXPECT_EQ(unit_doubt("duty", "", 0.1), "");
  EXPECT_EQ(unit_doubt("least", "dBm", -20),
            "-20 dBm: each weaker reading, which is nearly every one, is given as it; expected some -100 dBm");
  EXPECT_EQ(unit_doubt("least", "dBm", -100), "");
}

TEST(Doubts, ConditionsThatNeverOrAlwaysHold) {
  EXPECT_EQ(level_doubt("dBm", Compared::below, 60),
            "60 dBm is above every level that arrives, so that this always holds; is a minus missing?");
  EXPECT_EQ(level_doubt("dBm", Compared::above, 60),
            "60 dBm is above every level that arrives, so that this never holds; is a minus missing?");
  EXPECT_EQ(level_doubt("dBm", Compared::above, -60), "");
  EXPECT_EQ(level_doubt("rad", Compared::above, 90),
            "90 rad is more than a full turn; are these degrees? 90 degrees are 1.5708 rad");
  EXPECT_EQ(level_doubt("rad", Compared::above, 1.5), "");
  EXPECT_EQ(level_doubt("m", Compared::equal, 0.1),
            "a number in m is seldom exactly 0.1, so that this may never hold; expected above or below");
  EXPECT_EQ(level_doubt("", Compared::equal, 1), "");
  EXPECT_EQ(level_doubt("m", Compared::above, 0.1), "");
}

TEST(Doubts, HintsOfAnotherUnitNameWhatWouldBeWithinTheBounds) {
  EXPECT_EQ(unit_hint("Hz", 2.4, 1e6, 1e12), "; 2.4 GHz are 2.4e9 Hz");
  EXPECT_EQ(unit_hint("Hz", 1e15, 1e6, 1e12), "");
  EXPECT_EQ(unit_hint("dBm", 95, -250, 50), "; is a minus missing?");
  EXPECT_EQ(unit_hint("m/s", 200, 0, 10), "; is this in cm/s?");
  EXPECT_EQ(unit_hint("rad", 65, 0.1, 3.1), "; 65 degrees are 1.134 rad");
  EXPECT_EQ(unit_hint("dB", 200, 0, 100), "");
  EXPECT_EQ(unit_hint("dB", -40, 0, 150), "; without the minus? losses and deviations are positive: 40");
  EXPECT_EQ(unit_hint("dB", -70, -60, 60), "");
}

TEST(Doubts, PowersInWattsAreTakenToDecibels) {
  EXPECT_EQ(power_hint("dBm", "100mW"), "; 100mW are 20 dBm");
  EXPECT_EQ(power_hint("dBm", "2 W"), "; 2 W are 33.01 dBm");
  EXPECT_EQ(power_hint("dBm", "W"), "");
  EXPECT_EQ(power_hint("m", "100mW"), "");
}

}  // namespace
}  // namespace muster
