// Columns that nothing depends on: other measures of reception, and counters.
#include "diagnosis/data/column_doubts.hpp"

#include <gmock/gmock.h>

#include <numeric>
#include <random>

#include "diagnosis/pipeline/link_observations.hpp"
#include "tests/folder.hpp"

namespace muster::diagnosis {
namespace {

struct Log {
  std::vector<double> t, values;
  std::vector<std::size_t> stream;
  void add(std::size_t who, double time, double value) {
    stream.push_back(who);
    t.push_back(time);
    values.push_back(value);
  }
  bool goes_with_time(const std::string& name = "packet") const {
    return diagnosis::goes_with_time(name, values, t, stream);
  }
};

TEST(ColumnDoubts, CountersGoWithTime) {
  std::mt19937 random(1);
  Log packets;  // of two senders, a tenth of them lost, one begins anew
  for (std::size_t who = 0; who < 2; ++who) {
    double number = who == 0 ? 0 : 4000;
    for (int i = 0; i < 200; ++i, ++number) {
      if (who == 1 && i == 120) number = 0;
      if (random() % 10) packets.add(who, 3.0 * i + 0.2 * static_cast<double>(random() % 10), number);
    }
  }
  EXPECT_TRUE(packets.goes_with_time());
  packets.values[17] = 3e6;  // garbled
  EXPECT_TRUE(packets.goes_with_time());
  Log uptime;
  for (int i = 0; i < 50; ++i) uptime.add(0, i * i, 1000.0 * i * i + 7);
  EXPECT_TRUE(uptime.goes_with_time("uptime[ms]"));
}

TEST(ColumnDoubts, WhatOnlyTendsWithTimeIsNoClock) {
  std::mt19937 random(2);
  std::normal_distribution<> noise;
  Log battery, warmth, place, standing, runs;
  for (int i = 0; i < 300; ++i) {
    battery.add(0, i, 100 - std::floor(i / 3.0));
    warmth.add(0, i, 20 + 0.05 * i + 0.3 * noise(random));
    place.add(0, i, static_cast<double>(random() % 300));
    standing.add(0, i, 3);
    runs.add(0, i, std::floor(i / 30.0));
  }
  EXPECT_FALSE(battery.goes_with_time());
  EXPECT_FALSE(warmth.goes_with_time());
  EXPECT_FALSE(place.goes_with_time());
  EXPECT_FALSE(standing.goes_with_time());
  EXPECT_FALSE(runs.goes_with_time());
  Log turntable;
  for (int i = 0; i < 300; ++i) turntable.add(0, 2.0 * i, i);
  EXPECT_FALSE(turntable.goes_with_time("angle[deg]"));
  EXPECT_TRUE(turntable.goes_with_time("row_number"));
  warmth.values = turntable.values;
  EXPECT_TRUE(warmth.goes_with_time("uptime"));
  for (double& value : warmth.values) value += 10 * noise(random);
  EXPECT_FALSE(warmth.goes_with_time("uptime"));
  Log few;
  for (int i = 0; i < 10; ++i) few.add(0, i, i);
  EXPECT_FALSE(few.goes_with_time());
}

TEST(ColumnDoubts, OtherMeasuresOfReceptionAreKnownByName) {
  for (const char* name : {"snr", "SNR[dB]", "lora_snr", "rx-LQI", "rsrq[dB]", "RSRP"})
    EXPECT_TRUE(measures_reception(name)) << name;
  for (const char* name : {"noise", "battery[V]", "temperature", "channel", "snrub", "antenna"})
    EXPECT_FALSE(measures_reception(name)) << name;
}

// Each number stands there three times, by sender alone it would stay too often to count.
TEST(ColumnDoubts, APacketThatThreeGatewaysHearCountsOnce) {
  const test::Folder folder;
  std::string text = "t[s],tx,rx,distance[m],rssi[dBm],packet,SNR[dB]\n";
  for (int i = 0; i < 60; ++i)
    for (const char* gateway : {"g1", "g2", "g3"})
      text += std::to_string(10 * i) + ",node," + gateway + ",100," + std::to_string(-90 - i % 7) + ',' +
              std::to_string(i) + ',' + (i == 3 && *(gateway + 1) == '1' ? "-2" : "5") + '\n';
  const Dataset data = read_dataset(folder.write("log.csv", text));
  ASSERT_EQ(data.covariates.size(), 2u);
  EXPECT_EQ(data.covariates[0].no_cause, "it counts on as time does, and what depends on time is sought there");
  EXPECT_THAT(data.notes, testing::Contains("of 180 readings 1 has a \"SNR[dB]\" below 0: such levels are noise more "
                                            "than signal, and look too high"));
}

TEST(ColumnDoubts, AreSaidAndNotTested) {
  const test::Folder folder;
  std::string text = "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm],snr[dB],packet,height\n";
  for (int i = 0; i < 40; ++i)
    text += std::to_string(i) + ",a,b,0,0," + std::to_string(i + 1) + ",0," + std::to_string(-50 - i) + ',' +
            std::to_string(30 - i) + ',' + std::to_string(100 + i) + ',' + std::to_string((i * 7) % 40) + '\n';
  const Dataset data = read_dataset(folder.write("log.csv", text));
  std::vector<Eigen::Index> all(40);
  std::iota(all.begin(), all.end(), 0);
  const ObservedColumns observed = observed_columns(data, all);
  ASSERT_EQ(observed.columns.covariates.size(), 1u);
  EXPECT_EQ(observed.columns.covariates[0].name, "height");
  EXPECT_THAT(observed.untested,
              testing::ElementsAre("snr: it measures what was received, as the level does, which therefore does not "
                                   "depend on it",
                                   "packet: it counts on as time does, and what depends on time is sought there"));
  EXPECT_THAT(data.notes, testing::Contains("of 40 readings 9 have a \"snr[dB]\" below 0: such levels are noise "
                                            "more than signal, and look too high"));
}

}  // namespace
}  // namespace muster::diagnosis
