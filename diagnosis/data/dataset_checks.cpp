#include "diagnosis/data/dataset_checks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>

#include "text/names.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

constexpr double strongest = 30;   // dBm: a watt at the receiver
constexpr double sentinel = -128;  // value of an 8-bit register without a measurement
constexpr double weakest = -174;   // dBm: thermal noise in 1 Hz

std::string row_text(std::size_t row) { return "row " + std::to_string(row + 1); }

// Rows count from 1, below the header: row r is on line r + 1.
Place at(const Dataset& data, std::size_t row, const std::string& column) {
  return data.table->place(row, data.table->find(column).value());
}

void check_rssi(const Dataset& data) {
  for (std::size_t row = 0; row < data.rows(); ++row) {
    const double v = data.rssi[row];
    const auto refuse = [&](const std::string& why) {
      const bool loss = data.reading == "path_loss";
      const std::string what = loss ? "a path loss of " + print_real(-v) + " dB, a level of " + print_real(v) + " dBm, "
                                    : "an rssi of " + print_real(v) + " dBm ";
      return invalid(at(data, row, data.reading), row_text(row) + ": " + what + why);
    };
    if (v == 0) throw refuse("is what drivers give for none; expected an empty cell where nothing was received");
    if (v > strongest) throw refuse("is over +30 dBm; expected a level in dBm, which is mostly negative");
    if (v == sentinel) throw refuse("is a mark for none; expected an empty cell where nothing was received");
    if (v < weakest) throw refuse("is below thermal noise; expected a level in dBm");
  }
}

void check_ends(const Dataset& data) {
  for (std::size_t row = 0; row < data.rows(); ++row) {
    if (data.tx.levels[data.tx.level[row]] == data.rx.levels[data.rx.level[row]])
      throw invalid(at(data, row, "rx"), row_text(row) + ": " + quote(data.rx.levels[data.rx.level[row]]) +
                                             " hears itself; expected two radios");
  }
}

// One pass in file order finds both faults: time of a pair may repeat only if (t, tx, rx) does not.
void check_times(const Dataset& data) {
  if (data.t.empty()) return;
  std::unordered_map<std::uint64_t, std::size_t> last;
  for (std::size_t row = 0; row < data.rows(); ++row) {
    const std::uint64_t pair = (std::uint64_t{data.tx.level[row]} << 32) | data.rx.level[row];
    const auto [entry, is_first] = last.emplace(pair, row);
    if (!is_first) {
      const std::size_t before = entry->second;
      const std::string who = data.pair(row) + " at t = " + print_real(data.t[row]) + " s";
      if (data.t[row] == data.t[before])
        throw invalid(at(data, row, "t"),
                      row_text(row) + ": " + who + " repeats " + row_text(before) + "; expected each (t, tx, rx) once");
      if (data.t[row] < data.t[before])
        throw invalid(at(data, row, "t"), row_text(row) + ": time runs backwards for " + who + ", after " +
                                              print_real(data.t[before]) + " s in " + row_text(before) +
                                              "; expected rows of a pair in the order of time");
      entry->second = row;
    }
  }
}

// Finds rows in millimetres or degrees among others in metres, by values far outside the usual range.
void check_units(const Dataset& data, const std::vector<Point>& places, int axis, const std::string& column) {
  std::vector<double> sizes;
  for (const Point& p : places) sizes.push_back(std::abs(p[static_cast<std::size_t>(axis)]));
  if (sizes.empty() || std::isnan(sizes[0])) return;
  std::vector<double> sorted = sizes;
  const auto most = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), most, sorted.end());
  const double usual = std::max(*most, 1.0);  // m
  for (std::size_t row = 0; row < sizes.size(); ++row) {
    if (sizes[row] < 200 * usual) continue;
    throw invalid(at(data, row, column), row_text(row) + ": " +
                                             print_real(places[row][static_cast<std::size_t>(axis)]) +
                                             " m, while half of the rows lie within " + print_real(usual) +
                                             " m; expected one unit in the whole column (millimetres here?)");
  }
}

void note_degrees(Dataset& data, const std::vector<double>& yaw, const std::string& column) {
  if (yaw.empty()) return;
  const auto [low, high] = std::minmax_element(yaw.begin(), yaw.end());
  const bool whole = std::all_of(yaw.begin(), yaw.end(), [](double v) { return v == std::round(v); });
  const double turn = 6.283185307179586;
  if (std::max(std::abs(*low), std::abs(*high)) > 2 * turn && *high - *low <= 361 && (whole || *high - *low > 180))
    data.notes.push_back("column " + quote(column) + " goes from " + print_real(*low) + " to " + print_real(*high) +
                         " rad: are these degrees?");
}

}  // namespace

void check_readings(Dataset& data) {
  const Place whole{data.table->file()};
  if (data.rows() == 0) throw invalid(whole, "the table has no rows; expected readings");
  if (data.rows() == 1) throw invalid(whole, "the table has 1 row; one reading shows no law, expected many");
  check_rssi(data);
  check_ends(data);
  check_times(data);
  const char* const axes[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    check_units(data, data.tx_at, axis, std::string("tx_") + axes[axis]);
    check_units(data, data.rx_at, axis, std::string("rx_") + axes[axis]);
  }
  note_degrees(data, data.tx_yaw, "tx_yaw[rad]");
  note_degrees(data, data.rx_yaw, "rx_yaw[rad]");
  if (data.heard() == 0) throw invalid(whole, "every rssi is empty; expected some readings that were received");
  const double first = *std::find_if(data.rssi.begin(), data.rssi.end(), [](double v) { return !std::isnan(v); });
  if (data.heard() > 1 &&
      std::all_of(data.rssi.begin(), data.rssi.end(), [&](double v) { return std::isnan(v) || v == first; }))
    throw invalid(at(data, 0, data.reading),
                  "every rssi is " + print_real(first) + " dBm; expected readings that vary");
}

}  // namespace muster::diagnosis
