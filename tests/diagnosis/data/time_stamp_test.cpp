// Dates, clock times and counts since 1970 against seconds computed by hand.
#include "diagnosis/data/time_stamp.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/diagnosis/scratch.hpp"

namespace muster::diagnosis {
namespace {

double seconds(const std::string& text) {
  const auto stamp = parse_stamp(text);
  return stamp ? static_cast<double>(stamp->whole) + stamp->fraction : std::nan("");
}

TEST(TimeStamp, DatesAreSecondsSince1970) {
  const double at = 1714739696;  // date -u -d '2024-05-03 12:34:56' +%s
  for (const char* text : {"2024-05-03T12:34:56", "2024-05-03 12:34:56", "2024-05-03T12:34:56Z", "2024/05/03 12:34:56",
                           "03.05.2024 12:34:56", "20240503T123456Z", "20240503T12:34:56", "2024-05-03T14:34:56+02:00",
                           "2024-05-03T14:34:56+0200", "2024-05-03 14:34:56 +02", "2024-05-03T07:04:56-05:30"})
    EXPECT_DOUBLE_EQ(seconds(text), at) << text;
  EXPECT_DOUBLE_EQ(seconds("2024-05-03 12:34:56.789"), at + 0.789);
  EXPECT_DOUBLE_EQ(seconds("2024-05-03 12:34:56,789"), at + 0.789);
  EXPECT_DOUBLE_EQ(seconds("2024-05-03"), 1714694400);
  EXPECT_DOUBLE_EQ(seconds("2024-02-29"), 1709164800);
  EXPECT_DOUBLE_EQ(seconds("1969-12-31T23:59:59"), -1);
}

TEST(TimeStamp, ClockTimesAreSecondsSinceMidnight) {
  EXPECT_EQ(parse_stamp("12:34:56")->kind, StampKind::clock);
  EXPECT_DOUBLE_EQ(seconds("12:34:56.5"), 45296.5);
  EXPECT_DOUBLE_EQ(seconds("9:05"), 32700);
}

TEST(TimeStamp, OtherTextIsNone) {
  for (const char* text : {"", "noon", "24:00:00", "12:60:00", "12:34:56x", "2024-13-01", "2023-02-29", "2024-05-03T",
                           "2024-05-03 1234:56", "03/05/2024", "2024-05/03", "2024-05-03T12:34:56+25:00", "1e400", "-"})
    EXPECT_FALSE(parse_stamp(text)) << text;
  EXPECT_EQ(why_no_stamp("03/05/2024 12:00"),
            "\"03/05/2024 12:00\" may begin with the day or with the month; expected 2024-05-03");
  EXPECT_EQ(
      why_no_stamp("noon"),
      "\"noon\" is no time; expected such as 2024-05-03T12:34:56.789, 2024-05-03 12:34:56, 12:34:56, or a number of "
      "seconds, milli-, micro- or nanoseconds");
}

TEST(TimeStamp, IsPrintedAsItIsRead) {
  const auto stamp = parse_stamp("2024-05-03 12:34:56.789");
  EXPECT_EQ(print_date(stamp->whole, stamp->fraction + 1e-9), "2024-05-03T12:34:56.789Z");
  EXPECT_EQ(print_date(0, 0), "1970-01-01T00:00:00Z");
}

struct Column {
  std::vector<double> seconds;
  std::vector<std::string> assumed;
};

Column column(const std::vector<std::string>& texts, const std::optional<Stamp>& since = {}) {
  std::vector<StampCell> cells;
  for (std::size_t k = 0; k < texts.size(); ++k)
    cells.push_back({texts[k], {"log.csv", static_cast<int>(k) + 2, 0}, 0});
  Column result;
  result.seconds = seconds_of(cells, since, result.assumed);
  return result;
}

TEST(TimeStamps, CountsOfAnyUnitGiveTheSameSeconds) {
  for (const std::string zeros : {"", "000", "000000", "000000000"}) {
    const Column found = column({"1714739696" + zeros, "1714739698" + zeros});
    EXPECT_EQ(found.seconds, (std::vector<double>{0, 2}));
    EXPECT_EQ(found.assumed.back(), "times are counted from 2024-05-03T12:34:56Z, the first one");
  }
  EXPECT_DOUBLE_EQ(column({"1714739696000000001", "1714739696000000042"}).seconds[1], 41e-9);  // no double holds these
  EXPECT_EQ(column({"1714739696000", "1714739697000"}).assumed[0], "times are milliseconds since 1970, by their size");
}

TEST(TimeStamps, ASecondDayFollowsMidnight) {
  const Column found = column({"23:59:59", "0:00:01", "12:00:00", "23:00:00", "1:00:00"});
  EXPECT_EQ(found.seconds, (std::vector<double>{0, 2, 43201, 82801, 90001}));
  EXPECT_EQ(found.assumed,
            (std::vector<std::string>{"clock times have no date: all begin on one day, and pass midnight 2 "
                                      "times",
                                      "times are counted from 23:59:59, the first one"}));
}

TEST(TimeStamps, AreCountedSinceAStatedTime) {
  EXPECT_EQ(column({"2024-05-03 12:00:10"}, parse_stamp("2024-05-03 12:00")).seconds, (std::vector<double>{10}));
  EXPECT_EQ(complaint([] { column({"12:00:10"}, parse_stamp("2024-05-03 12:00")); }),
            "log.csv:2: times are a clock time, and the map counts them since a date; expected the same kind");
}

TEST(TimeStamps, OfTwoKindsAreRefused) {
  EXPECT_EQ(
      complaint([] {
        column({"2024-05-03 12:00:10", "12:00:11"});
      }),
      "log.csv:3: \"12:00:11\" is a clock time, while line 2 has \"2024-05-03 12:00:10\"; expected one kind of time "
      "in the whole column");
  EXPECT_EQ(complaint([] { column({"", ""}); }), "log.csv:2: no cell of the column has a time");
}

// A logger that boots before its clock is set.
TEST(TimeStamps, AWildFirstOneIsNoOrigin) {
  std::vector<std::string> texts{"1970-01-01 00:00:03"};
  for (int k = 0; k < 60; ++k)
    texts.push_back("2024-05-03 12:00:" + std::string(k < 10 ? "0" : "") + std::to_string(k));
  EXPECT_EQ(column(texts).seconds[1], 0);
}

}  // namespace
}  // namespace muster::diagnosis
