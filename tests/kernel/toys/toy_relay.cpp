// A stage of the outbox: each message goes on with ten million added to its number. Built once for each phase.
#include <cstdlib>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Relay {
  static constexpr auto id = TOY_ID "/1", summary = "passes messages on";
  static constexpr auto phase = TOY_PHASE;

  explicit Relay(Setup& s) : stage(s.modify<Outgoing>("outbox/*/message")) {}

  void step(const Step& k) const {
    const auto before = k.before(stage);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const auto bytes = k.bytes(stage, i, Outgoing::payload_column);
      const int number = std::atoi(std::string(bytes.substr(0, bytes.find('|'))).c_str());
      Outgoing& made =
          k.send(stage, i, std::to_string(number + 10'000'000) + std::string(bytes.substr(bytes.find('|'))));
      made.radio = before[i].radio;
      made.to = before[i].to;
    }
  }

  Stage<Outgoing> stage;
};

}  // namespace

MUSTER_PLUGIN_IS(Relay)
