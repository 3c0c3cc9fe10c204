#include "recording.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "foreign_messages.hpp"
#include "mcap/scan.hpp"
#include "run_log/tables/logged_table.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/text_table.hpp"

namespace muster::devices {
namespace {

using ports::Port;
using run_log::Field;
using run_log::LoggedTable;
using run_log::table_of;
using run_log::with_names;

// "robot/burger/odometry" by the name that the log has for the robot, or the topic that stands for it there.
std::string logged_name(const Port& port, const std::string& robot, const Topics& topics) {
  for (const auto& [table, topic] : topics) {
    if (table == port.general || table == port.table) return topic;
  }
  const auto mark = port.general.find("{robot}");
  return mark == std::string::npos ? port.general
                                   : port.general.substr(0, mark) + robot + port.general.substr(mark + 7);
}

// The row of that name in this world, null() where there is none.
double row_of(const muster_host* host, const std::string& set, std::string_view name) {
  for (uint32_t row = 0; row < host->rows(host, set.c_str()); ++row) {
    if (host->row_name(host, set.c_str(), row) == name) return row;
  }
  return null();
}

// A port that takes samples of its table.
struct Taker {
  const muster_host* host;
  const Port* port;
  std::string name, robot;  // of the table and of the robot, in the log
  Track track;

  bool is_owner(std::size_t column) const { return column == 0 && port->has_one_owner; }

  // The field of each column; throws BadInput where the log has the table otherwise.
  std::vector<std::size_t> fields_of(const LoggedTable& table) const {
    std::vector<std::size_t> result;
    for (const auto& column : port->columns) {
      const auto found = std::find_if(table.fields.begin(), table.fields.end(),
                                      [&](const Field& f) { return f.name == column.name && f.unit == column.unit; });
      if (found == table.fields.end()) {
        std::vector<std::string> names;
        for (const Field& field : table.fields) names.push_back(field.title());
        throw BadInput("has no " + quote(column.title()) + " in " + name + "; " + suggest(column.title(), names));
      }
      result.push_back(static_cast<std::size_t>(found - table.fields.begin()));
    }
    return result;
  }

  void take(std::int64_t time, const std::vector<run_log::FieldValue>& values, const LoggedTable& table,
            const std::vector<std::size_t>& fields) {
    const auto& columns = port->columns;
    std::vector<double> row(columns.size(), 0);
    std::vector<std::string> texts;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const run_log::FieldValue& value = values[fields[c]];
      const bool is_text = table.fields[fields[c]].kind == Field::Kind::text;
      if (columns[c].bytes) {
        texts.emplace_back(value.text);
      } else if (is_owner(c)) {
        if (is_text && value.text != robot) return;  // another robot's message
      } else if (is_text) {
        row[c] = value.text == robot ? row_of(host, columns[c].reference, own_name())
                                     : row_of(host, columns[c].reference, value.text);
        if (is_null(row[c]) && !(value.text.empty() && columns[c].nullable)) {
          ++track.strangers;
          return;
        }
      } else {
        row[c] = std::isnan(value.real) ? null() : value.real;
        check(columns[c], row[c]);
      }
    }
    if (!track.times.empty() && time < track.times.back())
      throw BadInput("time runs backwards in " + name + "; expected a log in the order of its times");
    track.times.push_back(time);
    track.cells.insert(track.cells.end(), row.begin(), row.end());
    for (auto& text : texts) track.bytes.push_back(std::move(text));
  }

  void check(const ports::PortColumn& column, double value) const {
    if ((std::isnan(value) && !column.nullable) || (std::isinf(value) && !column.infinite))
      throw BadInput((std::isnan(value) ? "NaN as " : "an infinite number as ") + column.title() + " of " + name +
                     "; expected a number");
  }

  std::string own_name() const {
    const auto first = port->table.find('/'), last = port->table.rfind('/');
    return port->table.substr(first + 1, last - first - 1);
  }
};

class Reader : public mcap::Visitor {
 public:
  Reader(std::vector<Taker>& takers, double begin) : takers_(takers), begin_(nanoseconds(begin)) {}

  void header(const mcap::Header& header) override { is_of_a_run_ = header.library.starts_with("muster "); }
  void schema(const mcap::Schema& schema) override { schemas_[schema.id] = schema; }
  void channel(const mcap::Channel& channel) override {
    Source& source = sources_[channel.id] = {};
    source.table = table_of(channel, schemas_[channel.schema]);
    if (!source.table) source.foreign = foreign_message(schemas_[channel.schema].name);
    if (source.foreign) source.table = LoggedTable{"", "", run_log::Layout::message, source.foreign->fields};
    if (!source.table) return;
    const LoggedTable& table = *source.table;
    const bool is_queue = table.layout == run_log::Layout::message && !source.foreign;
    const std::string full = source.foreign ? channel.topic
                             : is_queue     ? table.table
                                            : with_names(table.table, table.row);
    for (std::size_t t = 0; t < takers_.size(); ++t) {
      const Taker& taker = takers_[t];
      const std::string name = is_queue ? with_names(table.table, taker.robot) : full;
      if (name != taker.name) continue;
      source.takers.push_back(t);
      source.fields.push_back(taker.fields_of(table));
    }
    seen.push_back(full);
  }
  void message(const mcap::Message& message, const std::string&) override {
    const auto time = static_cast<std::int64_t>(message.log_time);
    if (!start_) start_ = is_of_a_run_ ? 0 : time;
    Source& source = sources_[message.channel];
    if (source.takers.empty()) return;
    const std::int64_t world = time - *start_ - begin_;
    std::string storage;
    const auto values = source.foreign ? source.foreign->values(message.data, static_cast<double>(world) / 1e9,
                                                                static_cast<double>(source.count++), storage)
                                       : values_of(*source.table, message.data);
    for (std::size_t i = 0; i < source.takers.size(); ++i)
      takers_[source.takers[i]].take(world, values, *source.table, source.fields[i]);
  }

