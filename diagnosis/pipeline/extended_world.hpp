// A world's folder copied, with found causes as elements and fitted values as attributes.
#pragma once

#include "diagnosis/result.hpp"

namespace muster::diagnosis {

// `out` must not exist or be an extended world itself. Returns the world file written. Throws Error.
std::filesystem::path write_extended_world(const Diagnosis& found, const std::filesystem::path& world,
                                           const std::filesystem::path& out);

}  // namespace muster::diagnosis
