#include "diagnosis/data/dataset.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <set>

#include "diagnosis/data/clock.hpp"
#include "diagnosis/data/column_doubts.hpp"
#include "diagnosis/data/dataset_checks.hpp"
#include "diagnosis/data/sent_power.hpp"
#include "diagnosis/data/thresholds.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

constexpr std::size_t most_rows = 2'000'000;  // a fit holds about 1.6 kB a row

const std::string renames = "; muster import FILE --map MAP --out FILE makes such a table of this one";

// A column that readings must have. Where it is missing, tables of others are what the user most often has.
std::size_t needed(const TextTable& table, const std::string& name, const std::string& unit) {
  try {
    return table.require(name, unit);
  } catch (const Error& error) {
    if (table.find(name)) throw;
    throw Error(error.exit(), error.place(), error.message() + renames);
  }
}

// The columns without which a table has no readings, told together where several are missing.
void require_all(const TextTable& table) {
  const bool has_distance = table.find("distance") && !table.find("tx_x") && !table.find("rx_x");
  const bool is_loss = table.find("path_loss") && !table.find("rssi");
  std::vector<TextColumn> all = {{"tx", ""}, {"rx", ""}};
  if (has_distance)
    all.push_back({"distance", "m"});
  else
    for (const char* place : {"tx_x", "tx_y", "rx_x", "rx_y"}) all.push_back({place, "m"});
  all.push_back(is_loss ? TextColumn{"path_loss", "dB"} : TextColumn{"rssi", "dBm"});
  try {
    table.require_most(all);
  } catch (const Error& error) {
    throw Error(error.exit(), error.place(), error.message() + renames);
  }
}

std::vector<double> reals_if_any(const TextTable& table, const std::string& name, const std::string& unit) {
  if (!table.find(name)) return {};
  return table.reals(table.require(name, unit));
}

std::vector<Point> places(const TextTable& table, const std::string& end) {
  const auto x = table.reals(needed(table, end + "_x", "m")), y = table.reals(needed(table, end + "_y", "m"));
  const auto z = reals_if_any(table, end + "_z", "m");
  std::vector<Point> result(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) result[i] = {x[i], y[i], z.empty() ? std::nan("") : z[i]};
  return result;
}

// True if any two values differ, over all rows.
bool varies(const std::vector<double>& values) {
  double first = std::nan("");
  for (const double v : values) {
    if (std::isnan(v)) continue;
    if (std::isnan(first)) first = v;
    if (v != first) return true;
  }
  return false;
}

// Of each reading a number of its sender and receiver.
std::vector<std::size_t> streams_of(const Dataset& data) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < data.rows(); ++i)
    result.push_back(data.tx.level[i] * data.rx.levels.size() + data.rx.level[i]);
  return result;
}

// Says why nothing depends on a column, where that is so. Below an SNR of 0 dB a level is mostly noise.
void doubt(Covariate& column, Dataset& data) {
  if (measures_reception(column.name))
    column.no_cause = "it measures what was received, as the level does, which therefore does not depend on it";
  else if (!data.t.empty() && !column.values.empty() &&
           goes_with_time(column.name, column.values, data.t, streams_of(data)))
    column.no_cause = "it counts on as time does, and what depends on time is sought there";
  if (!is_signal_to_noise(column.name) || column.values.empty()) return;
  const auto noisy = std::count_if(column.values.begin(), column.values.end(), [](double v) { return v < 0; });
  if (noisy > 0)
    data.notes.push_back("of " + std::to_string(data.rows()) + " readings " + std::to_string(noisy) +
                         (noisy == 1 ? " has a " : " have a ") + quote(column.name) +
                         " below 0: such levels are noise more than signal, and look too high");
}

void read_covariates(Dataset& data) {
  const auto is_known = [&](const std::string& name) {
    if (name == "distance") return !data.has_places();
    if (name == "rssi" || name == "path_loss") return name == data.reading;
    return reading_columns().count(name) > 0;
  };
  for (std::size_t c = 0; c < data.table->columns().size(); ++c) {
    if (is_known(data.table->columns()[c].name) || data.table->is_replaced(c)) continue;
    Covariate covariate{data.table->columns()[c].label(), {}, {}, {}};
    const bool number = data.table->is_numeric(c);
    if (number)
      covariate.values = data.table->reals(c, {.empty = true});
    else
      covariate.factor = data.table->texts(c, {.empty = true});
    if (number ? varies(covariate.values) : covariate.factor.levels.size() > 1) {
      doubt(covariate, data);
      data.covariates.push_back(std::move(covariate));
    } else {
      data.notes.push_back("column " + quote(covariate.name) + " is the same in all rows, so nothing can depend on it");
    }
  }
}

