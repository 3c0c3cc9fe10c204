// A stage of the receiver's chain as a function of one reading; missing readings stay missing.
#pragma once

#include <muster/plugin.hpp>

namespace muster {

class RssiStage {
 public:
  explicit RssiStage(Setup& s) : rssi(s.modify<Rssi>("link/*/rssi")) {}

  // change(reading in dBm, link) is the reading after the stage.
  template <class Change>
  void each(const Step& k, const Change& change) const {
    const auto before = k.before(rssi);
    const auto out = k[rssi];
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i].rssi = is_null(before[i].rssi) ? null() : change(before[i].rssi, i);
    }
  }

 private:
  Stage<Rssi> rssi;
};

}  // namespace muster
