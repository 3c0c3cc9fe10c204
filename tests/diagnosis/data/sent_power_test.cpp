// Readings at several powers of one radio: as received, or referred to a nominal power.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <sstream>

#include "diagnosis/data/dataset.hpp"
#include "tests/diagnosis/scratch.hpp"

namespace muster::diagnosis {
namespace {

struct Readings {
  std::vector<double> powers;                       // dBm, set in turn
  std::function<double(std::size_t power)> beside;  // dB, of each beside path loss and scatter
  bool is_set_once = false;                         // each radio to a power of its own
  double floor = -1000;                             // dBm, below which a reading is lost
  double scatter = 3;                               // dB
  std::size_t count = 400;
  double lost = 0;  // share of the readings, by chance
};

// Two radios that drive away from a third; a path loss of 2.5.
Dataset read(const Readings& readings) {
  std::mt19937 random(5);
  std::normal_distribution<double> scatter(0, readings.scatter);
  std::ostringstream text;
  text << "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm],power[dBm]\n";
  for (std::size_t i = 0; i < readings.count; ++i) {
    const std::size_t radio = i % 2, power = readings.is_set_once ? radio : i / 2 % readings.powers.size();
    const double x = 1 + 40 * static_cast<double>(i) / static_cast<double>(readings.count);
    const double level = -40 - 25 * std::log10(x) + readings.beside(power) + scatter(random);
    text << i << ',' << (radio ? "b" : "a") << ",base," << x << ",0,0,0,";
    if (level >= readings.floor && std::uniform_real_distribution<double>()(random) >= readings.lost) text << level;
    text << ',' << readings.powers[power] << '\n';
  }
  const Scratch scratch;
  return read_dataset(scratch.write("d.csv", text.str()));
}

bool is_referred(const Dataset& data) {
  return std::any_of(data.notes.begin(), data.notes.end(),
                     [](const std::string& note) { return note.find("referred to a power of") != std::string::npos; });
}

TEST(SentPower, LevelsThatFollowItAreReferredToTheMiddle) {
  const std::vector<double> powers{-4, 2, 8, 14};
  const Dataset raw = read({powers, [&](std::size_t k) { return powers[k]; }});
  const Dataset same = read({powers, [&](std::size_t) { return 5.0; }});
  ASSERT_TRUE(is_referred(raw));
  EXPECT_FALSE(is_referred(same));
  for (std::size_t i = 0; i < raw.rows(); ++i) EXPECT_NEAR(raw.rssi[i], same.rssi[i], 1e-3);
}

// Where three in five are lost, those of the lowest power that are heard are nearly as strong as the others.
TEST(SentPower, IsLookedForWhereHardlyAnyReadingIsLost) {
  const std::vector<double> powers{-4, 2, 8, 14};
  EXPECT_TRUE(is_referred(read({powers, [&](std::size_t k) { return powers[k]; }, false, -62, 8, 2000})));
}

// Losses by chance, at any distance, hide nothing. The middle is that of the powers that were set.
TEST(SentPower, IsFollowedWhereReadingsAreLostByChance) {
  const std::vector<double> powers{-4, 2, 8, 14};
  const Dataset data = read({powers, [&](std::size_t k) { return powers[k]; }, false, -1000, 3, 2000, 0.15});
  ASSERT_TRUE(is_referred(data));
  EXPECT_EQ(*std::max_element(data.referred.begin(), data.referred.end()), 9);
  EXPECT_EQ(*std::min_element(data.referred.begin(), data.referred.end()), -9);
}

TEST(SentPower, OfAnAmplifierThatIsNearlyRight) {
  const std::vector<double> powers{-4, 2, 8, 14};
  EXPECT_TRUE(is_referred(read({powers, [&](std::size_t k) { return 0.85 * powers[k]; }})));
}

TEST(SentPower, ErrorsOfPowersAreNoPowers) {
  const std::vector<double> powers{-4, 2, 8, 14}, errors{0, 4, -3, 5};
  EXPECT_FALSE(is_referred(read({powers, [&](std::size_t k) { return errors[k]; }})));
  EXPECT_FALSE(is_referred(read({powers, [&](std::size_t k) { return -powers[k]; }})));
}

TEST(SentPower, SmallStepsMayBeErrors) {
  const std::vector<double> powers{0, 2, 4};
  EXPECT_FALSE(is_referred(read({powers, [&](std::size_t k) { return powers[k]; }})));
}

TEST(SentPower, APowerForEachRadioTellsNothing) {
  const std::vector<double> powers{0, 10};
  EXPECT_FALSE(is_referred(read({powers, [&](std::size_t k) { return powers[k]; }, true})));
}

}  // namespace
}  // namespace muster::diagnosis
