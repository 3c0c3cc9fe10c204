// Readings that are off by several decibels: one by one they are outliers, one after the other they are not.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>

#include "diagnosis/pipeline/diagnose.hpp"
#include "muster/random.hpp"
#include "tests/diagnosis/pipeline/flat.hpp"

namespace muster::diagnosis {
namespace {

// What is added to a reading: its number and its station.
using Added = std::function<double(uint64_t, std::size_t)>;

// A tour of a flat in a field, with what is added.
Diagnosis diagnosed(const std::string& field, const Added& added) {
  const Scratch scratch;
  const auto world = flat(scratch, 5, field);
  std::stringstream drawn;
  drawn << std::ifstream(drawn_by(scratch, world)).rdbuf();
  std::string line;
  std::getline(drawn, line);
  std::ofstream measured(scratch / "measured.csv");
  measured << line << '\n';
  for (uint64_t i = 0; std::getline(drawn, line); ++i) {
    const auto comma = line.rfind(',');
    measured << line.substr(0, comma + 1) << print_real(std::stod(line.substr(comma + 1)) + added(i, i % 3)) << '\n';
  }
  measured.close();
  return diagnose(world, scratch / "measured.csv", plugins);
}

// Normal noise of 0.5 dB. A twentieth of the readings is off by up to 9 dB, either way: each station's in runs of
// `lasting`.
Diagnosis off_in_runs(int lasting) {
  const Stream random(combined(key_of("off in runs"), static_cast<uint64_t>(lasting)));
  std::array<int, 3> left{};  // of the run, by station
  std::array<double, 3> by{};
  return diagnosed("fading=\"false\"", [&](uint64_t i, std::size_t station) {
    if (left[station] == 0 && random.of(1).uniform(i) < 0.05 / lasting) {
      left[station] = lasting;
      by[station] = 9 * (2 * random.of(2).uniform(i) - 1);
    }
    const double off = left[station] > 0 ? by[station] : 0;
    left[station] -= left[station] > 0;
    return off + 0.5 * random.of(3).normal(i);
  });
}

bool names(const Diagnosis& found, const std::string& cause) {
  return std::any_of(found.causes.begin(), found.causes.end(), [&](const CauseEstimate& c) { return c.id == cause; });
}

TEST(Survey, ReadingsThatAreOffOneByOneAreOutliers) { EXPECT_TRUE(names(off_in_runs(1), "effect.outliers")); }

TEST(Survey, ReadingsThatAreOffInRunsAreNoOutliers) {
  const Diagnosis found = off_in_runs(4);
  EXPECT_FALSE(names(found, "effect.outliers"));
  EXPECT_TRUE(std::any_of(found.notes.begin(), found.notes.end(), [](const std::string& note) {
    return note.find("follow each other") != note.npos;
  })) << testing::PrintToString(found.notes);
}

// Where the field is a little off, a law fits a stretch of readings less well than the next: readings that need it
// follow each other, but each is off by another amount.
TEST(Survey, ChannelsThatHopBesideAFieldAreNamed) {
  const Stream random(key_of("hopping"));
  const Diagnosis found =
      diagnosed("shadowing=\"1.5\" decorrelation=\"1.7\" fading=\"false\"",
                [&](uint64_t i, std::size_t) { return 6.6 * (std::floor(3 * random.uniform(i)) - 1); });
  EXPECT_TRUE(names(found, "effect.channel_mixture")) << testing::PrintToString(found.notes);
}

}  // namespace
}  // namespace muster::diagnosis
