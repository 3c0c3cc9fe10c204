#include "diagnosis/data/dataset_checks.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <tuple>
#include <unordered_map>

#include "diagnosis/data/clock.hpp"
#include "diagnosis/data/thresholds.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/table_doubts.hpp"

namespace muster::diagnosis {
namespace {

constexpr double marks[] = {0, -127, -128};  // dBm; of drivers, and of 8-bit registers, without a measurement

std::string row_text(std::size_t row) { return "row " + std::to_string(row + 1); }

// Rows count from 1, below the header: row r is on line r + 1.
Place at(const Dataset& data, std::size_t row, const std::string& column) {
  return data.table->place(row, data.table->find(column).value());
}

// What levels above 0 may be, where all that are heard look like it: an unsigned byte, or per cent.
std::string other_scale(const Dataset& data) {
  double low = 1e300, high = -1e300;
  for (const double v : data.rssi) {
    if (std::isnan(v)) continue;
    if (v != std::round(v)) return "";
    low = std::min(low, v), high = std::max(high, v);
  }
  if (low >= 128 && high <= 255)
    return "; whole numbers from 128 to 255 are an unsigned byte: rssi[dBm] = 1*COLUMN - 256";
  if (low >= 0 && high <= 100 && high > low)
    return "; a quality in per cent is no level: where it is Windows', rssi[dBm] = 0.5*COLUMN - 100 is about it";
  return "";
}

// Throws Error if most levels are above 0 dBm: milliwatts, or a lost sign.
void check_scale(const Dataset& data) {
  const auto is_above = [](double v) { return v > 0; };
  if (2 * std::count_if(data.rssi.begin(), data.rssi.end(), is_above) <= static_cast<std::ptrdiff_t>(data.heard()))
    return;
  const auto row =
      static_cast<std::size_t>(std::find_if(data.rssi.begin(), data.rssi.end(), is_above) - data.rssi.begin());
  const Place place = at(data, row, data.reading);
  const double v = data.rssi[row];
  if (data.reading == "path_loss")
    throw invalid(place, row_text(row) + ": a path loss of " + print_real(-v) +
                             " dB, and most are negative; expected losses, which are positive (a map of muster import: "
                             "path_loss[dB] = -1*COLUMN)");
  throw invalid(place,
                row_text(row) + ": " + print_real(v) +
                    " dBm, and most readings are above 0 dBm, as milliwatts or levels without their sign are; "
                    "expected dBm, 10 log10 of milliwatts (a map of muster import: rssi[dBm] = 10*log10(COLUMN), "
                    "or rssi[dBm] = -1*COLUMN)" +
                    other_scale(data));
}

// Empties readings at a mark that stands apart from all other levels.
void take_marks(Dataset& data) {
  for (const double mark : marks) {
    if (mark != 0 && data.reading == "path_loss") continue;  // 128 dB is a loss as good as any
    double nearest = 1e300;
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < data.rows(); ++row) {
      const double v = data.rssi[row];
      if (v == mark)
        rows.push_back(row);
      else if (!std::isnan(v))
        nearest = std::min(nearest, std::abs(v - mark));
    }
    if (rows.empty() || nearest < thresholds::mark_apart) continue;
    if (mark == -127 && rows.size() < 2) continue;  // one alone may be a fade
    for (const std::size_t row : rows) data.rssi[row] = std::nan("");
    data.marks.push_back(std::to_string(rows.size()) + " at " + print_real(mark) + " dBm");
    const std::string why =
        nearest < 1e300 ? "; the nearest other level is " + print_real(std::round(100 * nearest) / 100) + " dB away"
                        : "";
    data.notes.push_back(data.marks.back() + ", first in " + row_text(rows[0]) +
                         ": taken as a mark for nothing received" + why);
  }
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
    // One value in several rows is what a program writes where there is none.
    const auto mark = [&](bool one_is_enough) {
      const auto alike = std::count(data.rssi.begin(), data.rssi.end(), v);
      const std::string text = print_real(data.reading == "path_loss" ? -v : v);
      if (alike < 2 && !one_is_enough) return std::string();
      return "; " + (alike < 2 ? std::string() : std::to_string(alike) + " rows have it: ") + "is " + text +
             " a mark for nothing received? then leave " + (alike < 2 ? "the cell" : "these cells") +
             " empty (in a map of muster import: none " + data.reading + " = " + text + ")";
    };
    if (v > thresholds::strongest_level)
      throw refuse("is over +30 dBm; expected a level in dBm, which is mostly negative" + mark(false));
    if (v < thresholds::weakest_level) throw refuse("is below thermal noise; expected a level in dBm" + mark(true));
  }
}

