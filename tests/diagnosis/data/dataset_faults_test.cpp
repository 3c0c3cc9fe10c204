// Fault class 25: impossible measured data, each reported with its row, word for word.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/data/dataset.hpp"
#include "tests/diagnosis/scratch.hpp"
#include "text/error.hpp"

namespace muster::diagnosis {
namespace {

const std::string header = "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";

std::string reading(const std::string& text) {
  const Scratch scratch;
  const auto file = scratch.write("d.csv", text);
  return complaint([&] { read_dataset(file); });
}

TEST(DatasetFaults, RepeatedReading) {
  EXPECT_EQ(reading(header + "0,a,b,0,0,1,0,-50\n0,a,c,0,0,2,0,-51\n0,a,b,0,0,1,0,-52\n1,a,b,0,0,1,0,-52\n"),
            "d.csv:4:1: row 3: a -> b at t = 0 s repeats row 1; expected each (t, tx, rx) once");
}

// Two readings within one tick of a coarse clock.
TEST(DatasetFaults, ARepeatedTimeIsNoneWhereARadioHasMoved) {
  EXPECT_EQ(reading(header + "0,a,b,0,0,1,0,-50\n0,a,b,0,0,1.1,0,-52\n1,a,b,0,0,1.2,0,-52\n"), "");
}

TEST(DatasetFaults, TimeRunsBackwardsWithinAPair) {
  EXPECT_EQ(
      reading(header + "5,a,b,0,0,1,0,-50\n1,a,c,0,0,2,0,-51\n4,a,b,0,0,1,0,-52\n"),
      "d.csv:4:1: row 3: time runs backwards for a -> b at t = 4 s, after 5 s in row 1; expected rows of a pair in the "
      "order of time: are these two runs in one table? expected a "
      "table each, or the times of the second later: 4 s as more than 5 s");
}

TEST(DatasetFaults, LevelsThatNoReceiverGives) {
  EXPECT_EQ(reading(header + "0,a,b,0,0,1,0,-50\n1,a,b,0,0,2,0,31\n"),
            "d.csv:3:15: row 2: an rssi of 31 dBm is over +30 dBm; expected a level in dBm, which is mostly negative");
  EXPECT_EQ(reading(header + "0,a,b,0,0,1,0,-50\n1,a,b,0,0,2,0,-500\n"),
            "d.csv:3:15: row 2: an rssi of -500 dBm is below thermal noise; expected a level in dBm; is -500 a "
            "mark for nothing received? then leave the cell empty (in a map of muster import: none rssi = -500)");
  EXPECT_EQ(
      reading(header + "0,a,b,0,0,1,0,-999\n1,a,b,0,0,2,0,-51\n2,a,b,0,0,3,0,-999\n"),
      "d.csv:2:15: row 1: an rssi of -999 dBm is below thermal noise; expected a level in dBm; 2 rows have it: is "
      "-999 a mark for nothing received? then leave these cells empty (in a map of muster import: none rssi = "
      "-999)");
}

// Three at most, and 30 dB apart.
TEST(DatasetFaults, FewLevelsFarAboveAllOthersAreTold) {
  const auto notes = [](int count, const std::string& levels) {
    const Scratch scratch;
    std::string rows;
    for (int i = 0; i < count; ++i)
      rows +=
          std::to_string(i) + ",a,b,0,0," + std::to_string(1 + 0.01 * i) + ",0," + std::to_string(-70 + i % 30) + "\n";
    return read_dataset(scratch.write("d.csv", header + rows + levels)).notes;
  };
  const std::string one = "1000,a,b,0,0,3,0,25.3\n", near = "1000,a,b,0,0,3,0,-20\n";
  ASSERT_EQ(notes(200, one).size(), 1u);
  EXPECT_THAT(notes(200, one)[0],
              testing::HasSubstr("d.csv:202:18: 25.3 dBm lies 66 dB above all other levels; is a minus "
                                 "missing? Where it is no reading, leave the cell empty"));
  EXPECT_THAT(notes(200, "1000,a,b,0,0,3,0,-5\n").at(0),
              testing::HasSubstr("-5 dBm lies 36 dB above all other levels; is a digit"));
  EXPECT_THAT(notes(200, one + "1001,a,b,0,0,3,0,26\n").at(0), testing::HasSubstr("25.3 dBm, as 1 more, lies"));
  EXPECT_TRUE(notes(200, near).empty());
  EXPECT_TRUE(notes(50, one).empty());
  EXPECT_TRUE(notes(900, one + "1001,a,b,0,0,3,0,26\n1002,a,b,0,0,3,0,26\n1003,a,b,0,0,3,0,26\n").empty());
}

TEST(DatasetFaults, ALogThatIsJoinedToItselfOrHasOneTime) {
  const std::string log = "0,a,b,0,0,1,0,-50\n1,a,b,0,0,2,0,-51\n2,a,b,0,0,3,0,-52\n";
  EXPECT_EQ(reading(header + log + log),
            "d.csv:5:1: rows 4 to 6 repeat rows 1 and following: the log is joined to itself; expected it once");
  EXPECT_EQ(reading(header + "7,a,b,0,0,1,0,-50\n7,a,b,0,0,2,0,-51\n"),
            "d.csv:2:1: t is 7 s in all rows; expected the time of each reading, or no column t[s]");
}

TEST(DatasetFaults, AMarkOfManyRowsAndOtherScales) {
  EXPECT_EQ(
      reading(header + "0,a,b,0,0,1,0,-50\n1,a,b,0,0,2,0,127\n2,a,b,0,0,3,0,-52\n3,a,b,0,0,4,0,127\n"),
      "d.csv:3:15: row 2: an rssi of 127 dBm is over +30 dBm; expected a level in dBm, which is mostly negative; 2 "
      "rows have it: is 127 a mark for nothing received? then leave these cells empty (in a map of muster import: "
      "none rssi = 127)");
  const auto ends_with = [](const std::string& rows, const std::string& end) {
    const std::string said = reading(header + rows);
    EXPECT_TRUE(said.ends_with(end)) << said;
  };
  ends_with("0,a,b,0,0,1,0,218\n1,a,b,0,0,2,0,190\n",
            "; whole numbers from 128 to 255 are an unsigned byte: rssi[dBm] = 1*COLUMN - 256");
  ends_with("0,a,b,0,0,1,0,81\n1,a,b,0,0,2,0,64\n",
            "; a quality in per cent is no level: where it is Windows', rssi[dBm] = 0.5*COLUMN - 100 is about it");
}

TEST(DatasetFaults, DistancesThatTellNothing) {
  const auto note_of_distances = [](const std::string& rows) {
    const Scratch scratch;
    const Dataset data = read_dataset(scratch.write("d.csv", "t[s],tx,rx,distance[m],path_loss[dB]\n" + rows));
    const auto found = std::find_if(data.notes.begin(), data.notes.end(),
                                    [](const std::string& note) { return note.starts_with("column \"distance[m]\""); });
    return found == data.notes.end() ? "" : *found;
  };
  EXPECT_EQ(
      note_of_distances("0,a,b,0.013,50\n1,a,b,0.013,51\n"),
      "column \"distance[m]\" is 0.013 m in all rows, so that the exponent n cannot be told from the loss l0; are "
      "these kilometres? expected metres");
  EXPECT_EQ(note_of_distances("0,a,b,0.01,50\n1,a,b,0.02,51\n"),
            "column \"distance[m]\" goes from 0.01 to 0.02 m; are these kilometres? expected metres");
  EXPECT_EQ(note_of_distances("0,a,b,10,50\n1,a,b,20,51\n"), "");
}

Dataset with_levels(const std::vector<std::string>& levels) {
  const Scratch scratch;
  std::string text = header;
  for (std::size_t row = 0; row < levels.size(); ++row)
    text += std::to_string(row) + ".5" + ",a,b,0,0," + std::to_string(row % 7) + ",0," + levels[row] + "\n";
  return read_dataset(scratch.write("d.csv", text));
}

TEST(DatasetFaults, AMarkForNothingStandsApartFromAllLevels) {
  const Dataset data = with_levels({"-50", "-128", "-61.5", "0", "-128"});
  EXPECT_EQ(data.heard(), 2u);
  EXPECT_EQ(data.notes,
            (std::vector<std::string>{"1 at 0 dBm, first in row 4: taken as a mark for nothing received; the "
                                      "nearest other level is 50 dB away",
                                      "2 at -128 dBm, first in row 2: taken as a mark for nothing received; "
                                      "the nearest other level is 66.5 dB away"}));
}

TEST(DatasetFaults, ALevelAmongOthersIsNoMark) {
  const Dataset weak = with_levels({"-119", "-128", "-121", "-127", "-131", "-128"});
  EXPECT_EQ(weak.heard(), 6u);
  EXPECT_TRUE(weak.notes.empty());
  const Dataset strong = with_levels({"-12", "0", "-9.5", "-3"});
  EXPECT_EQ(strong.heard(), 4u);
  EXPECT_TRUE(strong.notes.empty());
}

// The least of a byte but one is a mark only where it comes again: one alone may be a fade.
TEST(DatasetFaults, ALevelOf127IsAMarkWhereItComesAgain) {
  EXPECT_THAT(
      with_levels({"-50", "-127", "-61.5", "-127"}).notes,
      testing::Contains(testing::HasSubstr("2 at -127 dBm, first in row 2: taken as a mark for nothing received")));
  EXPECT_THAT(with_levels({"-50", "-127", "-61.5", "-70"}).notes,
              testing::Not(testing::Contains(testing::HasSubstr("a mark for nothing received"))));
}

// 128 dB is an ordinary loss.
TEST(DatasetFaults, APathLossOf128IsNoMark) {
  const Scratch scratch;
  const Dataset data =
      read_dataset(scratch.write("d.csv", "tx,rx,distance[m],path_loss[dB]\na,b,10,80\na,b,20,90\na,b,900,128\n"));
  EXPECT_EQ(data.heard(), 3u);
}

TEST(DatasetFaults, MilliwattsAndLostSigns) {
  EXPECT_EQ(
      reading(header + "0,a,b,0,0,1,0,0\n1,a,b,0,0,2,0,0.00001\n2,a,b,0,0,3,0,2e-7\n"),
      "d.csv:3:15: row 2: 1e-05 dBm, and most readings are above 0 dBm, as milliwatts or levels without their sign "
      "are; expected dBm, 10 log10 of milliwatts (a map of muster import: rssi[dBm] = 10*log10(COLUMN), or rssi[dBm] "
      "= -1*COLUMN)");
  EXPECT_EQ(reading(header + "0,a,b,0,0,1,0,67\n1,a,b,0,0,2,0,70\n").substr(0, 46),
            "d.csv:2:15: row 1: 67 dBm, and most readings a");
  EXPECT_EQ(
      reading("tx,rx,distance[m],path_loss[dB]\na,b,10,-80\na,b,20,-90\n"),
      "d.csv:2:8: row 1: a path loss of -80 dB, and most are negative; expected losses, which are positive (a map "
      "of muster import: path_loss[dB] = -1*COLUMN)");
}

TEST(DatasetFaults, TooLittle) {
  EXPECT_EQ(reading(header), "d.csv: the table has no rows; expected readings");
  EXPECT_EQ(reading(header + "0,a,b,0,0,1,0,-50\n"),
            "d.csv: the table has 1 row; one reading shows no law, expected many");
  EXPECT_EQ(reading(header + "0,a,b,0,0,1,0,\n1,a,b,0,0,1,0,\n"),
            "d.csv: every rssi is empty; expected some readings that were received");
  EXPECT_EQ(reading(header + "0,a,b,0,0,1,0,0\n1,a,b,0,0,1,0,\n"),
            "d.csv: every rssi is empty or a mark for nothing received (1 at 0 dBm); expected some readings that were "
            "received");
}

TEST(DatasetFaults, ConstantColumns) {
  EXPECT_EQ(reading(header + "0,a,b,0,0,1,0,-50\n1,a,b,0,0,2,0,-50\n"),
            "d.csv:2:15: every rssi is -50 dBm; expected readings that vary");
  const Scratch scratch;
  const auto file = scratch.write("d.csv",
                                  "tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm],battery[V],phone\n"
                                  "a,b,0,0,1,0,-50,3.7,x\na,b,0,0,2,0,-51,3.7,y\n");
  const Dataset data = read_dataset(file);
  ASSERT_EQ(data.notes.size(), 1u);
  EXPECT_EQ(data.notes[0], "column \"battery[V]\" is the same in all rows, so nothing can depend on it");
  ASSERT_EQ(data.covariates.size(), 1u);
  EXPECT_EQ(data.covariates[0].name, "phone");
}

TEST(DatasetFaults, MissingColumnAndWrongUnit) {
  EXPECT_EQ(reading("t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rssi[dBm]\n0,a,b,0,0,1,-50\n"),
            "d.csv:1:1: no column \"rx_y[m]\" in the table, which has t, tx, rx, tx_x, tx_y, rx_x, rssi; did you "
            "mean \"tx_y\"?; muster import FILE --map MAP --out FILE makes such a table of this one");
  EXPECT_EQ(reading("time,x,y,rssi\n0,1,2,-50\n"),
            "d.csv:1:1: no columns \"tx\", \"rx\", \"tx_x[m]\", \"tx_y[m]\", \"rx_x[m]\", \"rx_y[m]\" in the table, "
            "which has time, x, y, rssi; expected tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]; muster import FILE "
            "--map MAP --out FILE makes such a table of this one");
  EXPECT_EQ(reading("tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[mW]\na,b,0,0,1,0,50\n"),
            "d.csv:1:39: column \"rssi[mW]\" has the wrong unit; expected \"rssi[dBm]\": 10 log10 of the milliwatts");
}

TEST(DatasetFaults, MixedUnits) {
  std::string rows;
  for (int i = 0; i < 9; ++i)
    rows += std::to_string(i) + ",a,b,0,0," + std::to_string(i) + ",1,-" + std::to_string(50 + i) + "\n";
  EXPECT_EQ(reading(header + rows + "9,a,b,0,0,4222,1,-50\n"),
            "d.csv:11:11: row 10: 4222 m, while half of the rows lie within 5 m; expected one unit in the whole column "
            "(millimetres here?)");
}

// Two gateways 20 km apart, and a vehicle that parks for half of the time and then drives 9 km.
TEST(DatasetFaults, FarPlacesOfOneUnitAreTaken) {
  std::string rows;
  for (int i = 0; i < 40; ++i) {
    const std::string x = std::to_string(i < 20 ? i % 3 : 450 * (i - 19));
    rows += std::to_string(i) + "," + (i % 4 ? "near" : "far") + ",car," + (i % 4 ? "0" : "20000") + ",0," + x +
            ",1,-" + std::to_string(50 + i) + "\n";
  }
  EXPECT_EQ(reading(header + rows), "");
}

TEST(DatasetFaults, WhatIsNoNumber) {
  EXPECT_EQ(reading(header + "0,a,b,0,0,1,0,nan\n"),
            "d.csv:2:15: column \"rssi[dBm]\": \"nan\" is not a number; expected an empty cell where there is no value "
            "(muster import makes it so)");
  EXPECT_EQ(reading(header + "0,a,b,0,0,\"1,5\",0,-50\n"),
            "d.csv:2:11: column \"rx_x[m]\": \"1,5\" is not a number; a decimal point is written '.'");
  EXPECT_EQ(reading(header + "0,a,b,0,0,1,5,0,-50\n"),
            "d.csv:2:1: the row has 9 or more cells; expected 8, with ',' between them and '.' in numbers");
}

TEST(DatasetFaults, ARadioThatHearsItself) {
  EXPECT_EQ(reading(header + "0,a,b,0,0,1,0,-50\n1,a,a,0,0,1,0,-51\n"),
            "d.csv:3:5: row 2: \"a\" hears itself; expected two radios");
}

TEST(DatasetFaults, LinesThatEndAsWindowsEndsThem) {
  EXPECT_EQ(reading("tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\r\na,b,0,0,1,0,-50\r\na,b,0,0,2,0,-51\r\n"), "");
}

TEST(DatasetFaults, DegreesAreNoted) {
  std::string text = "tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rx_yaw[rad],rssi[dBm]\n";
  for (int i = 0; i < 12; ++i)
    text += "a,b,0,0,1," + std::to_string(i) + ',' + std::to_string(30 * i) + ",-" + std::to_string(50 + i) + "\n";
  const Scratch scratch;
  const Dataset data = read_dataset(scratch.write("d.csv", text));
  ASSERT_EQ(data.notes.size(), 1u);
  EXPECT_EQ(data.notes[0],
            "column \"rx_yaw[rad]\" goes from 0 to 330 rad: are these degrees? expected radians (a map of "
            "muster import: rx_yaw[rad] = 0.017453292519943295*COLUMN)");
}

}  // namespace
}  // namespace muster::diagnosis
