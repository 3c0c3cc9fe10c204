// Notes of a diagnosis that was repeated with the world corrected.
#pragma once

#include <filesystem>

#include "diagnosis/result.hpp"

namespace muster::diagnosis {

// Notes of `out` on files in the folder `corrected`, which goes, give way to those of `found` on the given world: the
// first would tell the author to change what the correction has changed.
void keep_notes_of_given(const std::filesystem::path& world, const Diagnosis& found,
                         const std::filesystem::path& corrected, Diagnosis& out);

}  // namespace muster::diagnosis
