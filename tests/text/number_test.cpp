#include "text/number.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>

namespace muster {
namespace {

TEST(Number, TestsRunWithADecimalComma) {
  std::ostringstream stream;
  stream << 1.5;
  ASSERT_EQ(stream.str(), "1,5");
}

TEST(Number, ReadsWholeFiniteDecimals) {
  EXPECT_EQ(parse_real("1.5"), 1.5);
  EXPECT_EQ(parse_real("-12.9"), -12.9);
  EXPECT_EQ(parse_real(".5"), 0.5);
  EXPECT_EQ(parse_real("1e-3"), 0.001);
  EXPECT_EQ(parse_real("1E+3"), 1000.0);
  EXPECT_EQ(parse_real("5e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_TRUE(std::signbit(parse_real("-0").value()));
  EXPECT_EQ(parse_integer("-42"), -42);
  EXPECT_EQ(parse_integer("9223372036854775807"), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(why_not_real("1.5"), "");
  EXPECT_EQ(why_not_integer("7"), "");
}

TEST(Number, SaysWhyNot) {
  const std::pair<std::string_view, std::string_view> cases[] = {
      {"", R"("" is not a number; the text is empty)"},
      {" ", R"(" " is not a number; it has spaces in it or around it)"},
      {" 1", R"(" 1" is not a number; it has spaces in it or around it)"},
      {"1 ", R"("1 " is not a number; it has spaces in it or around it)"},
      {"1\n", R"("1\x0a" is not a number; it has spaces in it or around it)"},
      {"3 4", R"("3 4" is not a number; it has spaces in it or around it)"},
      {"1,5", R"("1,5" is not a number; a decimal point is written '.')"},
      {"+1", R"("+1" is not a number; a positive number is written without '+')"},
      {"1,234.5", R"("1,234.5" is not a number; no commas stand between thousands; expected 1234.5)"},
      {"12,345,678", R"("12,345,678" is not a number; no commas stand between thousands; expected 12345678)"},
      {"1,2345.5", R"("1,2345.5" is not a number; a decimal point is written '.')"},
      {"3,", R"("3," is not a number; a comma stands beside it; expected none)"},
      {"0x10", R"("0x10" is not a number; numbers are written in decimal: 16)"},
      {"-0X1p3", R"("-0X1p3" is not a number; numbers are written in decimal)"},
      {"nan", R"("nan" is not a number; it must be finite)"},
      {"-nan(0x1)", "\"-nan(0x1)\" is not a number; it must be finite"},
      {"inf", R"("inf" is not a number; it must be finite)"},
      {"-Infinity", R"("-Infinity" is not a number; it must be finite)"},
      {"1e400", R"("1e400" is out of range)"},
      {"-1e400", R"("-1e400" is out of range)"},
      {"1e-400", R"("1e-400" is out of range)"},
      {"1/60", R"("1/60" is not a number, but a fraction; expected 0.016666666666666666)"},
      {"1.5abc", R"("1.5abc" is not a number; "abc" follows the number)"},
      {"10s", R"("10s" is not a number; "s" follows the number: units are fixed and not written)"},
      {"20 dBm", R"("20 dBm" is not a number; "dBm" follows the number: units are fixed and not written)"},
      {"20DBM", R"("20DBM" is not a number; "DBM" follows the number: units are fixed and not written)"},
      {" 3 kg*m2 ", R"(" 3 kg*m2 " is not a number; "kg*m2" follows the number: units are fixed and not written)"},
      {"90\u00b0", "\"90\u00b0\" is not a number; \"\u00b0\" follows the number: units are fixed and not written"},
      {"3 apples", R"("3 apples" is not a number; it has spaces in it or around it)"},
      {"m", R"("m" is not a number, but a unit: units are fixed and not written)"},
      {"true", R"("true" is not a number, but a word for yes or no)"},
      {"1e400x", R"("1e400x" is not a number; "x" follows the number)"},
      {"1.2.3", R"("1.2.3" is not a number; ".3" follows the number)"},
      {"abc", R"("abc" is not a number)"},
      {"-", R"("-" is not a number)"},
      {".", R"("." is not a number)"},
      {std::string_view("1\0", 2), R"("1\x00" is not a number; "\x00" follows the number)"},
  };
  for (const auto& [text, why] : cases) {
    EXPECT_EQ(why_not_real(text), why);
    EXPECT_FALSE(parse_real(text)) << text;
  }
}

TEST(Number, SaysWhyNotAnInteger) {
  const std::pair<std::string_view, std::string_view> cases[] = {
      {"1e5", R"("1e5" is not an integer; "e5" follows the number)"},
      {"1.0", R"("1.0" is not an integer; ".0" follows the number)"},
      {"9223372036854775808", R"("9223372036854775808" is out of range)"},
      {"+1", R"("+1" is not an integer; a positive number is written without '+')"},
      {"", R"("" is not an integer; the text is empty)"},
  };
  for (const auto& [text, why] : cases) {
    EXPECT_EQ(why_not_integer(text), why);
    EXPECT_FALSE(parse_integer(text)) << text;
  }
}

TEST(Number, ReadsLists) {
  EXPECT_EQ(parse_reals("12 0", 2), (std::vector<double>{12, 0}));
  EXPECT_EQ(parse_reals("1  2\n 3", 3), (std::vector<double>{1, 2, 3}));
  EXPECT_FALSE(parse_reals("1 2", 3));
  EXPECT_FALSE(parse_reals("1 2 3 4", 3));
  EXPECT_FALSE(parse_reals("1 x 3", 3));
  EXPECT_EQ(why_not_reals("1 2 3", 3), "");
  EXPECT_EQ(why_not_reals("1 2", 3), R"("1 2" has 2 numbers)");
  EXPECT_EQ(why_not_reals("", 2), R"("" has 0 numbers)");
  EXPECT_EQ(why_not_reals("1,0,2.5", 3), R"("1,0,2.5" has commas between its numbers)");
  EXPECT_EQ(why_not_reals("3, 2, 0", 3), R"("3, 2, 0" has commas between its numbers)");
  EXPECT_EQ(why_not_reals("[3, 2, 0]", 3), R"("[3, 2, 0]" has brackets around its numbers)");
  EXPECT_EQ(why_not_reals("3;2;0", 3), R"("3;2;0" has semicolons between its numbers)");
  EXPECT_EQ(why_not_reals("3, 2", 3), R"("3, 2" has commas between its numbers, and 2 numbers)");
  EXPECT_EQ(why_not_reals("1,5 2 0", 3), R"("1,5" is not a number; a decimal point is written '.')");
  EXPECT_EQ(why_not_reals("3 m 2 m", 2), R"("m" is not a number, but a unit: units are fixed and not written)");
  EXPECT_EQ(reals_as_meant("(3, -2.5, 1e3)", 3), "3 -2.5 1e3");
  EXPECT_EQ(reals_as_meant("3 2 0", 3), "");
  EXPECT_EQ(reals_as_meant("3, 2", 3), "");
  EXPECT_EQ(why_not_reals("1,0 2", 2), R"("1,0" is not a number; a decimal point is written '.')");
}

TEST(Number, PrintsTheShortestText) {
  EXPECT_EQ(print_real(0.1), "0.1");
  EXPECT_EQ(print_real(-12.9), "-12.9");
  EXPECT_EQ(print_real(1500), "1500");
  EXPECT_EQ(print_real(1e22), "1e+22");
  EXPECT_EQ(print_real(-0.0), "-0");
  EXPECT_EQ(print_real(-std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(print_real(-std::numeric_limits<double>::infinity()), "-inf");
}

// Bit patterns drawn evenly reach every exponent, subnormals included.
TEST(Number, EveryFiniteRealComesBackBitForBit) {
  std::mt19937_64 draw(20);
  int finite = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    const double value = std::bit_cast<double>(draw());
    const std::string text = print_real(value);
    ASSERT_LE(text.size(), 24u);
    if (!std::isfinite(value)) {
      ASSERT_FALSE(parse_real(text));
      continue;
    }
    ++finite;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(parse_real(text).value()), std::bit_cast<std::uint64_t>(value)) << text;
  }
  EXPECT_GT(finite, 990'000);
  for (const double edge : {std::numeric_limits<double>::max(), std::numeric_limits<double>::min(),
                            std::numeric_limits<double>::denorm_min(), 0.0}) {
    EXPECT_EQ(parse_real(print_real(edge)), edge);
    EXPECT_EQ(parse_real(print_real(-edge)), -edge);
  }
}

}  // namespace
}  // namespace muster
