// A loss between a radio and the air, the same for what it sends and what it receives.
#include <muster/plugin.hpp>

#include "link_term.hpp"

namespace {

using namespace muster;

struct FeederLoss {
  static constexpr auto id = "effect.feeder_loss/1";
  static constexpr auto summary = "a radio's cable, connector or antenna loses more than the world says, both ways";
  static constexpr auto manual =
      "Takes `loss` from every link that `radio` sends and from every link that it receives: by reciprocity a cable or "
      "an antenna loses the same both ways. A diagnosis seeks it for radios that send and receive. Of one that only "
      "receives it is an rx_offset, of one that only sends a tx_offset: the readings are the same.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("radio", "radio", "which radio").required(),
      real("loss", 0, -60, 60, "dB", "what it loses more than the world says; negative: less")
          .free()
          .with(MUSTER_LINEAR),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "the feeder of the radio {radio} (cable, connectors, antenna) loses {loss|more|less} than the world says, both "
      "ways",
      "radio",
      "",
      "effect.tx_offset effect.rx_offset effect.obstacle effect.room_clutter effect.height",
      "exchange the cable and the antenna, and measure both ways once more at the same places",
      nullptr,
      MUSTER_BOTH_ENDS,
  };

  explicit FeederLoss(Setup& s) : radio(s.value("radio")), loss(s.value("loss")), links(s) {}

  void step(const Step& k) const {
    links.add(k, [&](const End& from, const End& to) {
      return from.radio == k[radio] || to.radio == k[radio] ? -k[loss] : 0.0;
    });
  }

  Value radio, loss;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(FeederLoss)
