// A log as one table has the run's own numbers, each under the names that it is about.
#include "run_log/wide_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "logged_run.hpp"
#include "text/error.hpp"
#include "text/text_table.hpp"

namespace muster::test {
namespace {

using testing::HasSubstr;

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& e) {
    return e.message();
  }
  return "";
}

// rssi of a link by the names of its ends, as the blackboard has it; NaN where there is no such link.
double rssi(const Simulation& run, const std::string& from, const std::string& to) {
  const Set& radios = *run.board().find_set("radio");
  const TableView ends = run.table("link/*/ends"), radio = run.table("endpoint/*/radio"),
                  level = run.table("link/*/rssi");
  const auto name = [&](double endpoint) {
    return radios.names[static_cast<std::size_t>(radio.at(static_cast<std::size_t>(endpoint), 0))];
  };
  for (std::size_t r = 0; r < ends.rows(); ++r) {
    if (name(ends.at(r, 0)) == from && name(ends.at(r, 1)) == to) return level.at(r, 0);
  }
  return std::nan("");
}

TEST(WideTable, HasTheRunsNumbersUnderTheirNames) {
  const Folder folder;
  std::vector<double> x, received;
  run_logged(folder / "a.mcap", 200, [&](const Simulation& run) {
    x.push_back(run.table("robot/rover-2/pose").at(0, 0));
    received.push_back(rssi(run, "base", "east"));
  });
  const auto wide = run_log::write_wide(folder / "a.mcap", folder / "a.csv", {});
  const TextTable table = TextTable::read(folder / "a.csv");
  EXPECT_EQ(table.columns().size(), wide.columns + 1);
  ASSERT_EQ(table.rows(), 201u);
  const auto time = table.reals(table.require("t", "s"));
  const auto found_x = table.reals(table.require("robot/rover-2/pose/x", "m"));
  const auto found = table.reals(table.require("link/base/east/rssi/rssi", "dBm"), {.empty = true});
  const auto back = table.reals(table.require("link/east/base/rssi/rssi", "dBm"), {.empty = true});
  std::size_t compared = 0;
  for (std::size_t row = 1; row <= 200; ++row) {
    EXPECT_DOUBLE_EQ(time[row], 0.02 * static_cast<double>(row));
    EXPECT_EQ(found_x[row], x[row - 1]) << row;
    if (row % 2 == 1) {
      EXPECT_TRUE(std::isnan(found[row])) << "links are recorded every second tick, " << row;
    } else if (!std::isnan(received[row - 1])) {
      EXPECT_EQ(found[row], received[row - 1]) << row;
      EXPECT_EQ(found[row], back[row]) << "a channel without draws is the same both ways";
      ++compared;
    }
  }
  EXPECT_GE(compared, 90u);
}

TEST(WideTable, HasMessagesByReceiverAndSender) {
  const Folder folder;
  run_logged(folder / "a.mcap", 300);
  run_log::write_wide(folder / "a.mcap", folder / "a.csv", {"inbox"});
  const TextTable table = TextTable::read(folder / "a.csv");
  const auto sent = table.reals(table.require("inbox/east/base/message/t_sent", "s"), {.empty = true});
  EXPECT_GE(table.rows(), 5u);
  EXPECT_FALSE(table.find("inbox/base/east/message/t_sent")) << "the robots do not send";
  for (const double time : sent) EXPECT_TRUE(std::isnan(time) || (time >= 0 && time <= 6));
}

TEST(WideTable, HoldsWhatIsWanted) {
  const Folder folder;
  run_logged(folder / "a.mcap", 50);
  const auto columns = [&](const std::vector<std::string>& wanted) {
    return run_log::write_wide(folder / "a.mcap", folder / "a.csv", wanted).columns;
  };
  EXPECT_EQ(columns({"robot/*/pose"}), 21u);
  EXPECT_EQ(columns({"robot/*/pose/x"}), 3u);
  EXPECT_EQ(columns({"robot/east"}), 9u);
  EXPECT_EQ(columns({"link/base/*/rssi"}), 3u);
  EXPECT_THAT(refusal([&] { columns({"robot/*/pose/w"}); }), HasSubstr("has no column \"robot/*/pose/w\"; "));
  EXPECT_THAT(refusal([&] { columns({"pose"}); }), HasSubstr("/pose\", a whole table? expected one of "));
  EXPECT_THAT(refusal([&] { columns({"robot/est/pose/x"}); }), HasSubstr("did you mean \"robot/east/pose/x\"?"));
}

TEST(WideTable, SeriesAreAColumnsOwn) {
  const Folder folder;
  std::vector<double> y;
  run_logged(folder / "a.mcap", 50,
             [&](const Simulation& run) { y.push_back(run.table("robot/north/pose").at(0, 1)); });
  const auto series = run_log::series_of(folder / "a.mcap", "robot/*/pose", "y");
  ASSERT_EQ(series.size(), 3u);
  EXPECT_EQ(series[1].name, "robot/north/pose");
  EXPECT_EQ(series[1].unit, "m");
  ASSERT_EQ(series[1].values.size(), 51u);
  EXPECT_TRUE(std::equal(y.begin(), y.end(), series[1].values.begin() + 1));
}

// Metadata and messages that contradict each other are told, whatever they are.
TEST(WideTable, RefusesWhatIsNoTable) {
  const Folder folder;
  const auto refused = [&](const mcap::Texts& metadata, const std::string& data) {
    {
      mcap::Writer writer(folder / "x.mcap", {});
      const auto channel = writer.channel({0, 0, "/x", "cdr", metadata});
      writer.message({channel, 0, 0, 0, data});
      writer.close();
    }
    return refusal([&] { run_log::write_wide(folder / "x.mcap", folder / "x.csv", {}); });
  };
  mcap::Texts about{
      {"muster.table", "robot/*/pose"}, {"muster.row", "a"}, {"muster.layout", "row"}, {"muster.fields", "x[m]:real"}};
  const std::string head("\0\1\0\0", 4);
  EXPECT_EQ(refused(about, head + std::string(8, '\0')), "");
  EXPECT_THAT(refused(about, head + std::string(7, '\0')), HasSubstr("a number of 8 bytes, of which 7 are left"));
  EXPECT_THAT(refused(about, "xxxx"), HasSubstr("a message in another encoding than little-endian CDR"));
  EXPECT_THAT(refused({}, "anything"), HasSubstr("holds no table of numbers of muster's"));
  about["muster.layout"] = "rows";
  EXPECT_THAT(refused(about, head + std::string(4, '\x7f')), HasSubstr("a message of 2139062143 rows in 0 bytes"));
  about["muster.layout"] = "spiral";
  EXPECT_THAT(refused(about, head), HasSubstr("a channel's metadata name a layout that does not exist"));
  about.erase("muster.layout");
  EXPECT_THAT(refused(about, head), HasSubstr("a channel's metadata lack muster.layout"));
}

}  // namespace
}  // namespace muster::test
