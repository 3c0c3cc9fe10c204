// Numbers to and from text, the same in every locale: the only conversions in the project.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace muster {

// The whole text as a finite decimal number; null for spaces, '+', hexadecimal, nan, inf and numbers out of a double's
// range.
std::optional<double> parse_real(std::string_view text);

// An empty text, and the words of others for a value that is missing: nan, NA, null.
bool stands_for_nothing(std::string_view text);

// The whole text as a decimal integer of 64 bits, under the same rules.
std::optional<std::int64_t> parse_integer(std::string_view text);

// A list of exactly n numbers with white space between them.
std::optional<std::vector<double>> parse_reals(std::string_view text, std::size_t n);

// The shortest text that parse_real reads back as the same bits (and "nan", "inf", "-inf", which it refuses).
std::string print_real(double value);

// For an error: the reason for refusing the text, as in `"1,5" is not a number; a decimal point is written '.'`; empty
// if it is valid.
std::string why_not_real(std::string_view text);
bool is_infinite(std::string_view text);  // "inf", "-Infinity"
std::string why_not_integer(std::string_view text);
std::string why_not_reals(std::string_view text, std::size_t n);

// "3 2 0" of "3, 2, 0" and "[3; 2; 0]", which parse_reals refuses; empty where it is no such list of n numbers.
std::string reals_as_meant(std::string_view text, std::size_t n);

}  // namespace muster
