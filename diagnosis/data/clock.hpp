// Clocks of measured tables: units since 1970, row numbers in place of times, and wild stamps.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "text/text_table.hpp"

namespace muster::diagnosis {

// Seconds in one unit of a clock that counts since 1970, by its size: 1e-9 for nanoseconds. Below 1e11 it is seconds,
// which reach to the year 5138.
double unit_of_clock(double stamp);
// "nanoseconds"
std::string name_of_unit(double seconds);

// The table with `t` in seconds if its values are milli-, micro- or nanoseconds since 1970. Without `t` if that has no
// unit and counts rows: its column is then called row_number. Otherwise the same table. Adds notes.
std::shared_ptr<const TextTable> with_clock_in_seconds(std::shared_ptr<const TextTable> table,
                                                       std::vector<std::string>& notes);

// Rows whose time lies far outside all others: at most one in a thousand, and farther than an hour and than 100 times
// the range of the middle nine tenths. Rising.
std::vector<std::size_t> wild_stamps(const std::vector<double>& t);

}  // namespace muster::diagnosis
