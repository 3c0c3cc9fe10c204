// Sends `count` messages of `size` bytes from one radio in every tick, or in one: to another, or to all.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Sender {
  static constexpr auto id = "test.sender/1", summary = "sends messages";
  static constexpr auto phase = MUSTER_ACTUATE;
  static constexpr Param params[] = {
      reference("from", "radio", "who sends").required(),
      reference("to", "radio", "to whom; by default to all"),
      integer("size", 16, 0, 1e8, "bytes"),
      integer("count", 1, 0, 100, "messages a tick"),
      integer("only", 0, 0, 1e9, "the one tick in which it sends; 0: each"),
  };

  explicit Sender(Setup& s)
      : from(s.value("from")),
        to(s.value("to")),
        size(s.value("size")),
        count(s.value("count")),
        only(s.value("only")),
        outbox(s.write<Outgoing>("outbox/*/message")) {}

  void step(const Step& k) const {
    if (k[only] != 0 && k[only] != static_cast<double>(k.tick())) return;
    std::string payload(static_cast<std::size_t>(k[size]), '\0');
    for (std::size_t i = 0; i < payload.size(); ++i) payload[i] = static_cast<char>(mixed(i + k.tick()));
    for (std::size_t i = 0; i < static_cast<std::size_t>(k[count]); ++i) {
      Outgoing& message = k.send(outbox, i, payload);
      message.radio = k[from];
      message.to = k[to] < 0 ? null() : k[to];
    }
  }

  Value from, to, size, count, only;
  Out<Outgoing> outbox;
};

}  // namespace

MUSTER_PLUGIN_IS(Sender)
