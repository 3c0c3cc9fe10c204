// Writes the extended world: a copy of the world's folder with found causes as elements and fitted values as
// attributes.
#pragma once

#include "diagnosis/result.hpp"

namespace muster::diagnosis {

// `out`: a new folder, or that of an earlier extended world; not the world's own. Returns the world file written.
// Throws Error.
std::filesystem::path write_extended_world(const Diagnosis& found, const std::filesystem::path& world,
                                           const std::filesystem::path& out);

// Copies the world's folder as it is to `out`, unless it is there. Returns the world file there. Throws Error.
std::filesystem::path copy_world(const std::filesystem::path& world, const std::filesystem::path& out);

}  // namespace muster::diagnosis
