// Advised measurements are read from the same truth.
#include <gtest/gtest.h>
#include <unistd.h>

#include <sstream>

#include "exam/files.hpp"
#include "exam/follow_up.hpp"
#include "made.hpp"

namespace muster::exam {
namespace {

namespace fs = std::filesystem;

// Writes the answer to a folder of its own, and remakes the case from it.
Case read_back(const Case& c) {
  const fs::path folder = fs::temp_directory_path() / ("muster_follow_test_" + std::to_string(getpid()));
  write_case(c, folder);
  Case again = read_case(folder / "answers" / (c.name + ".json"));
  fs::remove_all(folder);
  return again;
}

TEST(Follow, TheCaseOfAnAnswerIsTheSameToTheBit) {
  for (const char* effect : {"", "unmapped_wall", "people", "fading_law", "height", "moisture"}) {
    const Case c = made(17, effect), again = read_back(c);
    EXPECT_EQ(world_xml(c) + walls_csv(c.site->plan), world_xml(again) + walls_csv(again.site->plan)) << effect;
    EXPECT_EQ(readings_csv(*c.site, c.measured), readings_csv(*again.site, again.measured)) << effect;
  }
}

// A file that was there was cut off first: a full disk left neither.
TEST(WrittenFile, TakesItsNameWhenItIsWhole) {
  const fs::path folder = fs::temp_directory_path() / ("muster_written_test_" + std::to_string(getpid()));
  fs::create_directories(folder);
  write_file(folder / "a", "old");
  fs::create_hard_link(folder / "a", folder / "b");
  write_file(folder / "b", "new");
  EXPECT_EQ(read_file(folder / "a"), "old");
  EXPECT_EQ(read_file(folder / "b"), "new");
  EXPECT_FALSE(fs::exists(folder / "b.part"));
  EXPECT_THROW(write_file(folder / "none/b", "x"), std::runtime_error);
  fs::remove_all(folder);
}

// Poses: robot 1 at a place, a station at a place with a heading.
struct Standing {
  int station = 0;
  Vec3 place, station_at;
  double station_yaw = 0;
  double from = 1000;  // s
};

Standing standing(const Case& c, int station, const Reading& reading) {
  const Station& s = c.site->plan.stations[static_cast<std::size_t>(station)];
  return {station, reading.at, s.at, s.yaw};
}

// dBm, mean of enough readings to average out fading: to 0.1 dB, 5 dB / sqrt(3000).
double mean_of(const Case& c, const Standing& s) {
  constexpr int count = 3000;
  const std::string& name = c.site->plan.stations[static_cast<std::size_t>(s.station)].name;
  std::vector<PlannedReadings> asked;
  for (int k = 0; k < count; ++k)
    asked.push_back({s.from + 0.001 * k, name, "robot1", s.station_at, s.place, s.station_yaw, 0.5});
  const std::string before = readings_csv(*c.site, c.measured), text = followed_csv(read_back(c), asked);
  EXPECT_EQ(text.substr(0, before.size()), before);
  std::istringstream lines(text.substr(before.size()));
  double sum = 0;
  int rows = 0, heard = 0;
  for (std::string line; std::getline(lines, line); ++rows) {
    std::istringstream cells(line);
    std::string cell;
    for (int k = 0; k < 12; ++k) std::getline(cells, cell, ',');
    if (cell.empty()) continue;
    sum += std::stod(cell);
    ++heard;
  }
  EXPECT_EQ(rows, count);
  return sum / heard;
}

TEST(FollowedMean, IsTheTruthsAtThatPlace) {
  const Case c = made(23, "tx_offset");
  const Reading& r = c.measured.readings[0];
  const Field field(*c.site, c.seed);
  const Data one = data_of(*c.site, {r});
  const double truth =
      level_by_base(c, one)[0] + expected_shift(*c.site, c.hidden, one)[0] + field(r.station, {r.at.x, r.at.y});
  Standing s = standing(c, r.station, r);
  EXPECT_NEAR(mean_of(c, s), truth, 0.3);
  s.from = 5000;  // a constant effect is the same at any time
  EXPECT_NEAR(mean_of(c, s), truth, 0.3);
}

TEST(FollowedMean, ChangesWithTheStationsHeadingWhereItsAntennaIsTheEffect) {
  for (const char* effect : {"antenna_tx", "tx_offset"}) {
    const Case c = made(23, effect);
    int station = 0;
    while (radio_row(*c.site, station) != c.hidden[0].effect.rows[0]) ++station;
    Standing s = standing(c, station, c.measured.readings[0]);
    const double as_it_stands = mean_of(c, s);
    double most = 0;
    for (int turn = 0; turn < 4; ++turn) {
      s.station_yaw += 1;
      most = std::max(most, std::abs(mean_of(c, s) - as_it_stands));
    }
    if (effect == std::string("antenna_tx"))
      EXPECT_GT(most, 1);
    else
      EXPECT_LT(most, 0.3);
  }
}

TEST(FollowedMean, OfAStationThatWasMovedHasAnotherShadow) {
  const Case c = made(29, "");
  double squares = 0;
  for (std::size_t k = 0; k < 8; ++k) {
    Standing s = standing(c, 0, c.measured.readings[c.measured.size() / 8 * k]);
    const double before = mean_of(c, s);
    s.station_at.x += 0.03;  // no further wall, and the same distance to a few centimetres
    squares += std::pow(mean_of(c, s) - before, 2);
  }
  // The difference of two independent fields has twice the variance.
  EXPECT_GT(std::sqrt(squares / 8 / 2), 0.3 * c.site->noise.field.sigma);
}

TEST(Follow, RefusesWhatTheCaseHasNot) {
  const Case c = made(3, "");
  const Vec3 at = c.site->plan.stations[0].at;
  EXPECT_THROW(followed_csv(c, {{0, "ghost", "robot1", at, {}, 0, 0}}), std::runtime_error);
  EXPECT_THROW(followed_csv(c, {{0, "beacon1", "robot9", at, {}, 0, 0}}), std::runtime_error);
  const std::string head = "t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],rx_x[m],rx_y[m],rx_z[m],tx_yaw[rad],rx_yaw[rad]\n";
  EXPECT_EQ(read_plan(head + "2,a,b,1,2,3,4,5,6,0,0\n1,a,b,1,2,3,4,5,6,0,0\n")[0].t, 1);
  for (const char* bad : {"", "2,a,b,1,2,3,4,5,6,0\n", "x,a,b,1,2,3,4,5,6,0,0\n", "nan,a,b,1,2,3,4,5,6,0,0\n"})
    EXPECT_THROW(read_plan(head + bad), std::runtime_error) << bad;
  EXPECT_THROW(read_plan("t[s],tx,rx\n1,a,b\n"), std::runtime_error);
}

}  // namespace
}  // namespace muster::exam
