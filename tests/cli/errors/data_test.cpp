// FAULT 25: measured data that are wrong, each named with its row; and data that cannot tell, of which no number is
// made.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "program.hpp"
#include "tests/sanitized.hpp"

using namespace muster::test;
using testing::HasSubstr;

namespace {

const char* const world =
    R"(<world name="w" dt="1" until="1">
<material name="drywall" loss="2"/>
<wall name="south" from="-1 -4" to="21 -4" material="drywall"/>
<wall name="north" from="-1 4" to="21 4" material="drywall"/>
<wall name="inner" from="10 -2" to="10 2" material="drywall"/>
<station name="base" at="0 0 1"/>
<station name="rover" at="5 0 1"/>
<radio.multiwall tx_power="0" l0="30" n="2.5"/>
</world>)";

// Readings along a zigzag, as rows of texts; row 0 is the header.
class Data {
 public:
  Data() {
    for (int i = 0; i < 60; ++i) {
      const double x = 1 + i * 0.3, y = i % 7 - 3;
      const double rssi = -40 - 20 * std::log10(std::hypot(x, y)) - ((x > 10 && std::abs(y) * 10 / x < 2) ? 4 : 0) +
                          (i * 7 % 5 - 2) * 0.4;
      rows_.push_back({std::to_string(i), "base", "rover", "0", "0", fmt::format("{:.1f}", x), fmt::format("{:.1f}", y),
                       fmt::format("{:.1f}", rssi)});
    }
  }
  // Rows count from 1; 0 is the header.
  Data& set(std::size_t row, std::size_t column, const std::string& value) { return rows_[row][column] = value, *this; }
  Data& set_all(std::size_t column, const std::string& value) {
    for (std::size_t r = 1; r < rows_.size(); ++r) rows_[r][column] = value;
    return *this;
  }
  Data& copy_row(std::size_t from, std::size_t to) { return rows_[to] = rows_[from], *this; }
  Data& keep(std::size_t rows) { return rows_.resize(rows + 1), *this; }
  std::string text(const std::string& end = "\n", const std::string& comma = ",") const {
    std::string result;
    for (const auto& row : rows_) {
      for (std::size_t c = 0; c < row.size(); ++c) result += (c ? comma : "") + row[c];
      result += end;
    }
    return result;
  }

 private:
  std::vector<std::vector<std::string>> rows_ = {
      {"t[s]", "tx", "rx", "tx_x[m]", "tx_y[m]", "rx_x[m]", "rx_y[m]", "rssi[dBm]"}};
};

Outcome asked(const std::string& verb, const std::string& data) {
  const ProgramFolder folder;
  folder.write("world.xml", world);
  folder.write("data.csv", data);
  return folder.muster({verb, "world.xml", "--data", "data.csv"});
}

Outcome fit(const std::string& data) { return asked("fit", data); }

void expect_refused(const std::string& data, const std::string& message) {
  for (const char* verb : {"fit", "diagnose"}) expect_error(asked(verb, data), 2, "data.csv" + message);
}

TEST(Fault25, ColumnsThatAreMissingOrInAnotherUnit) {
  expect_refused(Data().set(0, 7, "level[dBm]").text(),
                 ":1:1: no column \"rssi[dBm]\" in the table, which has t, tx, rx, tx_x, tx_y, rx_x, rx_y, level"
                 "; muster import FILE --map MAP --out FILE makes such a table of this one");
  expect_refused(Data().set(0, 5, "rx_x[mm]").text(),
                 ":1:28: column \"rx_x[mm]\" has the wrong unit; expected \"rx_x[m]\": 1 mm is 0.001 m");
}

TEST(Fault25, RowsThatRepeatAndTimeThatRunsBackwards) {
  expect_refused(Data().copy_row(3, 4).text(),
                 ":5:1: row 4: base -> rover at t = 2 s repeats row 3; expected each (t, tx, rx) once");
  expect_refused(Data().set(5, 0, "1.5").text(),
                 ":6:1: row 5: time runs backwards for base -> rover at t = 1.5 s, after 3 s in row 4; expected rows "
                 "of a pair in the order of time");
}

TEST(Fault25, LevelsThatNoReceiverGives) {
  expect_refused(Data().set(6, 7, "31").text(),
                 ":7:26: row 6: an rssi of 31 dBm is over +30 dBm; expected a level in dBm, which is mostly negative");
  expect_refused(Data().set(6, 7, "nan").text(),
                 ":7:26: column \"rssi[dBm]\": \"nan\" is not a number; expected an empty cell where there is no value "
                 "(muster import makes it so)");
}

