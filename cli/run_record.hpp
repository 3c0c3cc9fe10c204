// The record of a run: its tables, run.json beside them, and the page that shows both.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "folder_lock.hpp"
#include "kernel/record.hpp"
#include "text/json.hpp"
#include "viewer/record_folder.hpp"
#include "viewer/run_scene.hpp"

namespace muster::cli {

class RunRecord {
 public:
  // Call before the first tick.
  RunRecord(const Simulation& run, const std::vector<RecordDeclaration>& tables, const std::filesystem::path& folder,
            const Library::SearchPath& plugins);

  // Call before the first tick and after each.
  // What was recorded is on the disk a second later, so that a run which is killed leaves it.
  void write(const Simulation& run);
  // What was recorded up to now, or all of it after close(), for a page that is shown during the run.
  viewer::RecordFolder so_far(const Simulation& run, Json outcome);
  // The tables and run.json, in which `outcome` is what is known of the run; the files written.
  std::vector<std::filesystem::path> close(const Simulation& run, Json outcome);
  // run.html. Empty, with the reason in `why_not`, where no table was recorded, tables are too long, or the build has
  // no page.
  std::filesystem::path write_page(std::string& why_not) const;

 private:
  std::vector<viewer::RecordedTable> listed(const Simulation& run) const;
  void complete(const Simulation& run, Json& outcome);

  double start_;  // s: later than 0 in a run that goes on from a state
  std::filesystem::path folder_;
  FolderLock lock_;
  std::chrono::steady_clock::time_point flushed_ = std::chrono::steady_clock::now();
  Recorder recorder_;
  viewer::RunScene scene_;
  std::vector<std::filesystem::path> tables_;
  std::vector<viewer::RecordedTable> listed_;  // as they were at the start: a plugin may take its table with it
  std::vector<viewer::RecordedTable> closed_;
};

}  // namespace muster::cli
