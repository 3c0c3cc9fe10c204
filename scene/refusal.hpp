// Error messages of the scene, with the faulty row of its input.
#pragma once

#include <stdexcept>
#include <string>

namespace muster::scene {

[[noreturn]] inline void refuse(const char* what, int row, const std::string& why) {
  throw std::runtime_error(std::string(what) + " row " + std::to_string(row) + ": " + why);
}

// For a point beyond 100 km.
[[noreturn]] void refuse_point(double x, double y, double z);

inline void check_material(const char* what, int row, int material, int materials) {
  if (material >= 0 && material < materials) return;
  refuse(what, row,
         "material row " + std::to_string(material) + " does not exist; expected one of the first " +
             std::to_string(materials));
}

}  // namespace muster::scene
