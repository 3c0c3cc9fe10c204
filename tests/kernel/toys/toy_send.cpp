// Appends `count` messages a step to a queue; each holds its number and, after it, `size` bytes made from it.
// Built once for each phase.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Send {
  static constexpr auto id = TOY_ID "/1", summary = "sends numbered messages";
  static constexpr auto phase = TOY_PHASE;
  static constexpr Param params[] = {
      reference("robot", "robot", "who sends"),
      text("to", "outbox/*/message", "the queue"),
      integer("count", 1, 0, 100, "messages a step"),
      integer("size", 0, 0, 1e8, "bytes after the number"),
      integer("as", -1, -1, 100, "the radio in whose name it sends; -1: its own robot's"),
  };

  explicit Send(Setup& s)
      : count(s.value("count")), size(s.value("size")), as(s.value("as")), out(s.write<Outgoing>(s.text("to"))) {}

  void step(const Step& k) const {
    for (int i = 0; i < static_cast<int>(k[count]); ++i) {
      const std::string number = std::to_string(k.tick() * 100 + static_cast<uint64_t>(i));
      std::string bytes = number + '|';
      for (std::size_t b = 0; b < static_cast<std::size_t>(k[size]); ++b)
        bytes += static_cast<char>(key_of(number) >> (b % 57));
      Outgoing& made = k.send(out, static_cast<std::size_t>(i), bytes);
      if (k[as] >= 0) made.radio = k[as];
      made.to = null();
    }
  }

  Value count, size, as;
  Out<Outgoing> out;
};

}  // namespace

MUSTER_PLUGIN_IS(Send)
