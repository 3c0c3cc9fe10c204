// Messages out of a table instead of off the air: who would know the difference?
#include <cmath>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct TestForger {
  static constexpr auto id = "test.forger/1";
  static constexpr auto summary = "fills every inbox from a table";
  static constexpr auto phase = MUSTER_NETWORK;
  static constexpr Param params[] = {file("messages", "what arrives, and when").required()};

  struct Forged {
    static constexpr const char* columns = "t[s] radio:radio from:radio rssi[dBm]";
    double t, radio, from, rssi;
  };

  explicit TestForger(Setup& s) : messages(s.file<Forged>("messages")), inbox(s.write<Incoming>("inbox/*/message")) {}

  void step(const Step& k) const {
    std::size_t row = 0;
    for (const Forged& m : k[messages]) {
      if (std::abs(m.t - k.time()) < k.dt() / 2)
        k.send(inbox, row++, "beacon") = {m.radio, m.from, m.rssi, k.time(), k.time(), null(), 0};
    }
  }

  In<Forged> messages;
  Out<Incoming> inbox;
};

}  // namespace

MUSTER_PLUGIN_IS(TestForger)
