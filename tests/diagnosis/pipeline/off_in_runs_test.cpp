// Readings that are off by several decibels: one by one they are outliers, one after the other they are not.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>

#include "diagnosis/pipeline/diagnose.hpp"
#include "muster/random.hpp"
#include "tests/diagnosis/pipeline/flat.hpp"

namespace muster::diagnosis {
namespace {

// A tour of a flat with normal noise of 0.5 dB. A twentieth of the readings is off by up to 9 dB, either way: each
// station's in runs of `lasting`.
Diagnosis diagnosed(int lasting) {
  const Scratch scratch;
  const auto world = flat(scratch, 5, "fading=\"false\"");
  std::stringstream drawn;
  drawn << std::ifstream(drawn_by(scratch, world)).rdbuf();
  std::string line;
  std::getline(drawn, line);
  std::ofstream measured(scratch / "measured.csv");
  measured << line << '\n';
  const Stream random(combined(key_of("off in runs"), static_cast<uint64_t>(lasting)));
  std::array<int, 3> left{};  // of the run, by station
  std::array<double, 3> by{};
  for (uint64_t i = 0; std::getline(drawn, line); ++i) {
    const std::size_t station = i % 3;
    if (left[station] == 0 && random.of(1).uniform(i) < 0.05 / lasting) {
      left[station] = lasting;
      by[station] = 9 * (2 * random.of(2).uniform(i) - 1);
    }
    const auto comma = line.rfind(',');
    const double off = left[station] > 0 ? by[station] : 0;
    left[station] -= left[station] > 0;
    measured << line.substr(0, comma + 1)
             << print_real(std::stod(line.substr(comma + 1)) + off + 0.5 * random.of(3).normal(i)) << '\n';
  }
  measured.close();
  return diagnose(world, scratch / "measured.csv", plugins);
}

bool names_outliers(const Diagnosis& found) {
  return std::any_of(found.causes.begin(), found.causes.end(),
                     [](const CauseEstimate& c) { return c.id == "effect.outliers"; });
}

TEST(Survey, ReadingsThatAreOffOneByOneAreOutliers) { EXPECT_TRUE(names_outliers(diagnosed(1))); }

TEST(Survey, ReadingsThatAreOffInRunsAreNoOutliers) {
  const Diagnosis found = diagnosed(4);
  EXPECT_FALSE(names_outliers(found));
  EXPECT_TRUE(std::any_of(found.notes.begin(), found.notes.end(), [](const std::string& note) {
    return note.find("follow each other") != note.npos;
  })) << testing::PrintToString(found.notes);
}

}  // namespace
}  // namespace muster::diagnosis
