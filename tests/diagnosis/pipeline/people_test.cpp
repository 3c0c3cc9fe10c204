// People beside an effect in time, on the data's only link, which cannot be left out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "diagnosis/pipeline/closed_loop.hpp"
#include "diagnosis/report/regression.hpp"
#include "tests/diagnosis/pipeline/sealed_case.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

const std::filesystem::path hall = std::filesystem::path(MUSTER_SOURCE_DIR) / "worlds" / "hall";

// Times of blockages: random, 12 s apart at least.
std::vector<double> passages(double last) {
  std::mt19937 random(3);
  std::exponential_distribution between(1.0 / 28);
  std::vector<double> result;
  for (double t = 20; t < last; t += 12 + between(random)) result.push_back(t);
  return result;
}

// The tour of the hall without its wall, with people of 12 dB for 3 s each, and 5 dB less in its last part.
std::filesystem::path walked_through(const Scratch& scratch) {
  constexpr double last = 4000, later = 2400;  // s
  const std::vector<double> times = passages(last);
  std::ifstream in(hall / "measured_plain.csv");
  std::ofstream out(scratch / "people.csv");
  std::string line;
  std::getline(in, line);
  out << line << '\n';
  while (std::getline(in, line)) {
    const double t = std::stod(line);
    const std::size_t at = line.rfind(',') + 1;
    double rssi = std::stod(line.substr(at));
    if (std::any_of(times.begin(), times.end(), [&](double passed) { return std::abs(t - passed) < 1.5; })) rssi -= 12;
    if (t > later) rssi -= 5;
    out << line.substr(0, at) << print_real(rssi) << '\n';
  }
  return scratch / "people.csv";
}

TEST(BlockageOfTheOnlyLink, IsNamedBesideAStepAndTheExtendedWorldHoldsIt) {
  const Scratch scratch;
  const std::filesystem::path data = walked_through(scratch), extended = scratch / "extended";
  Diagnosis found = diagnose(hall, data, plugins);
  ASSERT_EQ(names_in_words(named_causes(found)), "effect.step all, effect.people radio/base radio/rover");
  for (const auto& [path, value] : found.parameters) EXPECT_EQ(path.find("people"), path.npos) << path;
  found.loop = closed_loop(found, hall, data, extended, plugins);
  EXPECT_LT(found.loop->mean_difference, 0.1);
  EXPECT_EQ(names_in_words(found.loop->rediagnosis), "silent");
  report::write_regression(found, hall, data, extended);
  for (const report::Checked& c : report::check_regression(extended, plugins))
    EXPECT_TRUE(c.passed) << c.what << ": " << c.found << "; expected " << c.expected;
}

}  // namespace
}  // namespace muster::diagnosis
