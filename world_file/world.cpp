#include "world.hpp"

#include <algorithm>
#include <cmath>

#include "params.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace muster {
namespace {

constexpr double most_ticks = 1e12;

}  // namespace

const XmlAttribute* InstanceDeclaration::attribute(std::string_view wanted) const {
  const auto found =
      std::find_if(attributes.begin(), attributes.end(), [&](const XmlAttribute& each) { return each.name == wanted; });
  return found == attributes.end() ? nullptr : &*found;
}

std::string whose_plugin(const std::vector<InstanceDeclaration>& instances, const std::string& plugin) {
  const auto found = std::find_if(instances.begin(), instances.end(),
                                  [&](const InstanceDeclaration& each) { return each.plugin == plugin; });
  return found == instances.end() ? "" : found->name;
}

std::string plugin_hint(const std::string& plugin, const std::string& instance) {
  return instance.empty() ? "" : "; " + plugin + " is the plugin of " + quote(instance);
}

InstanceDeclaration read_instance(const XmlElement& element, const std::string& plugin) {
  InstanceDeclaration result{plugin, plugin, 1, {}, {}, {}, element.place};
  for (const auto& given : element.attributes) {
    if (given.name == "name") {
      check_name(given);
      result.name = given.value;
    } else if (given.name == "every")
      result.every = positive_integer(given);
    else if (given.name == "library")
      result.library = given.value;
    else if (given.name == "revision")
      result.revision = positive_integer(given);
    else
      result.attributes.push_back(given);
  }
  if (!element.children.empty()) refuse_inside(element);
  return result;
}

uint64_t ticks_of(double time, double dt, const Place& place) {
  if (time < 0) throw invalid(place, print_real(time) + " s is before the start; expected a time from 0");
  const double ticks = std::round(time / dt);
  if (!(ticks < most_ticks))
    throw invalid(place, print_real(time) + " s are " + print_real(ticks) + " ticks of " + print_real(dt) +
                             " s; expected fewer than 1e+12");
  if (time > 0 && time < dt)
    throw invalid(place, print_real(time) + " s are less than a tick of " + print_real(dt) + " s; " +
                             (dt >= 10 ? "is dt in milliseconds? expected dt=\"" + print_real(dt / 1000) + "\", in s"
                                       : "expected a longer time, or a smaller dt"));
  return static_cast<uint64_t>(ticks);
}

void World::stand_still() {
  occasions.clear();
  for (auto& row : rows) row.joins_later = false;
}

}  // namespace muster
