// Counts the messages received, with a hash of their bytes in their order. Built once for each phase.
#include <cstdlib>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Heard {
  static constexpr const char* columns = "count bytes first last hash";
  double count, bytes, first, last, hash;
};

struct Listen {
  static constexpr auto id = TOY_ID "/1", summary = "counts messages";
  static constexpr auto phase = TOY_PHASE;
  static constexpr Param params[] = {
      reference("robot", "robot", "who listens"), text("from", "outbox/*/message", "the queue"),
      flag("answers", false, "and sends one message itself for each it sees below number 1000000")};

  explicit Listen(Setup& s) : in(s.read<Outgoing>(s.text("from"))), heard(s.write<Heard>("self/heard")), answer{-1} {
    if (s.param("answers") != 0) answer = s.write<Outgoing>(s.text("from"));
  }

  void step(const Step& k) const {
    Heard to = *k.last(heard);
    for (std::size_t r = 0; r < k[in].size(); ++r) {
      const auto bytes = k.bytes(in, r, Outgoing::payload_column);
      const double number = std::atoi(std::string(bytes.substr(0, bytes.find('|'))).c_str());
      if (to.count++ == 0) to.first = number;
      to.last = number;
      to.bytes += static_cast<double>(bytes.size());
      to.hash = static_cast<double>((combined(static_cast<uint64_t>(to.hash), key_of(bytes))) >> 12);
      if (answer.index >= 0 && number < 1e6) {
        Outgoing& made = k.send(answer, answered++, std::to_string(static_cast<int>(number) + 1000000) + '|');
        made.radio = 0;
        made.to = null();
      }
    }
    answered = 0;
    *k[heard] = to;
  }

  In<Outgoing> in;
  Out<Heard> heard;
  Out<Outgoing> answer;
  mutable std::size_t answered = 0;
};

}  // namespace

MUSTER_PLUGIN_IS(Listen)