TEST(Fault25, NumbersOfAnotherCountry) {
  expect_refused(Data().set(6, 7, "\"-56,0\"").text(),
                 ":7:26: column \"rssi[dBm]\": \"-56,0\" is not a number; a decimal point is written '.'");
  expect_refused(Data().set(6, 7, "-56,0").text(),
                 ":7:1: the row has 9 or more cells; expected 8, with ',' between them and '.' in numbers");
  expect_refused(
      Data().text("\n", ";"),
      ":1:1: cells stand between ';'; expected ',' between cells and '.' in numbers: sed 's/;/,/g' FILE makes them so "
      "(readings: muster import FILE --map MAP --out FILE)");
}

TEST(Fault25, PlacesInAnotherUnitOrOrder) {
  expect_refused(Data().set(8, 5, "3100").text(),
                 ":9:18: row 8: 3100 m, while half of the rows lie within 10.3 m; expected one unit in the whole "
                 "column (millimetres here?)");
  expect_refused(Data().set(0, 5, "rx_y[m]").set(0, 6, "rx_x[m]").text(),
                 ":2:1: row 1 and others lie outside of the world's walls, and inside if x and y change places; "
                 "expected x to the east and y to the "
                 "north, as in the world");
}

TEST(Fault25, ATableInMillimetres) {
  Data data;
  for (std::size_t row = 1; row <= 60; ++row) data.set(row, 5, std::to_string(1000 + 300 * row));
  expect_refused(
      data.text(),
      ":2:1: row 1 and others lie far outside of the world's walls, and inside if their places are millimetres; "
      "expected metres (a map of muster import: rx_x[m] = 0.001*COLUMN)");
}

// Told of the data, not of the world.
TEST(Fault25, PlacesBeyondTheScene) {
  Data data;
  for (std::size_t row = 1; row <= 60; ++row) data.set(row, 5, std::to_string(100000 + 300 * row));
  expect_refused(data.text(),
                 ":2:18: row 1: 100300 m lies beyond the world's scene; expected metres within 100000 m (is it another "
                 "unit, such as millimetres?)");
}

// A vehicle that leaves the plan: 18 km in a minute would be too fast, in an hour they are not.
TEST(Fault25, PlacesKilometresFromTheWallsAreTaken) {
  Data data;
  for (int i = 1; i <= 60; ++i) {
    const auto row = static_cast<std::size_t>(i);
    data.set(row, 0, std::to_string(60 * i)).set(row, 5, std::to_string(300 * i));
    data.set(row, 7, fmt::format("{:.1f}", -30 - 25 * std::log10(300.0 * i) + (i * 7 % 5) * 0.4));
  }
  EXPECT_EQ(fit(data.text()).err, "");
}

TEST(Fault25, MarksForNothingAreTold) {
  EXPECT_THAT(
      fit(Data().set(6, 7, "-128").text()).out,
      HasSubstr("1 at -128 dBm, first in row 6: taken as a mark for nothing received; the nearest other level is"));
}

