// A receiver stage that makes one radio deaf.
#include <algorithm>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Deaf {
  static constexpr auto id = "test.deaf/1", summary = "a radio that hears nothing";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {reference("radio", "radio", "which").required()};

  explicit Deaf(Setup& s)
      : radio(s.value("radio")),
        endpoint(s.read<Endpoint>("endpoint/*/radio")),
        ends(s.read<Ends>("link/*/ends")),
        rssi(s.modify<Rssi>("link/*/rssi")) {}

  void step(const Step& k) const {
    for (std::size_t i = 0; i < k[rssi].size(); ++i) {
      const bool deaf = k[endpoint][static_cast<std::size_t>(k[ends][i].rx)].radio == k[radio];
      k[rssi][i].rssi = deaf ? null() : k.before(rssi)[i].rssi;
    }
  }

  Value radio;
  In<Endpoint> endpoint;
  In<Ends> ends;
  Stage<Rssi> rssi;
};

}  // namespace

MUSTER_PLUGIN_IS(Deaf)
