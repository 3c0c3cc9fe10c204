// Diagnoses a world's errors from measured readings: detects effects, names and estimates their causes.
#pragma once

#include <filesystem>

#include "diagnosis/inference/state/watch.hpp"
#include "diagnosis/result.hpp"
#include "kernel/simulation.hpp"

namespace muster::diagnosis {

// closed_loop() checks the result. `tables`: files already read. `watch`: where it says to stop, what is known so far
// is returned, marked as interrupted. Throws Error.
Diagnosis diagnose(const std::filesystem::path& world, const std::filesystem::path& data,
                   const Library::SearchPath& plugins,
                   const std::shared_ptr<TableCache>& tables = std::make_shared<TableCache>(),
                   const inference::Watch& watch = {});

}  // namespace muster::diagnosis
