// A run's tables as channels of a log: each named row has one, each queue and each table of listed rows has one.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "kernel/simulation.hpp"
#include "mcap/sink.hpp"
#include "run_log/tables/logged_table.hpp"

namespace muster::run_log {

class CdrWriter;
class RowNames;

// Nanoseconds since the run's start, as a log has times.
std::uint64_t log_time(double seconds);

class TableLog {
 public:
  TableLog(const std::vector<RecordDeclaration>& tables, mcap::Sink& sink);

  // Call before the first tick and after each.
  void write(const Simulation& run);

 private:
  // Of a cell: a column of the table, or the name of what a listed row is about.
  struct Source {
    const Table* table = nullptr;
    std::size_t column = 0;
  };
  struct Logged {
    RecordDeclaration declared;
    const Table *own = nullptr, *names = nullptr;  // the table, and that with the names of its listed rows
    std::string columns;                           // of the table when its channels were made
    LoggedTable table;
    std::vector<Source> sources;  // a field
    bool is_plain = false;        // numbers alone: a row is copied as it stands
    std::uint16_t schema = 0;
    std::vector<int> channels;  // a row, or the first alone; -1: none yet
    std::uint32_t sequence = 0;
  };

  void declare(const Simulation& run, const TableView& view, Logged& logged);
  std::uint16_t channel(const TableView& view, Logged& logged, std::size_t row);
  void write_named(const Simulation& run, const TableView& view, Logged& logged);
  void write_listed(const Simulation& run, const TableView& view, Logged& logged);
  static std::vector<RowNames> names_of(const Simulation& run, const Logged& logged);
  static void put_fields(const Logged& logged, const std::vector<RowNames>& names, std::size_t row, CdrWriter& to);
  void send(const Simulation& run, std::uint16_t channel, std::uint32_t sequence);

  mcap::Sink& sink_;
  std::vector<Logged> tables_;
  std::map<std::string, int> types_;  // names that are given
  std::string message_;
};

}  // namespace muster::run_log