// m; a height that is unknown at either end is left out.
std::vector<double> distances_of(const Dataset& data) {
  if (!data.has_places()) return data.table->reals(data.table->require("distance", "m"));
  std::vector<double> result;
  for (std::size_t i = 0; i < data.rows(); ++i) {
    const Point &a = data.tx_at[i], &b = data.rx_at[i];
    const double up = std::isnan(a[2] - b[2]) ? 0 : a[2] - b[2];
    result.push_back(std::hypot(a[0] - b[0], a[1] - b[1], up));
  }
  return result;
}

// Refers readings to the middle of the powers in the column power[dBm] where they follow it, and notes it.
void refer_to_one_power(Dataset& data) {
  const auto power = std::find_if(data.covariates.begin(), data.covariates.end(),
                                  [](const Covariate& c) { return c.name == "power[dBm]" && !c.values.empty(); });
  if (power == data.covariates.end() || data.reading != "rssi") return;
  PoweredReadings readings{{}, distances_of(data), power->values, data.rssi};
  for (std::size_t i = 0; i < data.rows(); ++i)
    readings.link.push_back(data.tx.level[i] * data.rx.levels.size() + data.rx.level[i]);
  const auto sent = followed_power(readings);
  if (!sent) return;
  data.referred.assign(data.rows(), 0);
  for (std::size_t i = 0; i < data.rows(); ++i) {
    if (std::isfinite(power->values[i])) data.referred[i] = power->values[i] - sent->middle;
    data.rssi[i] -= data.referred[i];
  }
  data.notes.push_back("levels rise by " + print_real(std::round(100 * sent->rise) / 100) + " dB for each dB of " +
                       quote(power->name) + ": they are what was received, and are referred to a power of " +
                       print_real(sent->middle) + " dBm, the middle of those set");
}

// The first column that is a latitude or a longitude, of a table without places in metres; else none.
std::optional<std::size_t> column_of_degrees(const TextTable& table) {
  static const std::set<std::string> words = {"lat", "lon", "lng", "long", "latitude", "longitude"};
  if (table.find("tx_x") && table.find("rx_x")) return {};
  for (std::size_t c = 0; c < table.columns().size(); ++c) {
    std::string word = table.columns()[c].name;
    word.erase(0, word.rfind('_') + 1);
    std::transform(word.begin(), word.end(), word.begin(), [](unsigned char l) { return std::tolower(l); });
    if (words.count(word)) return c;
  }
  return {};
}

bool has_degrees(const TextTable& table) { return column_of_degrees(table).has_value(); }

// Refuses degrees: a plan needs metres. The user converts, since latitude and longitude are easily swapped.
void refuse_degrees(const TextTable& table) {
  if (const auto found = column_of_degrees(table)) {
    const std::size_t c = *found;
    throw invalid(
        table.header_place(c),
        "column " + quote(table.columns()[c].label()) +
            " is a place on the globe; expected metres in the world's plan: x = 111320 m * cos(lat0) * (lon - "
            "lon0) and y = 111320 m * (lat - lat0), in degrees, where (lat0, lon0) is the world's origin, as "
            "tx_x[m], tx_y[m], rx_x[m], rx_y[m]");
  }
}

// Notes distances from which no law can be told, or that are kilometres.
void note_distances(Dataset& data, const std::vector<double>& distance) {
  if (distance.empty()) return;
  const auto [low, high] = std::minmax_element(distance.begin(), distance.end());
  const std::string is_short = *high < thresholds::shortest_range ? "; are these kilometres? expected metres" : "";
  const std::string column = "column \"distance[m]\" ";
  if (*low == *high)
    data.notes.push_back(column + "is " + print_real(*low) +
                         " m in all rows, so that the exponent n cannot be told from the loss l0" + is_short);
  else if (!is_short.empty())
    data.notes.push_back(column + "goes from " + print_real(*low) + " to " + print_real(*high) + " m" + is_short);
}

