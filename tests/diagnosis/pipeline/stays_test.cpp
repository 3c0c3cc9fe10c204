// Logs of short stays: a burst of readings at each place, then a pause, and all places again in another session.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "diagnosis/pipeline/diagnose.hpp"
#include "muster/random.hpp"
#include "tests/diagnosis/scratch.hpp"
#include "tests/diagnosis/worlds.hpp"

namespace muster::diagnosis {
namespace {

constexpr int places = 6;
constexpr double session = 784000;  // s, from the start of one to that of the next: nine days

// What the twelve stays at six distances from a beacon have besides: each a level of its own, the second session a
// step.
struct Hidden {
  double of_stay = 0, step = 0;  // dB
};

double begin_of(int stay) {
  const int sessions = stay / places;
  return session * sessions + 700 * (stay % places);
}

std::filesystem::path log_of(const Scratch& scratch, const Hidden& hidden) {
  constexpr int readings = 70;
  const Stream random(key_of("stays"));
  std::ofstream out(scratch / "log.csv");
  out << "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";
  for (int stay = 0; stay < 2 * places; ++stay) {
    const double distance = 2 + 1.7 * (stay % places),
                 level = hidden.of_stay * random.normal(static_cast<uint64_t>(stay), 1);
    for (int k = 0; k < readings; ++k) {
      const int number = readings * stay + k;
      const double noise = 3 * random.normal(static_cast<uint64_t>(number), 2);
      out << fmt::format("{:.2f},beacon,phone,0,0,{:.2f},0,{:.0f}\n", begin_of(stay) + 0.5 * k, distance,
                         -45 - 20 * std::log10(distance) + level + (stay < places ? 0 : hidden.step) + noise);
    }
  }
  return scratch / "log.csv";
}

Diagnosis found_in(const Hidden& hidden) {
  const Scratch scratch;
  std::ofstream(scratch / "world.xml")
      << "<world name=\"w\" dt=\"0.1\" until=\"1\"><station name=\"beacon\" at=\"0 0 1\"/>"
         "<station name=\"phone\" at=\"2 0 1\"/>"
         "<radio.multiwall tx_power=\"0\" l0=\"45\" n=\"2\"/></world>\n";
  return diagnose(scratch / "world.xml", log_of(scratch, hidden), plugins);
}

// Someone stands elsewhere at each stay. It was a swing of a period that no reading bears out, or adequate.
TEST(Stays, DecideWhatHappensBetweenThem) {
  const Diagnosis found = found_in({5, 0});
  for (const CauseEstimate& c : found.causes) {
    EXPECT_FALSE(c.changes_in_time()) << c.id;
    EXPECT_NE(c.doubt, "") << c.id;  // people explain some of it
  }
  EXPECT_STRNE(found.verdict(), "adequate");
  ASSERT_TRUE(found.stays);
  EXPECT_EQ(found.stays->count, 2 * places);
  EXPECT_NEAR(found.stays->sd, 5, 2.5);
  EXPECT_NEAR(found.stays->reading_sd, 3, 0.3);
}

TEST(Stays, AreSilentWhereTheyHaveNothingOfTheirOwn) {
  const Diagnosis found = found_in({});
  EXPECT_STREQ(found.verdict(), "adequate");
  EXPECT_FALSE(found.stays);
}

// It happened some time in nine days: between the last reading of one session and the first of the next.
TEST(Stays, AStepBetweenSessionsIsKnownToThePause) {
  const Diagnosis found = found_in({0.5, -20});
  ASSERT_FALSE(found.causes.empty());
  EXPECT_EQ(found.causes[0].id, "effect.step");
  const std::vector<CauseValue>& values = found.causes[0].values;
  const auto at = std::find_if(values.begin(), values.end(), [](const CauseValue& v) { return v.name == "at"; });
  ASSERT_NE(at, values.end());
  EXPECT_GE(at->lower95, begin_of(places - 1) + 30);
  EXPECT_LE(at->upper95, begin_of(places) + 5);
  EXPECT_GT(at->upper95 - at->lower95, session / 2);
}

}  // namespace
}  // namespace muster::diagnosis
