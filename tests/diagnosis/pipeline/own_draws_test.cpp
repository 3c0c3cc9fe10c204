// Readings that a world draws itself, diagnosed by the very same world: nothing is wrong with it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "diagnosis/pipeline/diagnose.hpp"
#include "tests/diagnosis/pipeline/flat.hpp"

namespace muster::diagnosis {
namespace {

// Logarithm of the ratio of the fitted decorrelation distance to the declared one.
double expect_silence(int seed, const std::string& fading) {
  SCOPED_TRACE(std::to_string(seed) + ": " + fading);
  const Scratch scratch;
  const std::filesystem::path world = flat(scratch, seed, fading);
  const std::filesystem::path measured = drawn_by(scratch, world);
  const Diagnosis found = diagnose(world, measured, plugins);
  EXPECT_EQ(names_in_words(named_causes(found)), "silent");
  EXPECT_EQ(found.noise.family, noise::Family::stated);
  return std::log(found.noise.decorrelation() / 2);
}

TEST(OwnDraws, NothingIsWrongUnderFadingOfEachReading) {
  double off = 0;
  for (const int seed : {1, 2, 3, 4}) off += expect_silence(seed, "rician_k=\"6\" per_reading=\"true\"") / 4;
  EXPECT_LT(std::abs(off), std::log(2.0));
}

TEST(OwnDraws, NothingIsWrongUnderMultipath) {
  double off = 0;
  for (const int seed : {5, 6, 7}) off += expect_silence(seed, "rician_k=\"3\"") / 3;
  EXPECT_LT(std::abs(off), std::log(2.0));
}

}  // namespace
}  // namespace muster::diagnosis
