// Detection and restoration of changes by a guard.
#include "loader/float_guard.hpp"

#include <gtest/gtest.h>
#include <pmmintrin.h>

#include <cfenv>
#include <functional>
#include <limits>
#include <thread>

namespace muster {
namespace {

std::string seen(const std::function<void()>& change) {
  const FloatGuard guard;
  change();
  EXPECT_EQ(guard.changed(), !guard.what().empty());
  return guard.what();
}

TEST(FloatGuard, NamesWhatWasChangedAndRestoresIt) {
  const FloatGuard all;
  EXPECT_EQ(seen([] {}), "");
  EXPECT_EQ(seen([] { _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON); }), "flushes denormals to zero");
  EXPECT_EQ(seen([] { _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON); }), "flushes denormals to zero");
  EXPECT_EQ(seen([] { std::fesetround(FE_TOWARDZERO); }), "rounds toward zero");
  EXPECT_EQ(seen([] { ::feenableexcept(FE_INVALID); }),
            "changes which floating-point exceptions trap, changes the x87 control word");
  EXPECT_EQ(seen([] {
              const unsigned short upward = 0x0b7f;
              asm volatile("fldcw %0" : : "m"(upward));
            }),
            "makes the x87 round upward");
  EXPECT_EQ(all.what(), "");
}

TEST(FloatGuard, LetsHonestArithmeticRaiseFlags) {
  std::feclearexcept(FE_ALL_EXCEPT);
  EXPECT_EQ(seen([] {
              volatile double smallest = std::numeric_limits<double>::min();
              smallest = smallest / 3;
            }),
            "");
  EXPECT_TRUE(std::fetestexcept(FE_UNDERFLOW));
}

TEST(FloatGuard, ComparesAnotherThreadWithTheFirst) {
  const FloatGuard guard;
  std::string there;
  std::thread([&] {
    std::fesetround(FE_UPWARD);
    there = guard.what();
    guard.restore();
    EXPECT_EQ(std::fegetround(), FE_TONEAREST);
  }).join();
  EXPECT_EQ(there, "rounds upward");
  EXPECT_FALSE(guard.changed());
}

}  // namespace
}  // namespace muster
