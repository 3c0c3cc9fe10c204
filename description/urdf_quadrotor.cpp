#include <cmath>

#include "description/file_text.hpp"
#include "description/urdf_check.hpp"

namespace muster::description {

using tinyxml2::XMLElement;

namespace {

constexpr double gravity = 9.81;  // [m/s2]

double from_zero(const Source& source, const XMLElement& element, const char* attribute) {
  const char* text = element.Attribute(attribute);
  if (!text) return 0;
  const auto value = parse_number(text);
  if (!value || *value < 0) {
    source.fail(element.GetLineNum(),
                std::string("<quadrotor> ") + attribute + "=\"" + text + "\" is wrong; expected a number from 0");
  }
  return *value;
}

// True if a loop with characteristic polynomial lag s^4 + s^3 + d s^2 + p s + i is stable (Routh, Hurwitz).
bool settles(double lag, double d, double p, double i) {
  const double damping = d - lag * p;
  return damping > 0 && p * damping > i;
}

void check_quadrotor(const Source& source, int line, const Quadrotor& drive, const Robot& robot) {
  const double weight = whole_mass(robot).mass * gravity;
  if (drive.max_thrust() <= weight) {
    source.fail(line, "<quadrotor> four rotors at max_speed lift " + print_number(drive.max_thrust()) +
                          " N, but the robot weighs " + print_number(weight) + " N");
  }
  for (const double lag : {drive.lag_up, drive.lag_down}) {
    if (!settles(lag, drive.attitude_d, drive.attitude_p, drive.attitude_i)) {
      source.fail(line, "<quadrotor> roll and pitch would never come to rest with rotors that lag by " +
                            print_number(lag) +
                            " s; expected attitude_d above lag attitude_p + attitude_i / attitude_p");
    }
    if (drive.yaw_p <= lag * drive.yaw_i) {
      source.fail(line, "<quadrotor> the turn rate would never come to rest with rotors that lag by " +
                            print_number(lag) + " s; expected yaw_p above lag yaw_i");
    }
  }
}

}  // namespace

Quadrotor read_quadrotor(const Source& source, const XMLElement& element, const Robot& robot) {
  only_attributes(source, element,
                  {"arm", "rotor_angle", "height", "thrust_factor", "torque_factor", "drag_factor", "max_speed",
                   "lag_up", "lag_down", "attitude_p", "attitude_i", "attitude_d", "yaw_p", "yaw_i"});
  Quadrotor drive;
  drive.arm = positive(source, element, "arm");
  if (const char* text = element.Attribute("rotor_angle")) {
    constexpr double half_turn = 3.14159265358979323846;
    const auto value = parse_number(text);
    if (!value || std::abs(*value) > half_turn) {
      source.fail(element.GetLineNum(), std::string("<quadrotor> rotor_angle=\"") + text +
                                            "\" is wrong; expected an angle from -pi to pi [rad]: 0 is a plus, "
                                            "0.7853981633974483 an X");
    }
    drive.rotor_angle = *value;
  }
  drive.height = from_zero(source, element, "height");
  drive.thrust_factor = positive(source, element, "thrust_factor");
  drive.torque_factor = positive(source, element, "torque_factor");
  drive.drag_factor = from_zero(source, element, "drag_factor");
  drive.max_speed = positive(source, element, "max_speed");
  drive.lag_up = positive(source, element, "lag_up");
  drive.lag_down = positive(source, element, "lag_down");
  drive.attitude_p = positive(source, element, "attitude_p");
  drive.attitude_i = from_zero(source, element, "attitude_i");
  drive.attitude_d = positive(source, element, "attitude_d");
  drive.yaw_p = positive(source, element, "yaw_p");
  drive.yaw_i = from_zero(source, element, "yaw_i");
  check_quadrotor(source, element.GetLineNum(), drive, robot);
  return drive;
}

}  // namespace muster::description