  std::vector<std::string> seen;

 private:
  struct Source {
    std::optional<LoggedTable> table;
    const ForeignMessage* foreign = nullptr;
    std::vector<std::size_t> takers;
    std::vector<std::vector<std::size_t>> fields;  // a taker
    std::uint64_t count = 0;
  };
  std::vector<Taker>& takers_;
  std::int64_t begin_;
  std::optional<std::int64_t> start_;
  bool is_of_a_run_ = false;
  std::map<std::uint16_t, mcap::Schema> schemas_;
  std::map<std::uint16_t, Source> sources_;
};

void read_csv(const std::filesystem::path& file, std::vector<Taker>& takers, double begin) {
  const TextTable table = TextTable::read(file);
  const std::vector<double> times = table.reals(table.require("t", "s"));
  const std::int64_t start = nanoseconds(begin);
  for (Taker& taker : takers) {
    if (taker.port->is_queue)
      throw BadInput("is a CSV file, which has no " + taker.name + ": messages have bytes; expected the MCAP file of " +
                     "that run");
    std::vector<std::size_t> places;
    std::vector<std::vector<double>> columns;
    for (const auto& column : taker.port->columns) {
      places.push_back(table.require(taker.name + '/' + column.name, column.unit));
      columns.push_back(table.reals(places.back(), {true, column.infinite}));
    }
    for (std::size_t r = 0; r < times.size(); ++r) {
      const auto is_given = [&](const auto& values) { return !std::isnan(values[r]); };
      if (std::none_of(columns.begin(), columns.end(), is_given)) continue;  // not recorded at that time
      Track& track = taker.track;
      track.times.push_back(nanoseconds(times[r]) - start);
      if (track.times.size() > 1 && track.times.back() < track.times[track.times.size() - 2])
        throw invalid(table.place(r, table.require("t", "s")), "time runs backwards; expected rows in order");
      for (std::size_t c = 0; c < columns.size(); ++c) {
        if (std::isnan(columns[c][r]) && !taker.port->columns[c].nullable)
          throw invalid(table.place(r, places[c]), "an empty cell; expected a number, as others of this sample have");
        track.cells.push_back(std::isnan(columns[c][r]) ? null() : columns[c][r]);
      }
    }
  }
}

void read_mcap(const std::filesystem::path& file, std::vector<Taker>& takers, double begin) {
  Reader reader(takers, begin);
  mcap::scan(file, reader, mcap::Damage::refused);
  for (const Taker& taker : takers) {
    const auto queue = taker.port->is_queue ? taker.name.substr(0, taker.name.find('/')) + "/*/message" : taker.name;
    const bool is_there = std::find(reader.seen.begin(), reader.seen.end(), taker.name) != reader.seen.end() ||
                          std::find(reader.seen.begin(), reader.seen.end(), queue) != reader.seen.end() ||
                          !taker.track.times.empty();
    if (!is_there) throw BadInput("has no " + taker.name + "; " + suggest(taker.name, reader.seen));
  }
}

}  // namespace

std::int64_t nanoseconds(double seconds) { return std::llround(seconds * 1e9); }

std::size_t Track::until(std::int64_t time) const {
  return static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
}

std::vector<Track> recording(const muster_host* host, const std::vector<Port>& ports, const Source& source) {
  std::vector<Taker> takers;
  for (const Port& port : ports) {
    const std::string name = logged_name(port, source.robot, source.topics);
    takers.push_back({host, &port, name, source.robot, {}});
  }
  const std::string file = source.file.string();
  try {
    if (!std::filesystem::exists(source.file))
      throw BadInput("is not there; expected an MCAP file of `muster run --mcap`, or a CSV file of `--wide`");
    if (source.file.extension() == ".csv")
      read_csv(source.file, takers, source.begin);
    else
      read_mcap(source.file, takers, source.begin);
  } catch (const Error& error) {
    throw BadInput(error.what());
  } catch (const mcap::Malformed& fault) {
    throw BadInput("file " + quote(file) + " has a message that is none: " + fault.what());
  } catch (const BadInput& fault) {
    throw BadInput("file " + quote(file) + ' ' + fault.what());
  }
  std::vector<Track> result;
  for (Taker& taker : takers) result.push_back(std::move(taker.track));
  return result;
}

}  // namespace muster::devices
