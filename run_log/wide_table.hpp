// A log's tables as one wide table: a row a time, a column a named row's number, "robot/leader/pose/x[m]". Links and
// messages are columns by the names that they are about: "link/base/rover/rssi/rssi[dBm]".
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace muster::run_log {

struct WideTable {
  std::uint64_t columns = 0;  // beside the time
  std::uint64_t rows = 0;
  std::uint64_t replaced = 0;  // values of which a later one has the same time and name
};

// Writes CSV, whole or not at all. `wanted`: tables or columns, with a star for any names, "robot/*/pose",
// "link/*/rssi/rssi", "robot/leader"; empty: all. Throws Error, also where nothing is wanted that the log has.
WideTable write_wide(const std::filesystem::path& log, const std::filesystem::path& csv,
                     const std::vector<std::string>& wanted);

struct Series {
  std::string name;  // the table with the row's names, "robot/leader/pose"
  std::string unit;
  std::vector<double> times, values;  // s
};

// Of one column of a table, "robot/*/pose" and "x". In the order of their first values. Throws Error.
std::vector<Series> series_of(const std::filesystem::path& log, const std::string& table, const std::string& column);

}  // namespace muster::run_log
