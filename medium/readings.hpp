// The rssi that a network's radios report with a frame, and below which they receive none: as the channel has it, or by
// the profile of the network's mode. A profile is the chip's: sensitivity, step, lowest and highest reading.
#pragma once

#include <algorithm>
#include <cmath>
#include <muster/plugin.hpp>
#include <optional>
#include <string>

namespace muster::medium {

class Readings {
 public:
  // A plugin declares all five, the last four with its profile as their defaults.
  static constexpr Param mode_param =
      choice("rssi", "exact|profile", "of messages: as the channel has it, or as this network's chips report it");
  static constexpr Param step_param(double value) {
    return real("rssi_step", value, 0.001, 50, "dB", "between two readings of the profile");
  }
  static constexpr Param least_param(double value) {
    return real("rssi_least", value, -250, 50, "dBm", "lowest reading of the profile");
  }
  static constexpr Param most_param(double value) {
    return real("rssi_most", value, -250, 50, "dBm", "highest reading of the profile");
  }
  static constexpr Param sensitivity_param(double value, const char* help) {
    return real("sensitivity", value, -250, 50, "dBm", help);
  }

  explicit Readings(Setup& s)
      : mode_(s.value("rssi")),
        step_(s.value("rssi_step")),
        least_(s.value("rssi_least")),
        most_(s.value("rssi_most")),
        sensitivity_(s.value("sensitivity")),
        world_has_steps_(!s.text("world/radio.rssi_steps/place").empty()),
        gives_sensitivity_(!s.text("self/place/sensitivity").empty()) {
    for (const char* name : {"rssi_step", "rssi_least", "rssi_most", "sensitivity"})
      if (s.param("rssi") == 0 && !s.text(std::string("self/place/") + name).empty())
        throw BadInput("attribute \"" + std::string(name) + "\": is of the profile, and rssi is exact; expected " +
                       "rssi=\"profile\" beside it, or radio.receiver and radio.rssi_steps in the world");
  }

  // For this step. `of_mode`: the sensitivity where it depends on the mode and no attribute gives it.
  void look(const Step& k, std::optional<double> of_mode) {
    has_profile_ = k[mode_] != 0;
    if (k[least_] > k[most_]) throw BadInput("attribute \"rssi_least\": is above rssi_most; expected at most that");
    floor_ = of_mode && !gives_sensitivity_ ? *of_mode : k[sensitivity_];
  }

  // Null: not received. Steps that the world itself gives to its receivers stand as they are.
  double of(const Step& k, double rssi) const {
    if (!has_profile_ || is_null(rssi)) return rssi;
    if (rssi < floor_) return null();
    if (world_has_steps_) return rssi;
    return std::clamp(k[step_] * std::round(rssi / k[step_]), k[least_], k[most_]);
  }

 private:
  Value mode_, step_, least_, most_, sensitivity_;
  bool world_has_steps_, gives_sensitivity_;
  bool has_profile_ = false;
  double floor_ = 0;  // dBm
};

}  // namespace muster::medium
