// What the world's own plugins clip.
#pragma once

#include <optional>

#include "kernel/simulation.hpp"

namespace muster::diagnosis {

// True if a plugin acts on this side (MUSTER_BELOW, MUSTER_ABOVE), and what lies beyond is lost (`silent`) or piles up.
bool clips(const muster_plugin& plugin, uint32_t side, bool silent);
// Level at which an instance of such a plugin clips, dBm.
double clip_level(const Instance& instance);
// Level below which an instance of this world lets nothing through, dBm.
std::optional<double> silent_below(const Simulation& simulation);

}  // namespace muster::diagnosis
