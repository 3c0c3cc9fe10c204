// What a world gets wrong about measured readings: found, named where it can be, written into an extended world, and
// checked by simulating that world and looking again.
#pragma once

#include <filesystem>

#include "diagnosis/result.hpp"
#include "kernel/simulation.hpp"

namespace muster::diagnosis {

// One look. Throws Error.
Diagnosis diagnose(const std::filesystem::path& world, const std::filesystem::path& data,
                   const Library::SearchPath& plugins,
                   const std::shared_ptr<TableCache>& tables = std::make_shared<TableCache>());

}  // namespace muster::diagnosis
