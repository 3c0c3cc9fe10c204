#include "clip_doubts.hpp"

#include <algorithm>

#include "instance_doubts.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace muster {
namespace {

// The warning of a reader's threshold; "" where it has none, where none is written, and where it has an effect.
std::string beyond(const World& world, const std::string& table, const Instance& writer, const Instance& reader) {
  const muster_clip* clip = writer.plugin().clip;
  if (!clip || clip->side != MUSTER_BELOW || clip->choice || clip->silent != 1) return "";
  const std::string level = clip->level;
  const XmlAttribute* given = reader.declared().attribute(level);
  const int own = reader.find_param(level), cut = writer.find_param(level);
  if (!given || own < 0 || cut < 0) return "";
  const muster_param& param = reader.plugin().params[own];
  const double asked = reader.params()[static_cast<std::size_t>(own)],
               least = writer.params()[static_cast<std::size_t>(cut)];
  if (param.kind != MUSTER_REAL || std::string(param.unit) != writer.plugin().params[cut].unit || !(asked < least) ||
      is_set_later(world, writer.name() + '/' + level) || is_set_later(world, reader.name() + '/' + level))
    return "";
  const std::string plugin = writer.declared().plugin, unit = std::string(" ") + param.unit,
                    wanted = level + "=\"" + print_real(asked) + '"';
  return given->value_place.text() + ": attribute " + quote(level) + ": " + print_real(asked) + unit +
         " is below the " + print_real(least) + unit + " of " + plugin + ", below which " + table +
         " has no value, so that it has no effect; expected " +
         (writer.declared().needed_by.empty() ? wanted + " of " + plugin + " (" + writer.place().text() + ')'
                                              : '<' + plugin + ' ' + wanted + "/> in the world") +
         ", or " + level + "=\"" + print_real(least) + '"';
}

}  // namespace

std::vector<std::string> beyond_clips(const std::map<std::string, Claimed>& claimed, const World& world) {
  std::vector<std::string> result;
  for (const auto& [logical, c] : claimed) {
    if (c.writers.size() != 1 || !c.modifiers.empty()) continue;  // a stage may lower what is reported
    for (const auto& by : c.readers) {
      const std::string doubt = beyond(world, logical, *c.writers[0].instance, *by.instance);
      if (!doubt.empty() && std::find(result.begin(), result.end(), doubt) == result.end()) result.push_back(doubt);
    }
  }
  return result;
}

}  // namespace muster
