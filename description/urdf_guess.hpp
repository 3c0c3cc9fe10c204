// A drive that no <muster> declares: what is known of it, and defaults for the rest.
#pragma once

#include "description/urdf_check.hpp"

namespace muster::description {

struct DriveGuess {
  std::vector<std::size_t> left, right;  // joints
  // 0: from the shapes, the joints' places, their limits, or the defaults.
  double wheel_radius = 0, effective_base = 0;  // [m]
  double max_torque = 0;                        // of a side's motor [N m]

  // Gives the robot this drive, with a warning that has it as a <differential> to write; `source_of_it` says where it
  // is from. Throws as complete_drive() does.
  void take(const Source& source, const tinyxml2::XMLElement& element, const std::string& source_of_it, Robot& robot);
};

}  // namespace muster::description
