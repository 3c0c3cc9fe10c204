// Commands nothing at the hips: legs of robots whose motors have no torque hang freely.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Slack {
  static constexpr auto id = "conformance.slack/1", summary = "asks hips to stand still";
  static constexpr auto phase = MUSTER_ACTUATE;

  explicit Slack(Setup& s) : gait(s.write<Gait>("robot/*/gait")) {}

  void step(const Step& k) const {
    for (Gait& g : k[gait]) g = {};
  }

  Out<Gait> gait;
};

}  // namespace

MUSTER_PLUGIN_IS(Slack)