// Formerly "time runs backwards" at the row after it, and gigabytes of memory where it was the last.
TEST(Fault25, AWildStampIsLeftOutOfTime) {
  for (const std::size_t row : {std::size_t{1}, std::size_t{30}, std::size_t{60}}) {
    const std::string data = Data().set(row, 0, "4e9").text();
    for (const char* verb : {"fit", "diagnose"}) {
      const Outcome found = asked(verb, data);
      EXPECT_EQ(found.exit, 0) << found.err;
      EXPECT_THAT(found.out,
                  HasSubstr("row " + std::to_string(row) + ": t = 4e+09 s lies far outside all other times"));
      EXPECT_TRUE(sanitized || found.peak_kilobytes < 400'000) << found.peak_kilobytes;
    }
  }
}

// The second half of the readings a year after the first.
TEST(Fault25, SessionsAYearApartFitIntoMemory) {
  Data data;
  for (int i = 1; i <= 60; ++i) data.set(static_cast<std::size_t>(i), 0, std::to_string(i < 31 ? i : 31'536'000 + i));
  for (const char* verb : {"fit", "diagnose"}) {
    const Outcome found = asked(verb, data.text());
    EXPECT_EQ(found.exit, 0) << found.err;
    EXPECT_TRUE(sanitized || found.peak_kilobytes < 400'000) << found.peak_kilobytes;
  }
}

TEST(Fault25, Milliwatts) {
  Data data;
  for (std::size_t row = 1; row <= 60; ++row) data.set(row, 7, fmt::format("{}e-6", row));
  expect_refused(
      data.text(),
      ":2:27: row 1: 1e-06 dBm, and most readings are above 0 dBm, as milliwatts or levels without their sign "
      "are; expected dBm, 10 log10 of milliwatts (a map of muster import: rssi[dBm] = 10*log10(COLUMN), or "
      "rssi[dBm] = -1*COLUMN)");
}

TEST(Fault25, ARadioThatTheWorldDoesNotHave) {
  const std::string note =
      ":2:3: radios of the data that the world does not have: \"bse\"; radios of the world without a reading: "
      "\"base\"; is \"bse\" as \"base\" meant?";
  const std::string end = " (as they are, a cause that is found about one adds it to the extended world)";
  EXPECT_THAT(fit(Data().set_all(1, "bse").text()).out, HasSubstr(note + end));
  EXPECT_THAT(fit(Data().set_all(1, "/base").text()).out,
              HasSubstr("is \"/base\" as \"base\" meant? names have no slash (a map of muster import names "
                        "them anew)" +
                        end));
  EXPECT_THAT(fit(Data().text()).out, testing::Not(HasSubstr("does not have")));
}

TEST(Fault25, AStationThatMovesIsSaidToMove) {
  EXPECT_THAT(fit(Data().text()).out,
              HasSubstr("\"rover\" moves in the data and stands at x = 5, y = 0 m in the world; the data's places "
                        "are used"));
}

TEST(Fault25, CellsThatAreAllTooSmallAreNoStatistic) {
  const std::string out = fit(Data().text()).out;
  EXPECT_THAT(out, HasSubstr("Means over cells of 0.25 m: none. Each of the 60 cells has fewer than 5 readings; larger "
                             "cells (--cell) or fewer readings (--least) would give some."));
  EXPECT_THAT(out, testing::Not(HasSubstr("cannot show")));
}

TEST(Fault25, PlacesOnTheGlobe) {
  const std::string globe =
      " is a place on the globe; expected metres in the world's plan: x = 111320 m * cos(lat0) * (lon - lon0) and y = "
      "111320 m * (lat - lat0), in degrees, where (lat0, lon0) is the world's origin, as tx_x[m], tx_y[m], rx_x[m], "
      "rx_y[m]";
  expect_refused(Data().set(0, 5, "rx_lat[deg]").set(0, 6, "rx_lon[deg]").text(),
                 ":1:28: column \"rx_lat[deg]\"" + globe);
  expect_refused(Data().set(0, 3, "Longitude").set(0, 4, "Latitude").text(), ":1:12: column \"Longitude\"" + globe);
  EXPECT_EQ(fit(Data().set(0, 0, "lat").text()).exit, 0);  // beside places it is a covariate like any other
}

TEST(Fault25, TooLittleToTellAnything) {
  expect_refused(Data().keep(0).text(), ": the table has no rows; expected readings");
  expect_refused(Data().keep(1).text(), ": the table has 1 row; one reading shows no law, expected many");
  expect_refused(Data().set_all(7, "-60").text(), ":2:27: every rssi is -60 dBm; expected readings that vary");
  expect_error(asked("diagnose", Data().keep(19).text()), 2,
               "data.csv: the table has 19 readings to search; expected at least 50");
  expect_refused(Data().set_all(7, "").text(), ": every rssi is empty; expected some readings that were received");
}

// What would fill the memory of most machines is told at once.
TEST(Fault25, MoreRowsThanAFitCanHold) {
  std::string data = "tx,rx,distance[m],rssi[dBm]\n";
  for (int row = 0; row < 2'000'001; ++row) data += "a,b,3,-50\n";
  const ProgramFolder folder;
  folder.write("world.xml", world);
  folder.write("data.csv", data);
  for (const char* verb : {"fit", "diagnose", "features"}) {
    const auto outcome = folder.muster({verb, "world.xml", "--data", "data.csv"});
    expect_error(outcome, 2,
                 "data.csv: the table has 2000001 rows; expected at most 2000000: keep one row in 2, or a part of the "
                 "time");
    EXPECT_TRUE(sanitized || outcome.peak_kilobytes < 300'000) << outcome.peak_kilobytes;
  }
}

TEST(Fault25, WhatIsNotIdentifiableHasNoNumber) {
  const auto outcome = fit(Data().set_all(5, "3").set_all(6, "0").text());
  EXPECT_EQ(outcome.exit, 1) << outcome.err;
  for (const char* parameter : {"radio.multiwall/l0", "radio.multiwall/n", "material/drywall/loss"})
    EXPECT_THAT(outcome.out, testing::ContainsRegex(std::string(parameter) + " +not identifiable"));
  EXPECT_THAT(outcome.out, HasSubstr("no reading depends on material/drywall/loss"));
}

Data at_one_place() {
  Data data = Data().set_all(5, "3").set_all(6, "0");
  std::minstd_rand draw(3);
  for (std::size_t row = 1; row <= 60; ++row)
    data.set(row, 7, fmt::format("{:.1f}", -60 + 0.01 * static_cast<double>(draw() % 500)));
  return data;
}

// Distance and walls are the same in all rows: nothing is named, and what has no value says so.
TEST(Fault25, ADiagnosisNamesNothingThatItCannotTell) {
  const auto outcome = asked("diagnose", at_one_place().text());
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("world.xml is adequate"));
  EXPECT_THAT(outcome.out, HasSubstr("note: not identifiable: no reading depends on material/drywall/loss"));
  EXPECT_THAT(outcome.out,
              HasSubstr("note: not identifiable: changing radio.multiwall/l0 by 1 dB together with radio.multiwall/n"));
  EXPECT_THAT(outcome.out, testing::ContainsRegex("radio.multiwall/(l0|n) +not identifiable"));
  EXPECT_THAT(outcome.out, testing::Not(testing::ContainsRegex("radio.multiwall/(l0|n).* \\+- ")));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("evidence")));
}

