// What the world's own plugins clip.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>

#include "kernel/simulation.hpp"

namespace muster::diagnosis {

// True if a plugin acts on this side (MUSTER_BELOW, MUSTER_ABOVE), and what lies beyond is lost (`silent`) or piles up.
bool clips(const muster_plugin& plugin, uint32_t side, bool silent);
// Level at which an instance of such a plugin clips, dBm.
double clip_level(const Instance& instance);
// True if the world writes that level, which is no default then.
bool is_stated(const Instance& instance);
// The weakest of the levels that were received [dBm, NaN: lost], where some were lost.
std::optional<double> weakest_of_some(const Eigen::VectorXd& received);
// Level that the world writes, dBm, below which an instance of it lets nothing through. A default is no statement,
// except where readings end at it (`end`, dBm).
std::optional<double> silent_below(const Simulation& simulation, std::optional<double> end);
// Paths of the levels of other such instances, with the lowest that each may be.
std::map<std::string, double> unstated_floors(const Simulation& simulation, std::optional<double> end);

}  // namespace muster::diagnosis
