// Columns come out of their codes bit for bit, and take few bytes where they can.
#include "viewer/column_code.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "decoded.hpp"

namespace muster::test {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double tick = 0.05;

std::string kind_of(const std::vector<double>& values) {
  std::string bytes;
  return Read::parse(viewer::code_of(values, tick, bytes).dump())["kind"];
}

// Codes after 5 other bytes, decodes, compares bit for bit; returns the number of bytes.
std::size_t expect_same(const std::vector<double>& values) {
  std::string bytes = "other";
  const Read code = Read::parse(viewer::code_of(values, tick, bytes).dump());
  const auto read = numbers(code, bytes);
  EXPECT_EQ(read.size(), values.size());
  for (std::size_t i = 0; i < std::min(read.size(), values.size()); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read[i]), std::bit_cast<std::uint64_t>(values[i]))
        << code.dump() << ", row " << i << ": " << values[i];
  return bytes.size() - 5;
}

TEST(ColumnCode, AConstantTakesNoBytes) {
  EXPECT_EQ(expect_same({}), 0u);
  EXPECT_EQ(expect_same({0.1, 0.1, 0.1}), 0u);
  EXPECT_EQ(expect_same(std::vector<double>(1000, -3.25e-300)), 0u);
}

TEST(ColumnCode, TimesTakeAByteEach) {
  std::vector<double> times;
  for (int k = 0; k < 10'000; ++k) times.push_back(k * tick);
  EXPECT_EQ(expect_same(times), times.size());
  times.insert(times.end(), times.begin(), times.begin() + 9000);  // the next robot's: from the start again
  EXPECT_EQ(expect_same(times), 2 * times.size());
}

TEST(ColumnCode, QuantisedReadingsTakeFewBytesWithTheirGaps) {
  EXPECT_EQ(expect_same({-60, -61, nothing, -59, -60}), 5u);
  EXPECT_EQ(expect_same({-60.5, -61, nothing, -59.5}), 8u);
  EXPECT_EQ(expect_same({1.234, infinite, 0.02, -infinite, 4}), 10u);  // a laser's millimetres
  std::vector<double> ranges;
  for (int k = 20; k < 4000; k += 7) ranges.push_back(k * 0.001);
  EXPECT_EQ(expect_same(ranges), ranges.size());
}

TEST(ColumnCode, IntegersAtTheEndsOfATypeAreKept) {
  for (const double end : {124.0, 125.0, 126.0, 127.0, 128.0, 32764.0, 32767.0, 32768.0, 2147483000.0, 2147483647.0}) {
    expect_same({end, nothing, -end, 0});
    expect_same({end, -end, 0, end});
    expect_same({-end, nothing, infinite});
  }
  expect_same({1e15, 2e15, 1e300});
}

TEST(ColumnCode, WhateverADoubleHoldsComesBack) {
  expect_same({-0.0, 0.0, -0.0});
  expect_same({-0.0});
  expect_same({nothing});
  expect_same({nothing, nothing});
  expect_same({infinite, -infinite});
  expect_same({std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max(), 1.0 / 3});
  expect_same({std::bit_cast<double>(0x7ffadead0badcafeull), 1, 2});  // a NaN that is not the usual one
  std::mt19937_64 random(7);
  std::vector<double> any;
  for (int i = 0; i < 5000; ++i) any.push_back(std::bit_cast<double>(random()));
  EXPECT_EQ(expect_same(any), 8 * any.size());
  EXPECT_EQ(kind_of(any), "planes");
}

TEST(ColumnCode, NamesComeBack) {
  Factor factor;
  for (std::uint32_t i = 0; i < 700; ++i) {
    factor.levels.push_back("radio \"" + std::to_string(i) + "\"");
    factor.level.push_back(699 - i);
  }
  std::string bytes = "other";
  const Read code = Read::parse(viewer::code_of(factor, bytes).dump());
  EXPECT_EQ(bytes.size() - 5, 1400u);
  const auto read = names(code, bytes);
  ASSERT_EQ(read.size(), 700u);
  for (std::size_t i = 0; i < read.size(); ++i) EXPECT_EQ(read[i], factor.levels[factor.level[i]]);
}

TEST(ColumnCode, ListsComeBack) {
  const std::vector<std::vector<double>> lists{{1.5, infinite, 0.25}, {}, {4}, {0.1, 0.2}};
  std::string bytes;
  const Read code = Read::parse(viewer::code_of(lists, tick, bytes).dump());
  EXPECT_EQ(numbers(code["lengths"], bytes), (std::vector<double>{3, 0, 1, 2}));
  EXPECT_EQ(numbers(code["values"], bytes), (std::vector<double>{1.5, infinite, 0.25, 4, 0.1, 0.2}));
}

}  // namespace
}  // namespace muster::test
