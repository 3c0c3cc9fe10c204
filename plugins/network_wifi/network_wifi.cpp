// network.wifi: 802.11's medium access on the blackboard.
#include "medium.hpp"
#include "medium/board.hpp"

namespace {

using namespace muster;
using medium::milliwatts;

struct NetworkWifi {
  static constexpr auto id = "network.wifi/3";
  static constexpr auto summary = "IEEE 802.11g ad hoc: stations that share a channel by DCF";
  static constexpr auto manual =
      R"(Messages as frames of ERP-OFDM (IEEE 802.11-2016, clause 18) under the distributed coordination function: DIFS, EIFS and
slots; back-off that stands still while the channel is busy; frames to one receiver are acknowledged, reserve the
channel meanwhile, and are sent again with a doubled window. What is larger than 2296 bytes goes in pieces. A
receiver takes up a frame that it hears (rssi not null) and that stands 4 dB above noise and interference at the end of
4 us, the strongest of those that begin within them; bits come wrong by the union bound of its code, for the ratio to noise
and to all other frames in the air. Power is link/*/level with link/*/fading, as it stands in the tick.
`spread`: a request is made at some moment of its tick, since robots' clocks do not agree; else at its start, all at
once. noise: 20 MHz at 290 K and a noise figure of 7 dB.
rssi="profile": messages come with readings of RCPI, and frames below the sensitivity that the standard demands for the
rate (-82 dBm at 6 Mbit/s to -65 dBm at 54) are not received. radio.rssi_steps in the world takes the place of the
profile's steps.
Each copy has one outcome in radio/*/traffic: asked = delivered + too_weak + no_link + collided + queue_full + no_ack +
gone + those still under way.)";
  static constexpr auto phase = MUSTER_NETWORK;
  static constexpr bool keeps_only_caches = true;
  static constexpr Param params[] = {
      integer(
          "channel", 1, 1, 13,
          "of the 2.4 GHz band (none of 5 GHz), 20 MHz each, in steps of 5 from 2412 MHz up: what it hears of jammers"),
      choice("rate", "6|9|12|18|24|36|48|54", "Mbit/s"),
      choice("slot", "long|short", "20 us, as the standard has it without access point; or 9 us"),
      real("busy_threshold", -62, -250, 50, "dBm", "power of any kind above which the channel is busy"),
      real("noise", -93.966, -250, 50, "dBm", "of a receiver"),
      flag("acknowledge", true, "messages to one receiver are acknowledged"),
      integer("retries", 6, 0, 255, "of a frame that was not acknowledged; only with acknowledge"),
      integer("queue", 64, 0, 1e6, "messages that may wait at a station beside the one that it sends"),
      medium::RequestMoments::spread_param,
      medium::Readings::mode_param,
      medium::Readings::step_param(0.5),
      medium::Readings::least_param(-110),
      medium::Readings::most_param(0),
      medium::Readings::sensitivity_param(-82, "of the profile: weaker frames are not received; by default the rate's"),
  };

  explicit NetworkWifi(Setup& s)
      : channel(s.value("channel")),
        rate(s.value("rate")),
        slot(s.value("slot")),
        busy_threshold(s.value("busy_threshold")),
        noise(s.value("noise")),
        acknowledge(s.value("acknowledge")),
        retries(s.value("retries")),
        queue(s.value("queue")),
        board(s, "self/wifi", {4, 40}),
        medium(s.stream("medium access")) {}

  void step(const Step& k) {
    wifi::Settings settings;
    settings.channel = static_cast<int>(k[channel]);
    settings.rate = static_cast<std::size_t>(k[rate]);
    settings.slot = k[slot] == 0 ? wifi::long_slot : wifi::short_slot;
    settings.busy = milliwatts(k[busy_threshold]);
    settings.noise = milliwatts(k[noise]);
    settings.acknowledged = k[acknowledge] != 0;
    settings.retries = static_cast<int>(k[retries]);
    settings.queue = static_cast<std::size_t>(k[queue]);
    board.step(k, medium, settings, wifi::band_of(settings.channel), wifi::sensitivities[settings.rate]);
  }

  Value channel, rate, slot, busy_threshold, noise, acknowledge, retries, queue;
  medium::Board board;
  wifi::Medium medium;
};

}  // namespace

MUSTER_PLUGIN_IS(NetworkWifi)