// Levels that rise with distance are no path loss: the exponent ends at 0. A wall that would win level ends at 0 dB as
// well, and may: it is what the map has, not the channel's law.
TEST(Fault25, ALawThatEndsAtItsBoundLeavesNoNameSure) {
  const auto with = [](double slope, double wall) {
    Data data;
    for (int i = 0; i < 60; ++i) {
      const double x = 1 + i * 0.3, y = i % 7 - 3;
      const bool behind = x > 10 && std::abs(y) * 10 / x < 2;
      data.set(static_cast<std::size_t>(i) + 1, 7,
               fmt::format("{:.1f}",
                           -50 + slope * std::log10(std::hypot(x, y)) + (behind ? wall : 0) + (i * 7 % 5 - 2) * 0.4));
    }
    return asked("diagnose", data.text());
  };
  const std::string note = "no name is sure";
  EXPECT_THAT(with(10, -4).out, testing::AllOf(HasSubstr("note: at its bound: radio.multiwall/n"), HasSubstr(note)));
  const auto fine = with(-20, 4);
  EXPECT_THAT(fine.out, testing::ContainsRegex("material/drywall/loss .*at its bound"));
  EXPECT_THAT(fine.out, testing::Not(HasSubstr(note)));
}

TEST(Fault25, OtherReadingsOfTheSameAreNotPassedOver) {
  const ProgramFolder folder;
  folder.write("world.xml", world);
  folder.write("data.csv", at_one_place().text());
  const std::vector<std::string> words = {"diagnose", "world.xml", "--data",   "data.csv",
                                          "--out",    "out",       "--second", "second.csv"};
  expect_error(folder.muster(words), 2, "second.csv: no such file");
  folder.write("second.csv", at_one_place().text());
  const auto outcome = folder.muster(words);
  EXPECT_EQ(outcome.exit, 0);
  EXPECT_EQ(outcome.err,
            "muster: note: nothing is held against --second: no cause is named, so no world is extended\n");
}

TEST(Fault25, DistancesAndPathLosses) {
  const auto without_places = [](const std::string& row) {
    return "tx,rx,distance[m],path_loss[dB]\nbase,rover,3,60\n" + row + "\nbase,rover,9,71\n";
  };
  expect_refused(without_places("base,rover,0,70"), ":3:12: row 2: a distance of 0 m; expected more than 0 m");
  expect_refused(without_places("base,rover,4,-60"),
                 ":3:14: row 2: a path loss of -60 dB, a level of 60 dBm, is over +30 dBm; expected a level in dBm, "
                 "which is mostly negative");
  expect_refused("tx,rx,path_loss[dB]\nbase,rover,60\nbase,rover,61\n",
                 ":1:1: no columns \"tx_x[m]\", \"tx_y[m]\", \"rx_x[m]\", \"rx_y[m]\" in the table, which has tx, rx, "
                 "path_loss; expected tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],path_loss[dB]; muster import FILE --map "
                 "MAP --out FILE makes such a table of this one");
}

TEST(Fault25, WhatIsNoFaultIsTaken) {
  const auto plain = fit(Data().text());
  EXPECT_EQ(plain.exit, 0) << plain.err;
  EXPECT_THAT(plain.out, HasSubstr("60 readings heard of 60"));
  EXPECT_EQ(fit(Data().text("\r\n")).out, plain.out);
  EXPECT_EQ(fit("\xef\xbb\xbf" + Data().text()).out, plain.out);
  EXPECT_THAT(fit(Data().set(0, 0, "battery[V]").set_all(0, "3.7").text()).out,
              HasSubstr("note: column \"battery[V]\" is the same in all rows, so nothing can depend on it"));
}

}  // namespace
