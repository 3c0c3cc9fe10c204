// Causes without a level shift: random laws other than the world's.
#pragma once

#include "diagnosis/radio/laws/law_sources.hpp"

namespace muster::diagnosis {

// Adds to the causes of `found`, and to its lists of tested and untestable ones.
void add_laws(const LawSources& sources, Diagnosis& found);

}  // namespace muster::diagnosis
