// Cells of a table that are numbers and look like something else: a mark for no value, another unit, the globe.
#pragma once

#include <string>
#include <vector>

#include "text_table.hpp"

namespace muster {

// Throws Error for a length that cannot be negative, such as a radius. `values` are those of the column, NaN where it
// has none.
void refuse_negative_length(const TextTable& table, std::size_t column, const std::vector<double>& values);

// True of numbers by which loggers mark that there is no value: nines, and the ends of 16 bits.
bool is_mark(double value);

// "FILE:LINE:COLUMN: what" of marks for no value, which lie far from all other numbers of the column; empty where there
// are none.
std::string mark_doubt(const TextTable& table, std::size_t column, const std::vector<double>& values);

// "FILE:LINE:COLUMN: what" of the first cell of each kind in the column; empty where there is nothing to doubt.
std::vector<std::string> column_doubts(const TextTable& table, std::size_t column, const std::vector<double>& values);

// How a header is written that is meant by `label`, such as "x[m]" by "X (m)", "x_m" or "x[ft]", the latter with its
// conversion; empty where none of the wanted columns is meant.
std::string as_wanted(const std::string& label, const std::vector<TextColumn>& wanted);

// `"x[m]"` and `"x[m]": 1 ft is 0.3048 m` of what as_wanted() returns.
std::string quoted_label(const std::string& wanted);

// `: 1 ft is 0.3048 m`; empty for units that have nothing in common.
std::string conversion(const std::string& from, const std::string& to);

// True for the word that begins a last line of sums: "Total", "mean".
bool is_summary(std::string_view cell);

}  // namespace muster
