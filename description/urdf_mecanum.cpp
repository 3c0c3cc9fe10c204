#include <cmath>
#include <set>

#include "description/file_text.hpp"
#include "description/urdf_check.hpp"

namespace muster::description {

using tinyxml2::XMLElement;

DifferentialDrive read_mecanum(const Source& source, const XMLElement& element, Robot& robot) {
  only_attributes(source, element,
                  {"front_left", "front_right", "rear_left", "rear_right", "wheel_radius", "wheelbase",
                   "wheel_separation", "max_torque", "max_speed", "max_acceleration", "friction"});
  const auto joint = [&](const char* attribute) { return find_joint(source, element, attribute, robot); };
  const std::vector<std::size_t> left = {joint("front_left"), joint("rear_left")},
                                 right = {joint("front_right"), joint("rear_right")};
  const std::set<std::size_t> all = {left[0], left[1], right[0], right[1]};
  if (all.size() < 4) source.fail(element.GetLineNum(), tag(element) + "has a joint twice; expected four joints");
  DifferentialDrive drive;
  take_wheels(left, right, drive);
  drive.wheel_radius = positive(source, element, "wheel_radius");
  drive.wheel_base = positive(source, element, "wheel_separation");
  const double wheelbase = positive(source, element, "wheelbase");
  read_motors(source, element, drive);
  drive.mecanum = Mecanum{wheelbase, drive.wheel_base, drive.wheel_radius};
  drive.effective_base = 2 * drive.mecanum->arm();  // of turns without sideways motion
  complete_drive(source, element, drive, robot);
  const double front = place_of_turning(source, element, robot, left[0]).x(),
               rear = place_of_turning(source, element, robot, left[1]).x();
  constexpr double tolerance = 1e-4;  // [m]
  if (std::abs(front - rear - wheelbase) > tolerance) {
    source.fail(element.GetLineNum(), tag(element) + "wheelbase=\"" + element.Attribute("wheelbase") +
                                          "\" contradicts the joints, of which the front ones are " +
                                          print_number(front - rear) + " m before the rear ones");
  }
  if (std::abs(front + rear) > 2 * tolerance) {
    source.fail(element.GetLineNum(), tag(element) +
                                          "the middle of the wheels is at x = " + print_number((front + rear) / 2) +
                                          " of the robot's frame; expected 0: the frame's origin is below it");
  }
  return drive;
}

}  // namespace muster::description
