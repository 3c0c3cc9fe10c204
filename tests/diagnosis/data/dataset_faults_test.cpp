// Fault class 25: impossible measured data, each reported with its row, word for word.
#include <gtest/gtest.h>

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
  EXPECT_EQ(reading(header + "0,a,b,0,0,1,0,-50\n0,a,c,0,0,2,0,-51\n0,a,b,0,0,1,0,-52\n"),
            "d.csv:4:1: row 3: a -> b at t = 0 s repeats row 1; expected each (t, tx, rx) once");
}

TEST(DatasetFaults, TimeRunsBackwardsWithinAPair) {
  EXPECT_EQ(
      reading(header + "5,a,b,0,0,1,0,-50\n1,a,c,0,0,2,0,-51\n4,a,b,0,0,1,0,-52\n"),
      "d.csv:4:1: row 3: time runs backwards for a -> b at t = 4 s, after 5 s in row 1; expected rows of a pair in the "
      "order of time");
}

TEST(DatasetFaults, LevelsThatNoReceiverGives) {
  EXPECT_EQ(reading(header + "0,a,b,0,0,1,0,-50\n1,a,b,0,0,2,0,0\n"),
            "d.csv:3:15: row 2: an rssi of 0 dBm is what drivers give for none; expected an empty cell where nothing "
            "was received");
  EXPECT_EQ(reading(header + "0,a,b,0,0,1,0,-50\n1,a,b,0,0,2,0,31\n"),
            "d.csv:3:15: row 2: an rssi of 31 dBm is over +30 dBm; expected a level in dBm, which is mostly negative");
  EXPECT_EQ(
      reading(header + "0,a,b,0,0,1,0,-50\n1,a,b,0,0,2,0,-128\n"),
      "d.csv:3:15: row 2: an rssi of -128 dBm is a mark for none; expected an empty cell where nothing was received");
  EXPECT_EQ(reading(header + "0,a,b,0,0,1,0,-50\n1,a,b,0,0,2,0,-500\n"),
            "d.csv:3:15: row 2: an rssi of -500 dBm is below thermal noise; expected a level in dBm");
}

TEST(DatasetFaults, TooLittle) {
  EXPECT_EQ(reading(header), "d.csv: the table has no rows; expected readings");
  EXPECT_EQ(reading(header + "0,a,b,0,0,1,0,-50\n"),
            "d.csv: the table has 1 row; one reading shows no law, expected many");
  EXPECT_EQ(reading(header + "0,a,b,0,0,1,0,\n1,a,b,0,0,1,0,\n"),
            "d.csv: every rssi is empty; expected some readings that were received");
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
            "d.csv:1:1: no column \"rx_y[m]\" in the table; expected one of t, tx, rx, tx_x, tx_y, rx_x, rssi; did you "
            "mean \"tx_y\"?");
  EXPECT_EQ(reading("tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[mW]\na,b,0,0,1,0,50\n"),
            "d.csv:1:39: column \"rssi[mW]\" has the wrong unit; expected \"rssi[dBm]\"");
}

TEST(DatasetFaults, MixedUnits) {
  std::string rows;
  for (int i = 0; i < 9; ++i)
    rows += std::to_string(i) + ",a,b,0,0," + std::to_string(i) + ",1,-" + std::to_string(50 + i) + "\n";
  EXPECT_EQ(reading(header + rows + "9,a,b,0,0,4222,1,-50\n"),
            "d.csv:11:11: row 10: 4222 m, while half of the rows lie within 5 m; expected one unit in the whole column "
            "(millimetres here?)");
}

TEST(DatasetFaults, WhatIsNoNumber) {
  EXPECT_EQ(reading(header + "0,a,b,0,0,1,0,nan\n"),
            "d.csv:2:15: column \"rssi[dBm]\": \"nan\" is not a number; it must be finite");
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
  EXPECT_EQ(data.notes[0], "column \"rx_yaw[rad]\" goes from 0 to 330 rad: are these degrees?");
}

}  // namespace
}  // namespace muster::diagnosis
