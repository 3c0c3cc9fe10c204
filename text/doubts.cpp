#include "text/doubts.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "text/number.hpp"

namespace muster {
namespace {

constexpr double turn = 6.283185307179586;   // rad
constexpr double fastest = 6 * turn;         // rad/s; robots and their wheels turn more slowly
constexpr double fastest_sensed = 100;       // rad/s; gyroscopes of robots tell 2 to 70
constexpr double unbounded = 1e6;            // of a range: none
constexpr double gravity = 9.81;             // m/s2
constexpr double strongest = 60;             // dBm, a kilowatt; radios of robots send some 20 dBm
constexpr double thickest = 2, longest = 3;  // m, of a wall and from a robot to its antenna
constexpr double usual_antenna = 1;          // m, from a robot to it
constexpr double highest = 200;              // m, of a wall or a door
constexpr double narrowest = 1000;           // Hz, of a jammer's or a receiver's band
constexpr double lowest = 1e6;               // Hz, of a carrier
constexpr double deafest = -50;              // dBm; the lowest reading of a radio is some -100
constexpr double globe = 1e6;                // m; bound of places, beyond which are those of UTM
constexpr double loudest = 30;               // dBm, a watt: no link is as strong
constexpr double degree = turn / 360;        // rad
constexpr double centimetre = 0.01;          // m

bool is_within(double value, double least, double most) { return value >= least && value <= most; }

// In so many digits.
std::string about(double value, int digits = 4) {
  std::array<char, 32> text;
  return {text.data(),
          std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr};
}

// `highest`: of what is told in metres; what would be higher in centimetres is in millimetres.
std::string in_smaller_units(double value, double highest) {
  const bool is_cm = std::abs(value) * centimetre <= highest;
  return print_real(value) + " m; is this " + (is_cm ? "centimetres? " : "millimetres? ") + print_real(value) +
         (is_cm ? " cm are " : " mm are ") + about(value * (is_cm ? centimetre : centimetre / 10)) + " m";
}

// Of a frequency that may be in GHz, MHz or kHz: `power` is that of ten.
std::string in_hertz(double value, int power) {
  const std::string unit = (power == 9 ? "GHz" : power == 6 ? "MHz" : "kHz"), number = print_real(value);
  return number + " Hz; is this " + unit + "? " + number + ' ' + unit + " are " + number + 'e' + std::to_string(power) +
         " Hz";
}

std::string in_dbm(double milliwatts) { return about(10 * std::log10(milliwatts)) + " dBm"; }

}  // namespace

std::string angle_doubt(double radians) {
  if (!(std::abs(radians) > turn)) return "";
  return print_real(radians) + " rad is more than a full turn; are these degrees? " + print_real(radians) +
         " degrees are " + about(radians * degree, 5) + " rad";
}

std::string unit_doubt(std::string_view name, std::string_view unit, double value) {
  if (unit == "rad") return angle_doubt(value);
  if (unit == "rad/s" && std::abs(value) > fastest && name.find("range") == name.npos)
    return print_real(value) + " rad/s is " + about(std::abs(value) / turn) + " turns a second; are these degrees? " +
           print_real(value) + " degrees a second are " + about(value * degree) + " rad/s";
  if (name == "gyro_range" && value > fastest_sensed && value < unbounded)
    return print_real(value) + " rad/s is " + about(value / turn) + " turns a second; are these degrees? " +
           print_real(value) + " degrees a second are " + about(value * degree) + " rad/s";
  if (name == "accel_range" && value < gravity)
    return print_real(value) + " m/s2 is less than gravity, so that a robot at rest is told as " + print_real(value) +
           "; is this in g? " + print_real(value) + " g are " + about(value * gravity) + " m/s2";
  if (unit == "dBm" && name.find("power") != name.npos && value > strongest)
    return print_real(value) + " dBm is " + about(std::pow(10, value / 10 - 3)) + " W; is this milliwatts? " +
           print_real(value) + " mW are " + in_dbm(value);
  if (unit == "dBm" && name == "sensitivity" && value > 0)
    return print_real(value) + " dBm: nothing so strong arrives; is a minus missing?";
  if (unit == "dBm" && name == "least" && value > deafest)
    return print_real(value) + " dBm: each weaker reading, which is nearly every one, is given as it; expected some " +
           "-100 dBm";
  if (unit == "Hz" && value > 0) {
    if (name == "frequency" && value < lowest) return in_hertz(value, value < 100 ? 9 : value < 1e5 ? 6 : 3);
    if (name == "bandwidth" && value < narrowest) return in_hertz(value, value < 1 ? 9 : 6);
  }
  if (name == "duty" && value == 0) return "0: it is never on";
  if (unit == "m" && name == "height" && value > highest) return in_smaller_units(value, highest);
  if (unit == "m" && name == "thickness" && value > thickest) return in_smaller_units(value, thickest);
  if (unit == "m" && name == "antenna" && std::abs(value) > longest) return in_smaller_units(value, usual_antenna);
  return "";
}

std::string level_doubt(std::string_view unit, Compared compared, double value) {
  if (unit == "dBm" && value > loudest && compared != Compared::equal)
    return print_real(value) + " dBm is above every level that arrives, so that this " +
           (compared == Compared::below ? "always" : "never") + " holds; is a minus missing?";
  if (unit == "rad" && std::abs(value) > turn) return angle_doubt(value);
  const bool is_measured = unit == "m" || unit == "rad" || unit == "dBm";
  if (compared == Compared::equal && is_measured && value != 0)
    return "a number in " + std::string(unit) + " is seldom exactly " + print_real(value) +
           ", so that this may never hold; expected above or below";
  return "";
}

std::string unit_hint(std::string_view unit, double value, double least, double most) {
  if (unit == "Hz" && value > 0) {
    for (const auto& [factor, prefix] : {std::pair(9, "G"), std::pair(6, "M"), std::pair(3, "k")}) {
      if (value < least && is_within(value * std::pow(10, factor), least, most))
        return "; " + print_real(value) + " " + prefix + "Hz are " + print_real(value) + "e" + std::to_string(factor) +
               " Hz";
    }
  }
  if (unit == "dBm" && value > most && is_within(-value, least, most)) return "; is a minus missing?";
  if (unit == "dB" && value < 0 && least == 0 && is_within(-value, least, most))
    return "; without the minus? losses and deviations are positive: " + print_real(-value);
  if (unit == "m" && most >= globe && std::abs(value) > most)
    return "; a place on the globe (UTM)? expected metres from an origin of your own";
  if (unit == "deg" && is_within(value * 1e-7, least, most) && std::abs(value) > 1e6)
    return "; is this in 1e-7 degrees, as in MAVLink? they are " + about(value * 1e-7, 10);
  if (unit == "m/s" && value > most && is_within(value * centimetre, least, most)) return "; is this in cm/s?";
  if (unit == "rad" && std::abs(value) <= 360 && is_within(value * degree, least, most))
    return "; " + print_real(value) + " degrees are " + about(value * degree) + " rad";
  return "";
}

std::string power_hint(std::string_view unit, std::string_view text) {
  if (unit != "dBm") return "";
  double factor = 0;
  std::string_view number;
  for (const auto& [end, milliwatts] : {std::pair<std::string_view, double>("mW", 1), {"W", 1000}}) {
    if (factor > 0 || text.size() <= end.size() || text.substr(text.size() - end.size()) != end) continue;
    number = text.substr(0, text.size() - end.size());
    while (!number.empty() && number.back() == ' ') number.remove_suffix(1);
    factor = milliwatts;
  }
  const auto value = parse_real(number);
  if (!value || !(*value > 0)) return "";
  return "; " + std::string(text) + " are " + in_dbm(*value * factor);
}

}  // namespace muster
