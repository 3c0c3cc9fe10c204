// Work that several processes share. A plugin that crashes ends one of them, and none outlives the one that made them.
#pragma once

#include <functional>
#include <string>

#include "text/error.hpp"

namespace muster::cli {

// Calls `work` in so many child processes, and `meanwhile` now and then until all have ended. An error of `work` is
// told by its child. Returns the first exit code that is not done; a child that a signal ended is warned of, and counts
// as done: what it left is left in the table. An
// interrupt is passed on to them. Call it before anything makes a thread.
Exit in_processes(int count, const std::function<Exit()>& work, const std::function<void()>& meanwhile = {});

}  // namespace muster::cli