// Reads places, or distances if there are none.
void read_places(Dataset& data) {
  const TextTable& table = *data.table;
  if (table.find("distance") && !table.find("tx_x") && !table.find("rx_x")) {
    const std::size_t column = table.require("distance", "m");
    const auto distance = table.reals(column);
    for (std::size_t row = 0; row < distance.size(); ++row) {
      if (!(distance[row] > 0))
        throw invalid(table.place(row, column), "row " + std::to_string(row + 1) + ": a distance of " +
                                                    print_real(distance[row]) + " m; expected more than 0 m");
    }
    data.notes.push_back("no places, only distances: nothing can be said of places, bearings and rooms");
    note_distances(data, distance);
    return;
  }
  refuse_degrees(table);
  data.tx_at = places(table, "tx");
  data.rx_at = places(table, "rx");
}

// A table of poses or commands lacks all that a reading has: one missing column would be a misleading fault.
void refuse_other_tables(const TextTable& table) {
  for (const char* column : {"tx", "rx", "rssi", "path_loss"}) {
    if (table.find(column)) return;
  }
  std::vector<std::string> names;
  for (const TextColumn& column : table.columns()) names.push_back(column.name);
  throw invalid(table.header_place(0),
                "no radio readings: the columns are " + listed(names) +
                    "; expected tx, rx and rssi[dBm], with tx_x[m], tx_y[m], rx_x[m], rx_y[m] or "
                    "distance[m] (muster import FILE --map MAP --out FILE renames columns)");
}

// A path loss is read as the level received at a transmit power of 0 dBm.
void read_readings(Dataset& data) {
  const TextTable& table = *data.table;
  const bool loss = table.find("path_loss") && !table.find("rssi");
  data.reading = loss ? "path_loss" : "rssi";
  data.rssi = table.reals(needed(table, data.reading, loss ? "dB" : "dBm"), {.empty = true});
  if (!loss) return;
  for (double& v : data.rssi) v = -v;
  data.notes.push_back("path_loss[dB] is read as the level of what was sent with 0 dBm");
}

}  // namespace

std::size_t Dataset::heard() const {
  return static_cast<std::size_t>(std::count_if(rssi.begin(), rssi.end(), [](double v) { return !std::isnan(v); }));
}

const std::map<std::string, std::string>& reading_columns() {
  static const std::map<std::string, std::string> columns = {
      {"t", "s"},          {"tx", ""},    {"rx", ""},    {"distance", "m"}, {"rssi", "dBm"},
      {"path_loss", "dB"}, {"tx_x", "m"}, {"tx_y", "m"}, {"tx_z", "m"},     {"tx_yaw", "rad"},
      {"rx_x", "m"},       {"rx_y", "m"}, {"rx_z", "m"}, {"rx_yaw", "rad"}};
  return columns;
}

Dataset read_dataset(const std::filesystem::path& file) {
  return read_dataset(std::make_shared<const TextTable>(TextTable::read(file)));
}

Dataset read_dataset(std::shared_ptr<const TextTable> read) {
  std::vector<std::string> notes;
  read = with_clock_in_seconds(std::move(read), notes);
  Dataset data{.table = std::move(read), .notes = std::move(notes)};
  const TextTable& table = *data.table;
  if (table.rows() > most_rows)
    throw invalid({table.file()}, "the table has " + std::to_string(table.rows()) + " rows; expected at most " +
                                      std::to_string(most_rows) + ": keep one row in " +
                                      std::to_string((table.rows() + most_rows - 1) / most_rows) +
                                      ", or a part of the time");
  refuse_other_tables(table);
  if (!has_degrees(table)) require_all(table);
  data.tx = table.texts(needed(table, "tx", ""));
  data.rx = table.texts(needed(table, "rx", ""));
  read_places(data);
  read_readings(data);
  data.t = reals_if_any(table, "t", "s");
  data.tx_yaw = reals_if_any(table, "tx_yaw", "rad");
  data.rx_yaw = reals_if_any(table, "rx_yaw", "rad");
  check_readings(data);
  read_covariates(data);
  refer_to_one_power(data);
  return data;
}

}  // namespace muster::diagnosis
