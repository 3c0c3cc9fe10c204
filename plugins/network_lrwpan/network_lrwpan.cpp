// network.lrwpan: Zigbee's radio and medium access on the blackboard.
#include <muster/pan.hpp>
#include <optional>

#include "medium.hpp"
#include "medium/board.hpp"
#include "superframe_table.hpp"

namespace {

using namespace muster;
using medium::milliwatts;

struct NetworkLrwpan {
  static constexpr auto id = "network.lrwpan/4";
  static constexpr auto summary = "IEEE 802.15.4 at 2.4 GHz: radios that share a channel by CSMA/CA";
  static constexpr auto manual =
      R"(Messages as frames of IEEE 802.15.4-2006 (the radio of Zigbee), CSMA/CA, 250 kbit/s: back-off, clear-channel
assessment, turnaround, frame spacing; frames to one receiver are acknowledged and sent again. What is larger than 116
bytes (104 with extended addresses) goes in fragments cut as RFC 4944 does. radio.pan puts radios into PANs: what is
sent to all goes to the sender's, and ends as no_link elsewhere. A receiver locks on a frame that it hears (rssi not
null) and that stands 5 dB below noise and interference or better; each bit then comes right or wrong by the standard's
O-QPSK formula for its ratio to noise and to all other frames in the air; a lock is kept, whatever stronger begins,
unless `capture` says else. Power is link/*/level with link/*/fading, as it stands in the tick.
`spread`: a request is made at some moment of its tick, since robots' clocks do not agree; else at its start, all at
once. `cca`: power of others against cca_threshold, as its mean over 8 symbols (standard), as ns-3 3.37 samples it
(ns3), or at the end alone (instant). -77 dBm: a CC2420's data sheet; noise: 5 MHz at 290 K.
Access is unslotted, unless `beacon_order` (BO) is below 15: then the coordinator's PAN is a star, bounded by beacons.
Superframes of 15.36 ms times 2 to the power of BO begin at time 0; the first 15.36 ms times 2 to the power of
`superframe_order` (SO) of each are its contention access period, by slotted CSMA/CA, and in the rest all are off. The
coordinator and its devices exchange messages; from device to device there is no link (no_link), unless a routing
relays. A device that has heard no beacon, or lost 4 in a row, is silent: its messages end as no_access, and
radio/*/superframe counts them as silent. That table is there where the world file gives beacon_order.
rssi="profile": messages come with readings as a CC2420 gives them (its data sheet), and frames below the sensitivity
that the standard demands (6.5.3.3) are not received. radio.rssi_steps in the world takes the place of the profile's
steps.
Each copy has one outcome in radio/*/traffic: asked = delivered + too_weak + no_link + collided + no_access +
queue_full + no_ack + gone + those still under way.)";
  static constexpr auto phase = MUSTER_NETWORK;
  static constexpr bool keeps_only_caches = true;
  static constexpr Param params[] = {
      integer("channel", 11, 11, 26, "5 MHz each, from 2405 MHz up: what it hears of jammers"),
      choice("cca", "standard|ns3|instant", "how a radio listens before it talks"),
      real("cca_threshold", -77, -250, 50, "dBm", "power above which the channel is busy"),
      real("noise", -106.987, -250, 50, "dBm", "of a receiver"),
      flag("acknowledge", true, "messages to one receiver are acknowledged"),
      integer("retries", 3, 0, 7, "of a frame that was not acknowledged; only with acknowledge"),
      choice("addresses", "short|extended", "of 16 or of 64 bits, which every frame bears"),
      integer("queue", 16, 0, 1e6, "messages that may wait at a radio beside the one that it sends"),
      real("capture", 0, 0, 60, "dB", "a later frame so far above all others takes a receiver over; 0: none does"),
      medium::RequestMoments::spread_param,
      integer("beacon_order", lrwpan::no_beacons, 0, 15, "macBeaconOrder, BO: of the time between beacons; 15: none"),
      integer("superframe_order", lrwpan::no_beacons, 0, 15, "macSuperframeOrder, SO: of the active part; 15: as BO"),
      reference("coordinator", "radio",
                "of the PAN, which sends the beacons; by default the first radio that is there; only with beacon_order "
                "below 15"),
      medium::Readings::mode_param,
      medium::Readings::step_param(1),
      medium::Readings::least_param(-100),
      medium::Readings::most_param(0),
      medium::Readings::sensitivity_param(-85, "of the profile: weaker frames are not received"),
  };

  explicit NetworkLrwpan(Setup& s)
      : channel(s.value("channel")),
        cca(s.value("cca")),
        cca_threshold(s.value("cca_threshold")),
        noise(s.value("noise")),
        acknowledge(s.value("acknowledge")),
        retries(s.value("retries")),
        addresses(s.value("addresses")),
        queue(s.value("queue")),
        capture(s.value("capture")),
        beacon_order(s.value("beacon_order")),
        superframe_order(s.value("superframe_order")),
        coordinator(s.value("coordinator")),
        pan(s.read_if_any<Pan>("radio/*/pan")),
        board(s, "self/lrwpan", {-5, 30}),
        medium(s.stream("medium access")) {
    if (s.param("beacon_order") < lrwpan::no_beacons) superframe.emplace(s);
  }

  void step(const Step& k) {
    lrwpan::Settings settings;
    settings.noise = milliwatts(k[noise]);
    settings.busy = milliwatts(k[cca_threshold]);
    settings.channel = static_cast<int>(k[channel]);
    settings.cca = static_cast<lrwpan::Cca>(static_cast<int>(k[cca]) + 1);
    settings.queue = static_cast<std::size_t>(k[queue]);
    settings.acknowledged = k[acknowledge] != 0;
    settings.retries = static_cast<int>(k[retries]);
    settings.extended = k[addresses] != 0;
    settings.capture = k[capture] > 0 ? milliwatts(k[capture]) : 0;
    for (const Pan& each : k[pan]) settings.pans.push_back(static_cast<std::uint16_t>(each.id));
    set_superframe(k, settings);
    board.step(k, medium, settings, lrwpan::band_of(settings.channel));
    if (superframe) superframe->step(k, medium.members(), settings.coordinator);
  }

  static std::size_t first_there(const Step& k) {
    for (uint32_t radio = 0; radio < k.rows("radio"); ++radio) {
      if (k.alive("radio", radio)) return radio;
    }
    return 0;
  }

  void set_superframe(const Step& k, lrwpan::Settings& settings) const {
    settings.beacon_order = static_cast<int>(k[beacon_order]);
    settings.superframe_order = static_cast<int>(k[superframe_order]);
    settings.coordinator = k[coordinator] >= 0 ? static_cast<std::size_t>(k[coordinator]) : first_there(k);
    const bool has_active_part = settings.superframe_order < lrwpan::no_beacons;
    if (has_active_part && settings.beacon_order == lrwpan::no_beacons)
      throw BadInput("attribute \"superframe_order\": is given without beacon_order; expected both, or neither");
    if (has_active_part && settings.superframe_order > settings.beacon_order)
      throw BadInput("attribute \"superframe_order\": is above beacon_order (" + std::to_string(settings.beacon_order) +
                     "); expected at most that, since the active part lies within the time between beacons");
    if (!has_active_part) settings.superframe_order = settings.beacon_order;
  }

  Value channel, cca, cca_threshold, noise, acknowledge, retries, addresses, queue, capture;
  Value beacon_order, superframe_order, coordinator;
  In<Pan> pan;
  medium::Board board;
  lrwpan::Medium medium;
  std::optional<lrwpan::SuperframeTable> superframe;
};

}  // namespace

MUSTER_PLUGIN_IS(NetworkLrwpan)
