// The rssi that a network's radios report: as the channel has it, or by the profile of the network's mode, as a further
// stage of the receiver's chain. A profile is the chip's: its sensitivity, its step, its lowest and its highest
// reading.
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
  static constexpr Param mode_param = choice(
      "rssi", "exact|profile", "exact: as the receiver's chain has it; profile: as this network's chips report it");
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
        has_profile_(s.param("rssi") != 0),
        has_steps_(!s.text("world/radio.rssi_steps/place").empty()),
        gives_sensitivity_(!s.text("self/place/sensitivity").empty()) {
    if (has_profile_)
      stage_ = s.modify<Rssi>("link/*/rssi");
    else
      exact_ = s.read<Rssi>("link/*/rssi");
    for (const char* name : {"rssi_step", "rssi_least", "rssi_most", "sensitivity"})
      if (!has_profile_ && !s.text(std::string("self/place/") + name).empty())
        throw BadInput("attribute \"" + std::string(name) + "\": is of the profile, and rssi is exact; expected " +
                       "rssi=\"profile\" beside it, or radio.receiver and radio.rssi_steps in the world");
  }

  // Applies the profile, if any; a reading for each link. `of_mode`: the sensitivity where no attribute gives it.
  Rows<const Rssi> look(const Step& k, std::optional<double> of_mode = {}) const {
    if ((k[mode_] != 0) != has_profile_)
      throw BadInput("attribute \"rssi\": does not change in mid-run; expected a swap of the network");
    if (!has_profile_) return k[*exact_];
    if (k[least_] > k[most_]) throw BadInput("attribute \"rssi_least\": is above rssi_most; expected at most that");
    const double floor = of_mode && !gives_sensitivity_ ? *of_mode : k[sensitivity_];
    const auto before = k.before(*stage_);
    const auto out = k[*stage_];
    for (std::size_t i = 0; i < out.size(); ++i) out[i].rssi = reading(k, before[i].rssi, floor);
    return {&out.begin()->rssi, out.size()};
  }

 private:
  // Steps that the world itself gives to its receivers stand as they are.
  double reading(const Step& k, double rssi, double floor) const {
    if (is_null(rssi) || rssi < floor) return null();
    if (has_steps_) return rssi;
    return std::clamp(k[step_] * std::round(rssi / k[step_]), k[least_], k[most_]);
  }

  Value mode_, step_, least_, most_, sensitivity_;
  bool has_profile_, has_steps_, gives_sensitivity_;
  std::optional<In<Rssi>> exact_;
  std::optional<Stage<Rssi>> stage_;
};

}  // namespace muster::medium
