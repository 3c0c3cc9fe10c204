// Clocks of measured tables: units since 1970, row numbers, wild stamps, and pauses between sessions.
#include "diagnosis/data/clock.hpp"

#include <gtest/gtest.h>

#include "diagnosis/data/dataset.hpp"
#include "diagnosis/data/recorded_time.hpp"
#include "tests/diagnosis/scratch.hpp"

namespace muster::diagnosis {
namespace {

// A reading of two links in turn at each time.
Dataset at_times(const std::vector<std::string>& times, const std::string& t = "t[s]") {
  const Scratch scratch;
  std::string text = t + ",tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";
  for (std::size_t row = 0; row < times.size(); ++row)
    text += times[row] + (row % 2 ? ",a,b" : ",c,b") + ",0,0,1," + std::to_string(row % 5) + ",-" +
            std::to_string(50 + row % 3) + "\n";
  return read_dataset(scratch.write("d.csv", text));
}

TEST(Clock, CountsSince1970AreReadBySize) {
  const Dataset nano = at_times({"1700000000000000000", "1700000000500000000", "1700000002000000000"});
  EXPECT_NEAR(nano.t[1] - nano.t[0], 0.5, 1e-6);
  EXPECT_NEAR(nano.t[2], 1700000002, 1e-6);
  EXPECT_EQ(nano.notes[0], "t[s] has values such as 1.7000000005e+18: read as nanoseconds since 1970, not as seconds");
  EXPECT_NEAR(at_times({"1700000000000000", "1700000000500000"}).t[1], 1700000000.5, 1e-6);
  EXPECT_NEAR(at_times({"1700000000000", "1700000000500"}).t[1], 1700000000.5, 1e-6);
  const Dataset seconds = at_times({"1700000000.0", "1700000000.5"});
  EXPECT_DOUBLE_EQ(seconds.t[1], 1700000000.5);
  EXPECT_TRUE(seconds.notes.empty());
}

// The table that plugins read has the same times.
TEST(Clock, TheTableItselfIsInSeconds) {
  const Dataset data = at_times({"1700000000000", "1700000000500"});
  EXPECT_EQ(data.table->reals(data.table->require("t", "s")), data.t);
}

TEST(Clock, ARowNumberIsNoClock) {
  const Dataset counted = at_times({"0", "1", "2", "3"}, "t");
  EXPECT_TRUE(counted.t.empty());
  EXPECT_TRUE(counted.covariates.empty());
  EXPECT_EQ(counted.notes,
            (std::vector<std::string>{
                "t has no unit and counts rows: taken as no clock, so nothing is tested in time; if a row "
                "was measured each second, call it t[s]"}));
  const Dataset clock = at_times({"0", "1", "2", "3"});
  EXPECT_EQ(clock.t, (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(clock.notes,
            (std::vector<std::string>{"t[s] rises by one second from row to row: taken as a clock, since it "
                                      "has a unit; if it counts rows, call it t without a unit"}));
  EXPECT_TRUE(at_times({"0", "0", "1", "1"}).notes.empty());
  EXPECT_EQ(complaint([] {
              at_times({"0", "0", "1", "1"}, "t");
            }),
            "d.csv:1:1: column \"t\" has no unit; expected \"t[s]\"");
}

TEST(Clock, AWildStampIsToldByItsRow) {
  std::vector<std::string> times;
  for (int k = 0; k < 200; ++k) times.push_back(std::to_string(1700000000 + k / 2));
  times[77] = "0";
  const Dataset data = at_times(times);
  EXPECT_EQ(data.wild, (std::vector<std::size_t>{77}));
  EXPECT_TRUE(data.is_wild(77));
  EXPECT_FALSE(data.is_wild(78));
  EXPECT_EQ(data.notes,
            (std::vector<std::string>{
                "row 78: t = 0 s lies far outside all other times; the row is left out of all tests in time"}));
}

TEST(Clock, SessionsAreNotWild) {
  std::vector<double> t;
  for (int k = 0; k < 100; ++k) t.push_back(k < 60 ? k : 3.15e7 + k);
  EXPECT_TRUE(wild_stamps(t).empty());
  t[10] = t[20] = 4e9;  // two of a hundred are more than one in a thousand
  EXPECT_TRUE(wild_stamps(t).empty());
}

TEST(RecordedTime, ShortensAPauseOfAYear) {
  std::vector<double> t;
  for (int k = 0; k <= 100; ++k) t.push_back(k);
  for (int k = 0; k <= 100; ++k) t.push_back(3.15e7 + k);
  const RecordedTime time(t);
  EXPECT_TRUE(time.has_pauses());
  EXPECT_NEAR(time.length(), 220, 1e-6);  // a tenth of 200 s for the pause
  EXPECT_NEAR(time.shortened(3.15e7), 120, 1e-6);
  EXPECT_NEAR(time.shortened(3.15e7 + 50), 170, 1e-6);
  for (const double at : {0.0, 42.0, 3.15e7 + 7}) EXPECT_NEAR(time.at(time.shortened(at) / time.length()), at, 1e-6);
}

TEST(RecordedTime, KeepsEvenStepsAndShortBreaks) {
  std::vector<double> hourly, breaks;
  for (int k = 0; k < 50; ++k) {
    hourly.push_back(3600.0 * k);
    breaks.push_back(k + (k < 25 ? 0 : 500));
  }
  for (const auto& t : {hourly, breaks}) {
    const RecordedTime time(t);
    EXPECT_FALSE(time.has_pauses());
    EXPECT_DOUBLE_EQ(time.length(), t.back() - t.front());
    EXPECT_DOUBLE_EQ(time.at(0.25), t.front() + 0.25 * (t.back() - t.front()));
  }
}

// Every hour a few readings within a second, for three days: a day's course is sought over all of them.
TEST(RecordedTime, AScheduleOfSnapshotsHasNoPauses) {
  std::vector<double> daily, now_and_then;
  for (int k = 0; k < 72; ++k) {
    for (const double soon : {0.0, 0.1, 0.3, 0.7}) {
      daily.push_back(3600.0 * k + 60 * (k % 3) + soon);
      now_and_then.push_back(3600.0 * k + (k > 30 ? 1e7 : 0) + soon);
    }
  }
  const RecordedTime time(daily);
  EXPECT_FALSE(time.has_pauses());
  EXPECT_DOUBLE_EQ(time.length(), daily.back() - daily.front());
  EXPECT_TRUE(RecordedTime(now_and_then).has_pauses());  // half a year between two campaigns
}

}  // namespace
}  // namespace muster::diagnosis
