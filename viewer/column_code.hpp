// Codes the columns of tables as bytes that compress well and give back every bit.
//
// A code is JSON beside bytes; viewer/page/model/codes.js reads it. `at` is an offset in the bytes, `count` a number of
// rows:
//   {"kind": "constant", "value", "count"}                all rows alike
//   {"kind": "scaled", "type", "at", "count", "step" or "by", "delta"}
//       integers k that stand for k * step, or for k / by. With delta each is a difference to the one before. Without,
//       the three lowest integers of the type stand for NaN, +inf and -inf
//   {"kind": "planes", "at", "count"}                     doubles, each XORed with the one before: eight planes of
//   bytes
//   {"kind": "names", "levels", "type", "at", "count"}    row r is levels[k]
//   {"kind": "lists", "lengths": code, "values": code}    lists of numbers, end to end
// Types are i8, i16, i32 and u8, u16, u32, little-endian.
#pragma once

#include <string>
#include <vector>

#include "text/json.hpp"
#include "text/text_table.hpp"

namespace muster::viewer {

// `tick`: seconds a tick. Times are whole ticks, and so take a byte or two.
Json code_of(const std::vector<double>& values, double tick, std::string& bytes);
Json code_of(const Factor& names, std::string& bytes);
Json code_of(const std::vector<std::vector<double>>& lists, double tick, std::string& bytes);

}  // namespace muster::viewer
