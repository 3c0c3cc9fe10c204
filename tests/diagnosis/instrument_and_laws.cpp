// What readings show of their receiver, and the laws of a single reading: closed forms, and draws whose law is known.
#include <gtest/gtest.h>

#include <cmath>
#include <muster/random.hpp>

#include "diagnosis/instrument.hpp"
#include "diagnosis/scatter.hpp"
#include "tests/diagnosis/scratch.hpp"

namespace muster::diagnosis {
namespace {

// `at_top` readings at -40 dBm, five at -41, and 10 at each level from -42 to -60.
Dataset readings(const Scratch& scratch, int at_top) {
  std::string text = "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";
  int row = 0;
  const auto add = [&](int level, int count) {
    for (int k = 0; k < count; ++k, ++row)
      text += std::to_string(row) + ",a,b,0,0," + std::to_string(row % 9 + 1) + ",2," + std::to_string(level) + "\n";
  };
  for (int level = -60; level < -41; ++level) add(level, 10);
  add(-41, 5);
  add(-40, at_top);
  return read_dataset(scratch.write("data.csv", text));
}

TEST(InstrumentChecks, ReadingsThatPileUpAreAClip) {
  const Scratch scratch;
  const Instrument found = instrument_of(readings(scratch, 40));
  EXPECT_DOUBLE_EQ(found.step, 1);
  ASSERT_TRUE(found.top);
  EXPECT_DOUBLE_EQ(found.top->level, -40);
  EXPECT_EQ(found.top->count, 40u);
  EXPECT_EQ(found.top->beside, 5u);
  EXPECT_EQ(found.top->row, 195u);
  EXPECT_LT(found.top->log_p, std::log(1e-6));
  EXPECT_FALSE(found.bottom);  // 10 at the lowest level, 10 beside it
}

TEST(InstrumentChecks, ALevelThatIsReadOftenIsNoClip) {
  const Scratch scratch;
  EXPECT_FALSE(instrument_of(readings(scratch, 10)).top);  // no more than neighbours have
  EXPECT_FALSE(instrument_of(readings(scratch, 14)).top);  // too few to say
}

TEST(LawOfAReading, VariancesAreThoseOfRayleighAndGamma) {
  const double decibel = 10 / std::log(10.0);
  EXPECT_NEAR(fading_variance(-40, 1), decibel * decibel * M_PI * M_PI / 6, 0.1);
  EXPECT_NEAR(fading_variance(-40, 4), decibel * decibel * 0.2838229557, 0.02);  // trigamma(4)
  for (const double k : {-3.0, 4.0, 12.0}) EXPECT_NEAR(rician_k_of(fading_variance(k, 1), 1), k, 0.01);
  EXPECT_TRUE(std::isnan(rician_k_of(60, 1)));
}

TEST(LawOfAReading, DensitiesHaveTheirMassAboutTheirMean) {
  const ReadingDensity density({.rician_k = 5, .outliers = 0.02, .channel_sd = 3, .channels = 2}, 0.7, 1);
  double mass = 0, mean = 0;
  for (double db = -60; db < 60; db += 0.05) {
    mass += 0.05 * std::exp(density.log_at(db));
    mean += 0.05 * db * std::exp(density.log_at(db));
  }
  EXPECT_NEAR(mass, 1, 0.01);
  EXPECT_NEAR(mean, 0, 0.05);
}

struct Truth {
  double rician_k = 6, outliers = 0, channel_sd = 0;  // dB; channels: two
};

Scatter drawn(const Truth& truth, int rows) {
  Scatter result;
  const Stream random(combined(key_of("law test"), 3));
  const double k = std::pow(10, truth.rician_k / 10), steady = std::sqrt(k / (1 + k)),
               diffuse = std::sqrt(0.5 / (1 + k));
  for (int r = 0; r < rows; ++r) {
    const auto row = static_cast<uint64_t>(r);
    ScatterRow out{0, 2.0, {}};
    const double level = std::sqrt(2.0) * random.normal(row, 100);
    for (uint64_t j = 0; j < 3; ++j) {
      const double re = steady + diffuse * random.normal(row, 10 * j), im = diffuse * random.normal(row, 10 * j + 1);
      double db = 10 * std::log10(re * re + im * im);
      if (random.uniform(row, 10 * j + 2) < truth.outliers) db += 40 * random.uniform(row, 10 * j + 3) - 20;
      if (truth.channel_sd > 0) db += random.uniform(row, 10 * j + 4) < 0.5 ? truth.channel_sd : -truth.channel_sd;
      out.readings.push_back(std::round(level + db));
    }
    result.rows.push_back(out);
  }
  double sum = 0;
  for (const ScatterRow& row : result.rows) sum += row.readings[0] + row.readings[1] + row.readings[2];
  for (ScatterRow& row : result.rows) {
    for (double& reading : row.readings) reading -= sum / (3 * rows);
  }
  result.within = 0.1;
  return result;
}

TEST(LawsOfReadings, TheStatedLawIsNotLeftWithoutReason) {
  for (const LawTest& test : law_tests(drawn({.rician_k = 6}, 700), {.rician_k = 6}))
    EXPECT_LT(test.evidence, 0) << test.cause;
}

TEST(LawsOfReadings, AnotherFadingIsMeasured) {
  const LawTest best = law_tests(drawn({.rician_k = 2}, 700), {.rician_k = 8}).front();
  EXPECT_EQ(best.cause, "effect.fading_law");
  EXPECT_GT(best.evidence, 20);
  EXPECT_LT(best.values[0].lower95, 2);
  EXPECT_GT(best.values[0].upper95, 2);
}

TEST(LawsOfReadings, OutliersAreCounted) {
  const LawTest best = law_tests(drawn({.rician_k = 8, .outliers = 0.03}, 700), {.rician_k = 8}).front();
  EXPECT_EQ(best.cause, "effect.outliers");
  EXPECT_NEAR(best.values[0].value, 0.03, 0.012);
}

TEST(LawsOfReadings, HoppingChannelsAreToldFromFading) {
  const LawTest best = law_tests(drawn({.rician_k = 12, .channel_sd = 4}, 700), {.rician_k = 12}).front();
  EXPECT_EQ(best.cause, "effect.channel_mixture");
  EXPECT_NEAR(best.values[0].value, 4, 0.6);
}

}  // namespace
}  // namespace muster::diagnosis