// Few levels far above all others: a lost sign, or a digit too few.
void note_lone_levels(Dataset& data) {
  std::vector<double> levels;
  std::copy_if(data.rssi.begin(), data.rssi.end(), std::back_inserter(levels), [](double v) { return !std::isnan(v); });
  std::sort(levels.begin(), levels.end(), std::greater<>());
  const auto share = static_cast<std::size_t>(thresholds::lone_share * static_cast<double>(levels.size()));
  for (std::size_t few = 1; few <= std::min(share, thresholds::most_outliers); ++few) {
    if (levels[few - 1] - levels[few] < thresholds::outlier_gap) continue;
    const auto row = std::find_if(data.rssi.begin(), data.rssi.end(), [&](double v) { return v >= levels[few - 1]; });
    const bool is_loss = data.reading == "path_loss";
    const std::string gap = print_real(std::round(levels[few - 1] - levels[few]));
    data.notes.push_back(at(data, static_cast<std::size_t>(row - data.rssi.begin()), data.reading).text() + ": " +
                         (is_loss ? print_real(-*row) + " dB" : print_real(*row) + " dBm") +
                         (few > 1 ? ", as " + std::to_string(few - 1) + " more," : "") + " lies " + gap +
                         (is_loss ? " dB below all other losses" : " dB above all other levels") +
                         (*row > 0 ? "; is a minus missing?" : "; is a digit missing?") +
                         " Where it is no reading, leave the cell empty");
    return;
  }
}

void check_ends(const Dataset& data) {
  for (std::size_t row = 0; row < data.rows(); ++row) {
    if (data.tx.levels[data.tx.level[row]] == data.rx.levels[data.rx.level[row]])
      throw invalid(at(data, row, "rx"), row_text(row) + ": " + quote(data.rx.levels[data.rx.level[row]]) +
                                             " hears itself; expected two radios");
  }
}

void find_wild_stamps(Dataset& data) {
  data.wild = wild_stamps(data.t);
  for (const std::size_t row : data.wild)
    data.notes.push_back(row_text(row) + ": t = " + print_real(data.t[row]) +
                         " s lies far outside all other times; the row is left out of all tests in time");
}

// True if the rows from `row` on repeat those from the first on, as where a log is joined to itself.
bool is_joined_to_itself(const Dataset& data, std::size_t row) {
  if (row < 2 || data.rows() < row + 2) return false;
  for (std::size_t k = 0; k < row && row + k < data.rows(); ++k) {
    const double a = data.rssi[k], b = data.rssi[row + k];
    if (data.t[k] != data.t[row + k] || data.pair(k) != data.pair(row + k) ||
        !(a == b || (std::isnan(a) && std::isnan(b))))
      return false;
  }
  return true;
}

// Throws Error where the times say that the table is no log: one time for all rows, or the same rows again.
void refuse_copies(const Dataset& data, std::size_t row) {
  if (std::all_of(data.t.begin(), data.t.end(), [&](double t) { return t == data.t[0]; }))
    throw invalid(at(data, 0, "t"), "t is " + print_real(data.t[0]) +
                                        " s in all rows; expected the time of each reading, or no column t[s]");
  if (is_joined_to_itself(data, row))
    throw invalid(at(data, row, "t"),
                  "rows " + std::to_string(row + 1) + " to " + std::to_string(std::min(2 * row, data.rows())) +
                      " repeat rows 1 and following: the log is joined to itself; expected it once");
}

// True if one end of the link has moved between two rows: they are two readings, though the clock tells one time.
bool moved_between(const Dataset& data, std::size_t before, std::size_t row) {
  const auto differ = [&](const std::vector<Point>& places) {
    if (places.empty()) return false;
    const Point &a = places[before], &b = places[row];
    return !std::equal(a.begin(), a.end(), b.begin(),
                       [](double one, double other) { return one == other || (std::isnan(one) && std::isnan(other)); });
  };
  return differ(data.tx_at) || differ(data.rx_at);
}

// One pass in file order finds both faults: time of a pair may repeat only if (t, tx, rx) does not, or if it has moved.
void check_times(const Dataset& data) {
  if (data.t.empty()) return;
  std::unordered_map<std::uint64_t, std::size_t> last;
  for (std::size_t row = 0; row < data.rows(); ++row) {
    if (data.is_wild(row)) continue;
    const std::uint64_t pair = (std::uint64_t{data.tx.level[row]} << 32) | data.rx.level[row];
    const auto [entry, is_first] = last.emplace(pair, row);
    if (!is_first) {
      const std::size_t before = entry->second;
      if (data.t[row] <= data.t[before]) refuse_copies(data, row);
      const std::string who = data.pair(row) + " at t = " + print_real(data.t[row]) + " s";
      if (data.t[row] == data.t[before] && !moved_between(data, before, row))
        throw invalid(at(data, row, "t"),
                      row_text(row) + ": " + who + " repeats " + row_text(before) + "; expected each (t, tx, rx) once");
      if (data.t[row] < data.t[before])
        throw invalid(
            at(data, row, "t"),
            row_text(row) + ": time runs backwards for " + who + ", after " + print_real(data.t[before]) + " s in " +
                row_text(before) + "; expected rows of a pair in the order of time" +
                (data.t[row] <= data.t[0] ? ": are these two runs in one table? expected a table each, or " +
                                                ("the times of the second later: " + print_real(data.t[row])) +
                                                " s as more than " + print_real(data.t[before]) + " s"
                                          : ""));
      entry->second = row;
    }
  }
}

