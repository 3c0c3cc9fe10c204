// Measured readings of a radio channel in the format of docs/reference/table_format.md, checked row by row.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "text/text_table.hpp"

namespace muster::diagnosis {

using Point = std::array<double, 3>;  // m

struct Covariate {
  std::string name;            // its column's label, such as "battery[V]"
  std::vector<double> values;  // NaN: empty; empty if it is a factor
  Factor factor;
  std::string no_cause{};  // why nothing can be said to depend on it; empty: it is tested
};

struct Dataset {
  std::shared_ptr<const TextTable> table;  // for file positions in messages
  std::vector<double> t{};                 // s; empty if the file has none
  std::vector<std::size_t> wild{};         // rows whose t lies far outside all others; rising
  Factor tx{}, rx{};
  std::vector<Point> tx_at{}, rx_at{};  // z is NaN where the file has none; both empty: the file has distances instead
  std::vector<double> tx_yaw{}, rx_yaw{};  // rad; empty if the file has none
  std::vector<double> rssi{};              // dBm; NaN: not received
  std::vector<std::string> marks{};        // levels taken for marks of nothing received, such as "12 at -128 dBm"
  std::string reading{};                   // name of its column: rssi, or path_loss
  std::vector<Covariate> covariates{};     // all further columns that vary
  std::vector<std::string> notes{};        // oddities that are no errors
  std::vector<double> referred{};          // dB, taken off each reading to refer it to one power; empty: nothing was

  std::size_t rows() const { return rssi.size(); }
  bool has_places() const { return !tx_at.empty(); }
  bool is_wild(std::size_t row) const { return std::binary_search(wild.begin(), wild.end(), row); }
  std::size_t heard() const;
  // "leader -> base"
  std::string pair(std::size_t row) const { return tx.levels[tx.level[row]] + " -> " + rx.levels[rx.level[row]]; }
};

// Names and units of the columns that a table of readings may have, beside covariates.
const std::map<std::string, std::string>& reading_columns();

// Reads and checks. Throws Error with file, line and column for a missing column, a duplicate reading, time that runs
// backwards, or values that no receiver reports.
Dataset read_dataset(const std::filesystem::path& file);
// From a table already read.
Dataset read_dataset(std::shared_ptr<const TextTable> table);

}  // namespace muster::diagnosis
