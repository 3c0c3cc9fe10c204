// What `run` makes of a log: the log itself, the wide table, and plots of columns.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "run_log/run_log.hpp"
#include "text/temporary_folder.hpp"

namespace muster::cli {

class CommandLine;

struct LogWords {
  std::string mcap, wide;         // files
  std::vector<std::string> plot;  // "robot/*/pose/x"

  bool any() const { return !mcap.empty() || !wide.empty() || !plot.empty(); }
};

void declare(CommandLine& line, LogWords& words);

// Tables that only plots need, added to those that are recorded. Throws Error where a plot needs a folder.
void add_plotted(const LogWords& words, const std::string& out, std::vector<RecordDeclaration>& records);

class RunLogFiles {
 public:
  // Call before the first tick. Throws Error where a plot's column does not exist.
  RunLogFiles(const Simulation& run, const std::vector<RecordDeclaration>& records, const LogWords& words,
              const std::filesystem::path& out);

  // Call before the first tick and after each.
  void write(const Simulation& run) { log_->write(run); }
  // The files written.
  std::vector<std::filesystem::path> close(const Simulation& run);

  // What was left out of them.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  const LogWords& words_;
  std::filesystem::path out_;
  std::optional<TemporaryFolder> temporary_;  // of a log that only tables and plots are made of
  std::unique_ptr<run_log::RunLog> log_;
  std::vector<std::string> notes_;
};

}  // namespace muster::cli