// A radio's values along one axis, for the check of units.
struct Coordinates {
  std::vector<double> values;
  std::vector<std::size_t> rows;
};

// Finds rows in millimetres among others of the same radio in metres: far outside, nothing between, and among the
// others if divided by 1000. Radios may stand any distance apart.
void check_units(const Dataset& data, const Factor& radio, const std::vector<Point>& places, std::size_t axis,
                 const std::string& column) {
  if (places.empty() || std::isnan(places[0][axis])) return;
  std::vector<Coordinates> of_radio(radio.levels.size());
  for (std::size_t row = 0; row < places.size(); ++row) {
    of_radio[radio.level[row]].values.push_back(places[row][axis]);
    of_radio[radio.level[row]].rows.push_back(row);
  }
  for (const auto& [values, rows] : of_radio) {
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    if (sorted.empty()) continue;
    const double usual = std::max(std::abs(sorted[sorted.size() / 2]), 1.0);  // m
    const auto far = std::find_if(sorted.begin(), sorted.end(),
                                  [&](double v) { return std::abs(v) >= thresholds::other_unit * usual; });
    if (far == sorted.begin() || far == sorted.end()) continue;
    if (std::abs(*far) < thresholds::unit_gap * std::max(std::abs(*(far - 1)), 1.0)) continue;  // the radio went there
    const auto [low, high] = std::minmax_element(sorted.begin(), far);
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (std::abs(values[k]) < std::abs(*far) || values[k] / 1000 < *low - 1 || values[k] / 1000 > *high + 1) continue;
      throw invalid(
          at(data, rows[k], column),
          row_text(rows[k]) + ": " + print_real(values[k]) + " m, while half of the rows lie within " +
              print_real(usual) + " m; expected " +
              (is_mark(values[k]) ? "a place in each row: where this is a mark for no value, the table without the row"
                                  : "one unit in the whole column (millimetres here?)"));
    }
  }
}

void note_degrees(Dataset& data, const std::vector<double>& yaw, const std::string& column) {
  if (yaw.empty()) return;
  const auto [low, high] = std::minmax_element(yaw.begin(), yaw.end());
  const bool whole = std::all_of(yaw.begin(), yaw.end(), [](double v) { return v == std::round(v); });
  const double turn = 6.283185307179586;
  if (std::max(std::abs(*low), std::abs(*high)) > 2 * turn && *high - *low <= 361 && (whole || *high - *low > 180))
    data.notes.push_back("column " + quote(column) + " goes from " + print_real(*low) + " to " + print_real(*high) +
                         " rad: are these degrees? expected radians (a map of muster import: " + column +
                         " = 0.017453292519943295*COLUMN)");
}

}  // namespace

void check_readings(Dataset& data) {
  const Place whole{data.table->file()};
  if (data.rows() == 0) throw invalid(whole, "the table has no rows; expected readings");
  if (data.rows() == 1) throw invalid(whole, "the table has 1 row; one reading shows no law, expected many");
  check_scale(data);
  take_marks(data);
  check_rssi(data);
  note_lone_levels(data);
  check_ends(data);
  find_wild_stamps(data);
  check_times(data);
  const char* const axes[] = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    check_units(data, data.tx, data.tx_at, axis, std::string("tx_") + axes[axis]);
    check_units(data, data.rx, data.rx_at, axis, std::string("rx_") + axes[axis]);
  }
  note_degrees(data, data.tx_yaw, "tx_yaw[rad]");
  note_degrees(data, data.rx_yaw, "rx_yaw[rad]");
  if (data.heard() == 0)
    throw invalid(whole, "every rssi is empty" +
                             (data.marks.empty() ? "" : " or a mark for nothing received (" + data.marks[0] + ")") +
                             "; expected some readings that were received");
  const double first = *std::find_if(data.rssi.begin(), data.rssi.end(), [](double v) { return !std::isnan(v); });
  if (data.heard() > 1 &&
      std::all_of(data.rssi.begin(), data.rssi.end(), [&](double v) { return std::isnan(v) || v == first; }))
    throw invalid(at(data, 0, data.reading),
                  "every rssi is " + print_real(first) + " dBm; expected readings that vary");
}

}  // namespace muster::diagnosis
