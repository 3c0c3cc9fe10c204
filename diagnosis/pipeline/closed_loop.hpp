// Closed-loop check of a diagnosis: simulates the extended world and diagnoses it again.
#pragma once

#include "diagnosis/inference/state/watch.hpp"
#include "diagnosis/result.hpp"
#include "kernel/simulation.hpp"

namespace muster::diagnosis {

// Writes the extended world to `out`, simulates it at the readings and diagnoses it. Nothing but the written world if
// `watch` says to stop. Throws Error.
std::optional<Loop> closed_loop(const Diagnosis& found, const std::filesystem::path& world,
                                const std::filesystem::path& data, const std::filesystem::path& out,
                                const Library::SearchPath& plugins, const inference::Watch& watch = {});

// Errors of the extended world and of the refitted given one on further readings, and a diagnosis of the extended world
// there. Nothing if `watch` says to stop. Throws Error.
std::optional<SecondLook> second_look(const std::filesystem::path& world, const std::filesystem::path& extended,
                                      const std::filesystem::path& data, const Library::SearchPath& plugins,
                                      const inference::Watch& watch = {});

}  // namespace muster::diagnosis
