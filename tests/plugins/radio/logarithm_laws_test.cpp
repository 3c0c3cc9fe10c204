// Logarithms of many numbers: those of the library, and the same bits at each width of vectors.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <muster/logarithm.hpp>
#include <muster/random.hpp>
#include <vector>

namespace muster {
namespace {

// Of all sizes, and more of them near 1, where the logarithm is small.
std::vector<double> positive_numbers() {
  std::vector<double> result{1, std::nextafter(1, 0), std::nextafter(1, 2), std::sqrt(0.5), std::sqrt(2), 10, 1e-4};
  result.push_back(std::numeric_limits<double>::min());
  result.push_back(std::numeric_limits<double>::max());
  const Stream random(3);
  for (uint64_t i = 0; i < 200001; ++i) {
    const double size = i % 2 == 0 ? 300 : 0.1;
    result.push_back(std::pow(10, size * (2 * random.uniform(i) - 1)));
  }
  return result;
}

TEST(Logarithm, IsThatOfTheLibrary) {
  const auto numbers = positive_numbers();
  auto logarithms = numbers;
  log10_of_all(logarithms.data(), logarithms.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double expected = std::log10(numbers[i]);
    ASSERT_NEAR(logarithms[i], expected, 4e-16 * std::max(1.0, std::abs(expected))) << numbers[i];
  }
  EXPECT_EQ(logarithms[0], 0);
}

TEST(Logarithm, IsTheSameBitsAtEachWidth) {
  const auto numbers = positive_numbers();
  const auto widths = Widest<Log10, double*, std::size_t>::all();
  auto first = numbers;
  widths.of[0](first.data(), first.size());
  for (int i = 1; i < widths.number; ++i) {
    auto other = numbers;
    widths.of[i](other.data(), other.size());
    EXPECT_EQ(std::memcmp(first.data(), other.data(), first.size() * sizeof first[0]), 0) << i;
  }
}

TEST(Logarithm, OfZeroIsFarBelowAnyLevel) {
  double zero = 0;
  log10_of_all(&zero, 1);
  EXPECT_LT(zero, -300);
}

}  // namespace
}  // namespace muster
