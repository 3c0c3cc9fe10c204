// In process what the clients beside this file do over the bridge: drives two robots by what they sense and hear.
#include <muster/plugin.hpp>
#include <string>

namespace {

using namespace muster;

struct ControlPair {
  static constexpr auto id = "test.pair/1", summary = "drives two robots";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr const char* names[] = {"east", "west"};

  explicit ControlPair(Setup& s) {
    for (int i = 0; i < 2; ++i) {
      const std::string name = names[i];
      odometry[i] = s.read<Odometry>("robot/" + name + "/odometry").index;
      heard[i] = s.read<Incoming>("inbox/" + name + "/message").index;
      command[i] = s.write<Command>("robot/" + name + "/command").index;
      calls[i] = s.write<Outgoing>("outbox/" + name + "/message").index;
    }
  }

  void step(const Step& k) const {
    for (int i = 0; i < 2; ++i) {
      const Odometry& here = *k[In<Odometry>{odometry[i]}];
      double v = 0.3 - 0.05 * here.x, w = 0.4 - 0.2 * here.yaw;
      const auto messages = k[In<Incoming>{heard[i]}];
      for (std::size_t m = 0; m < messages.size(); ++m) {
        v += 0.001 * messages[m].rssi;
        w += 0.01 * static_cast<double>(k.bytes(In<Incoming>{heard[i]}, m, Incoming::payload_column).size());
        if (k.name("radio", static_cast<std::size_t>(messages[m].from)) == "base") w += 1;
      }
      *k[Out<Command>{command[i]}] = {v, w};
      if (k.tick() % 5 != static_cast<uint64_t>(i)) continue;
      auto& call = k.send(Out<Outgoing>{calls[i]}, 0, "tick " + std::to_string(k.tick()));
      call.to = k.tick() % 2 ? null() : other(k, names[1 - i]);
    }
  }

  static double other(const Step& k, std::string_view name) {
    double row = 0;
    while (k.name("radio", static_cast<std::size_t>(row)) != name) ++row;
    return row;
  }

  int odometry[2], heard[2], command[2], calls[2];
};

}  // namespace

MUSTER_PLUGIN_IS(ControlPair)
