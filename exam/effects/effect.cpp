#include "exam/effects/effect.hpp"

#include <stdexcept>

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
  throw std::invalid_argument("no effect is called \"" + id + "\"; muster_exam effects lists them");
}

}  // namespace muster::exam
