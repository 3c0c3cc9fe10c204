#include "exam/effects/effect.hpp"

#include <algorithm>
#include <stdexcept>

#include "exam/arguments.hpp"

namespace muster::exam {

const std::vector<Recipe>& recipes() {
  static const std::vector<Recipe> all = [] {
    std::vector<Recipe> result;
    for (const auto& part :
         {radio_recipes(), map_recipes(), distance_recipes(), time_recipes(), receiver_recipes(), outside_recipes()})
      result.insert(result.end(), part.begin(), part.end());
    return result;
  }();
  return all;
}

const Recipe& recipe(const std::string& id) {
  for (const Recipe& r : recipes())
    if (r.id == id) return r;
  std::vector<std::string> names;
  for (const Recipe& r : recipes()) names.emplace_back(r.id);
  // The plugin that diagnoses an effect has the kind before its name.
  const std::string name = id.substr(id.rfind('.') + 1);
  const bool is_there = std::find(names.begin(), names.end(), name) != names.end();
  throw std::invalid_argument(
      "no effect is called \"" + id + "\"; " +
      (is_there ? "did you mean \"" + name + "\"? muster_exam effects lists them" : expected(id, names)));
}

}  // namespace muster::exam
