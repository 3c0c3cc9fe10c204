// What was found held against its own consequences: the extended world, simulated and diagnosed again.
#pragma once

#include "diagnosis/result.hpp"
#include "kernel/simulation.hpp"

namespace muster::diagnosis {

// Writes the extended world to `out`, simulates it at the readings and diagnoses it. Throws Error.
Loop closed_loop(const Diagnosis& found, const std::filesystem::path& world, const std::filesystem::path& data,
                 const std::filesystem::path& out, const Library::SearchPath& plugins);

// The world in `extended` on `data`, beside the world as given. Throws Error.
SecondLook second_look(const std::filesystem::path& world, const std::filesystem::path& extended,
                       const std::filesystem::path& data, const Library::SearchPath& plugins);

}  // namespace muster::diagnosis
