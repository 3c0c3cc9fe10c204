// A radio that sends a beacon periodically.
#include <muster/plugin.hpp>

#include "plugins/own_radio.hpp"
#include "plugins/periods.hpp"

namespace {

using namespace muster;

struct ControlBeacon {
  static constexpr auto id = "control.beacon/1";
  static constexpr auto summary = "sends a message every period, to all or to one";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {reference("radio", "radio", "the radio it speaks on").required(),
                                     reference("to", "radio", "whom it speaks to; by default all"),
                                     real("period", 0.5, 0.001, 1000, "s", "of its messages")};

  explicit ControlBeacon(Setup& s)
      : to(s.value("to")),
        period(s.value("period")),
        radio(s.param("radio")),
        outbox(s.write<Outgoing>("outbox/{radio}/message")) {
    if (s.param("to") == radio) {
      const std::string name = s.host()->row_name(s.host(), "radio", static_cast<uint32_t>(radio));
      s.host()->event(s.host(), ("warning: " + s.text("self/place/to") + ": attribute \"to\": \"" + name +
                                 "\" is the radio that it speaks on, so that nobody hears it; expected another radio, "
                                 "or no \"to\", which is all")
                                    .c_str());
    }
  }

  void step(const Step& k) const {
    if (is_due(k.time(), k.dt(), k[period])) k.send(outbox, 0, "beacon") = {radio, k[to] < 0 ? null() : k[to], 0};
  }

  Value to, period;
  double radio;
  Out<Outgoing> outbox;
};

}  // namespace

MUSTER_PLUGIN_IS(ControlBeacon)
