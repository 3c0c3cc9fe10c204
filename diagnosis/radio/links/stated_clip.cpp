#include "diagnosis/radio/links/stated_clip.hpp"

#include <algorithm>
#include <limits>

#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {

bool clips(const muster_plugin& plugin, uint32_t side, bool silent) {
  const muster_clip* const clip = plugin.clip;
  return clip && clip->side == side && (clip->choice || (clip->silent != 0) == silent);
}

double clip_level(const Instance& instance) {
  const int at = instance.find_param(instance.plugin().clip->level);
  return instance.params()[static_cast<std::size_t>(at)];
}

bool is_stated(const Instance& instance) {
  return instance.declared().attribute(instance.plugin().clip->level) != nullptr;
}

namespace {

// True if the instance's level is written, or is a default at which readings end.
bool holds(const Instance& instance, const std::optional<double>& end) {
  if (is_stated(instance)) return true;
  const double level = clip_level(instance);
  return end && *end >= level && *end <= level + thresholds::reaches_a_floor;
}

}  // namespace

std::map<std::string, double> unstated_floors(const Simulation& simulation, std::optional<double> end) {
  std::map<std::string, double> result;
  for (const auto& instance : simulation.instances()) {
    if (!clips(instance->plugin(), MUSTER_BELOW, true) || holds(*instance, end)) continue;
    const muster_clip& clip = *instance->plugin().clip;
    result[instance->name() + '/' + clip.level] = instance->plugin().params[instance->find_param(clip.level)].min;
  }
  return result;
}

std::optional<double> weakest_of_some(const Eigen::VectorXd& received) {
  const auto lost = received.array().isNaN().eval();
  if (!lost.any() || lost.all()) return {};
  return lost.select(std::numeric_limits<double>::infinity(), received).minCoeff();
}

std::optional<double> silent_below(const Simulation& simulation, std::optional<double> end) {
  std::optional<double> level;
  for (const auto& instance : simulation.instances()) {
    if (!clips(instance->plugin(), MUSTER_BELOW, true) || !holds(*instance, end)) continue;
    const char* const choice = instance->plugin().clip->choice;
    if (choice && instance->params()[static_cast<std::size_t>(instance->find_param(choice))] == 0) continue;
    level = std::max(level.value_or(-std::numeric_limits<double>::infinity()), clip_level(*instance));
  }
  return level;
}

}  // namespace muster::diagnosis
