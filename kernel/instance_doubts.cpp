#include "instance_doubts.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "needed_attribute.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace muster {
namespace {

constexpr double plainly = 10;     // times beyond what is sensible
constexpr double rounding = 1e-9;  // of a period that is meant to be one tick

// Attributes of which the first is at most the second; "min_" and "max_" stand before the name of what they bound.
constexpr std::pair<std::string_view, std::string_view> orders[] = {
    {"min_", "max_"}, {"slowest", "fastest"}, {"least", "most"}, {"start", "until"}};

std::string with_unit(double value, const muster_param& declared) {
  return print_real(value) + (*declared.unit ? ' ' + std::string(declared.unit) : "");
}

void check_order(const muster_plugin& plugin, const std::vector<double>& values, const InstanceDeclaration& declared,
                 const std::string& low, const std::string& high) {
  const int lower = find_param(plugin, low), upper = find_param(plugin, high);
  if (lower < 0 || upper < 0) return;
  const muster_param &first = plugin.params[lower], &second = plugin.params[upper];
  const double least = values[static_cast<std::size_t>(lower)], most = values[static_cast<std::size_t>(upper)];
  if (std::string_view(first.unit) != second.unit || !(least > most)) return;
  const XmlAttribute *at_first = declared.attribute(low), *at_second = declared.attribute(high);
  const XmlAttribute& at = at_first ? *at_first : *at_second;
  throw invalid(at.value_place, "attribute " + quote(at.name) + ": " + low + "=\"" + print_real(least) +
                                    "\" is above " + high + "=\"" + print_real(most) + '"' +
                                    (at_first && at_second ? "" : ", one of them by default") + "; expected " + low +
                                    " to be at most " + high);
}

// Of a time or a rate against the ticks and the length of the run; "" where there is nothing to say.
// Pulses of a jammer are no matter of ticks: what is of the radio is left out there.
std::string of_time(uint32_t phase, const muster_param& declared, double value, double tick, double until) {
  const std::string_view name = declared.name, unit = declared.unit;
  if (declared.flags & MUSTER_FREE || !(value > 0)) return "";
  if (name == "period" && unit == "s" && until > 0 && value >= plainly * until)
    return with_unit(value, declared) + " is " + print_real(std::round(value / until)) + " times the run of " +
           print_real(until) + " s, so that nothing comes twice; are these milliseconds? expected period=\"" +
           print_real(value / 1000) + '"';
  if (name == "period" && unit == "s" && phase != MUSTER_RADIO && value < tick * (1 - rounding))
    return with_unit(value, declared) + " is less than a tick of " + print_real(tick) +
           " s, so that it is taken for one tick; expected period=\"" + print_real(tick) + "\", or dt=\"" +
           print_real(value) + '"';
  if (name == "rate" && unit == "Hz" && value * tick > 1 + rounding)
    return with_unit(value, declared) + " is above the rate of the ticks, " + print_real(1 / tick) +
           " Hz, and there is one reading a tick; expected dt=\"" + print_real(1 / value) + "\", or a lower rate";
  return "";
}

// Of a controller's limit of 0, at which it does nothing; "" of other parameters.
std::string never_moves(const muster_param& declared) {
  const std::string_view name = declared.name, unit = declared.unit;
  const std::string zero = "0 " + std::string(unit);
  if (name == "speed" && unit == "m/s") return zero + ": the robot never moves; expected a speed above 0";
  if ((name == "turn_speed" && unit == "rad/s") || (name == "turn_gain" && unit == "1/s"))
    return zero + ": the robot never turns to where it is to go; expected a number above 0";
  return "";
}

// Warns once for each condition that does not hold, at the first attribute that counts only with it.
void warn_of_idle(const muster_plugin& plugin, const std::vector<double>& values, const InstanceDeclaration& declared,
                  const World& world, const Warn& warn) {
  std::vector<std::pair<std::string, std::vector<const XmlAttribute*>>> idle;
  for (const auto& given : declared.attributes) {
    const std::string condition = condition_in(plugin.params[find_param(plugin, given.name)].help);
    if (condition.empty()) continue;
    const Needed needed(condition, plugin);
    if (needed.holds(plugin, values, declared) || is_set_later(world, declared.name + '/' + needed.name())) continue;
    const auto found =
        std::find_if(idle.begin(), idle.end(), [&](const auto& each) { return each.first == condition; });
    if (found == idle.end()) {
      idle.emplace_back(condition, std::vector<const XmlAttribute*>{&given});
    } else {
      found->second.push_back(&given);
    }
  }
  for (const auto& [condition, attributes] : idle) {
    const Needed needed(condition, plugin);
    std::string others, all = attributes[0]->name;
    for (std::size_t i = 1; i < attributes.size(); ++i) {
      others += (i == 1 ? ", nor has " : i + 1 < attributes.size() ? ", " : " or ") + quote(attributes[i]->name);
      all += (i + 1 < attributes.size() ? ", " : " and ") + attributes[i]->name;
    }
    warn(attributes[0]->value_place, "attribute " + quote(attributes[0]->name) + ": has no effect " +
                                         needed.where_not() + others + "; expected " + needed.wanted() + ", or no " +
                                         all);
  }
}

}  // namespace

bool is_set_later(const World& world, const std::string& path) {
  return std::any_of(world.occasions.begin(), world.occasions.end(), [&](const Occasion& occasion) {
    return std::any_of(occasion.rows.begin(), occasion.rows.end(), [&](const RowChange& c) { return c.path == path; });
  });
}

void check_together(const muster_plugin& plugin, const std::vector<double>& values, const InstanceDeclaration& declared,
                    const World& world, const Warn& warn) {
  for (const auto& given : declared.attributes) {
    for (const auto& [low, high] : orders) {
      const bool is_prefix = low.back() == '_';
      for (const auto& end : {low, high}) {
        if (is_prefix ? given.name.rfind(end, 0) != 0 : given.name != end) continue;
        const std::string rest = is_prefix ? given.name.substr(end.size()) : "";
        check_order(plugin, values, declared, std::string(low) + rest, std::string(high) + rest);
      }
    }
    const int number = find_param(plugin, given.name);
    const muster_param& param = plugin.params[number];
    if (param.kind != MUSTER_REAL) continue;
    const double value = values[static_cast<std::size_t>(number)];
    std::string doubt =
        of_time(plugin.phase, param, value, world.dt * static_cast<double>(declared.every), world.until());
    if (plugin.phase == MUSTER_CONTROL && value == 0 && !(param.flags & MUSTER_FREE) &&
        !is_set_later(world, declared.name + '/' + given.name))
      doubt = never_moves(param);
    if (given.name == "until" && value == 0) doubt = "0 s is the start of the run, so that it does nothing";
    if (!doubt.empty()) warn(given.value_place, "attribute " + quote(given.name) + ": " + doubt);
  }
  warn_of_idle(plugin, values, declared, world, warn);
}

}  // namespace muster
