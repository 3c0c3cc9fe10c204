// A run as an MCAP file while it runs: the recorded tables, where robots are, the scene, events, and what the run was.
#pragma once

#include <filesystem>
#include <string>

#include "mcap/writer.hpp"
#include "run_log/run_messages.hpp"

namespace muster::run_log {

class RunLog {
 public:
  // Throws Error where the file cannot be written.
  RunLog(const Simulation& run, const std::vector<RecordDeclaration>& tables, const std::filesystem::path& file,
         const std::string& version);

  // Call before the first tick and after each.
  void write(const Simulation& run) { messages_.write(run); }
  // Completes the file, under its name; without it the file stays as FILE.part, as far as it was flushed.
  void close(const Simulation& run);

  const std::filesystem::path& file() const { return writer_.path(); }

 private:
  mcap::Writer writer_;
  RunMessages messages_;
};

}  // namespace muster::run_log
