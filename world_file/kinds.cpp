#include "kinds.hpp"

#include <algorithm>

namespace muster {
namespace {

struct Found {
  std::string kind;
  Place place;
};

// Of "base" or "station/base".
Found found(const World& world, const std::string& name, const std::string& wanted) {
  for (const RowDeclaration& row : world.rows) {
    const bool is_of_it = std::find(row.sets.begin(), row.sets.end(), wanted) != row.sets.end();
    if (is_of_it || (row.name != name && row.set + '/' + row.name != name)) continue;
    return {row.set == "radio" ? "station" : row.set, row.place};  // a radio that is nobody's
  }
  for (const InstanceDeclaration& instance : world.instances)
    if (wanted != "instance" && instance.name == name) return {"instance of " + instance.plugin, instance.place};
  return {};
}

}  // namespace

std::string kind_of_name(const World& world, const std::string& name, const std::string& wanted) {
  return found(world, name, wanted).kind;
}

std::string which_is(const World& world, const std::string& name, const std::string& wanted) {
  const Found other = found(world, name, wanted);
  if (other.kind.empty()) return "";
  const bool is_vowel = std::string("aeiou").find(other.kind[0]) != std::string::npos;
  return std::string(", which is ") + (is_vowel ? "an " : "a ") + other.kind +
         (other.place.line > 0 ? " (" + other.place.text() + ')' : "");
}

}  // namespace muster
