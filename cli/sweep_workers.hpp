// Work that several processes share. A plugin that crashes ends one of them, and none outlives the one that made them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "sweep/job_table.hpp"
#include "text/error.hpp"

namespace muster::cli {

// Calls `work` in so many child processes, and `meanwhile` now and then until all have ended. An error of `work` is
// told by its child. Returns the first exit code that is not done; a child that a signal ended is warned of, and counts
// as done: what it left is left in the table. An
// interrupt is passed on to them. Call it before anything makes a thread.
Exit in_processes(int count, const std::function<Exit()>& work, const std::function<void()>& meanwhile = {});

// The same, for work on the table of jobs in that folder; shows how many of the share are done: "muster sweep office: 3
// of 20 runs".
Exit work_on_table(const std::filesystem::path& folder, const sweep::Share& share, int count, const std::string& what,
                   const std::string& unit, const std::function<Exit()>& work);

}  // namespace muster::cli
