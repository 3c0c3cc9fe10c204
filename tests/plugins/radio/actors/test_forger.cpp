// A controller that claims to be the radio of row `as`.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Forger {
  static constexpr auto id = "test.forger/1", summary = "claims to be another";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {
      reference("robot", "robot", "whose controller").required(),
      integer("as", 0, -1, 1000, "the radio that it claims to be"),
  };

  explicit Forger(Setup& s) : as(s.value("as")), outbox(s.write<Outgoing>("outbox/{robot}/message")) {}

  void step(const Step& k) const {
    Outgoing& message = k.send(outbox, 0, "from=another rssi=0 t_sent=99");
    message.radio = k[as];
    message.to = null();
  }

  Value as;
  Out<Outgoing> outbox;
};

}  // namespace

MUSTER_PLUGIN_IS(Forger)
