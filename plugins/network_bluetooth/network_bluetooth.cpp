// network.bluetooth: a piconet on the blackboard.
#include "medium.hpp"
#include "medium/board.hpp"

namespace {

using namespace muster;
using medium::milliwatts;

struct NetworkBluetooth {
  static constexpr auto id = "network.bluetooth/4";
  static constexpr auto summary = "Bluetooth at its basic rate: a master and up to seven slaves, polled in slots";
  static constexpr auto manual =
      R"(Messages as packets of Bluetooth (Core Specification 2.0, basic rate): slots of 625 us, 79 channels of 1 MHz.
All radios are of one piconet but those that jam. The master sends, and in the slot after its packet the slave that it
addressed answers; nobody else talks. It addresses whoever has data or had some in its last answer, all in turn, and
each slave once in `poll_interval`. A message is cut into packets, the last as short as its rest allows; each is sent
until it is acknowledged, or given up after `flush_timeout`. What the master sends to all is sent once.
Slaves have no link to one another: what one sends to another ends as no_link. A plugin for routing may relay it.
Bits come wrong by the formula of binary FSK for their ratio to noise and to jammers in the slot's channel; a header's
are sent three times. Power is link/*/level with link/*/fading, as it stands in the tick.
`spread`: a request is made at some moment of its tick, since robots' clocks do not agree; else at its start, all at
once. noise: 1 MHz at 290 K and a noise figure of 7 dB; a receiver that is just as good as the specification asks for
(0.1 % wrong bits at -70 dBm) has -82.715 dBm.
rssi="profile": messages come with readings as an inquiry with RSSI has them, 8 bits in dBm, and packets below -70 dBm
are not received. radio.rssi_steps in the world takes the place of the profile's steps.
Each copy has one outcome in radio/*/traffic: asked = delivered + too_weak + no_link + collided + queue_full + no_ack +
gone + those still under way.)";
  static constexpr auto phase = MUSTER_NETWORK;
  static constexpr bool keeps_only_caches = true;
  static constexpr Param params[] = {
      reference("master", "radio", "the master; by default the first radio that is there and does not jam"),
      choice("packets", "DH5|DH3|DH1", "longest packets that are used, of 339, 183 and 27 bytes"),
      integer("poll_interval", 40, 2, 4096, "slots: each slave is addressed at least so often if time allows"),
      real("flush_timeout", 0.05, 0, 41, "s", "a packet not acknowledged by then ends its message; 0: never"),
      real("noise", -106.976, -250, 50, "dBm", "of a receiver"),
      integer("queue", 64, 0, 1e6, "messages that may wait at a radio beside the one that it sends"),
      medium::RequestMoments::spread_param,
      medium::Readings::mode_param,
      medium::Readings::step_param(1),
      medium::Readings::least_param(-127),
      medium::Readings::most_param(20),
      medium::Readings::sensitivity_param(-70, "of the profile: weaker packets are not received"),
  };

  explicit NetworkBluetooth(Setup& s)
      : master(s.value("master")),
        largest(s.value("packets")),
        poll_interval(s.value("poll_interval")),
        flush_timeout(s.value("flush_timeout")),
        noise(s.value("noise")),
        queue(s.value("queue")),
        board(s, "self/bluetooth", {8, 40}),
        medium(s.stream("medium access")) {}

  void step(const Step& k) {
    bluetooth::Settings settings;
    settings.master = k[master] < 0 ? bluetooth::Settings::first_there : static_cast<std::size_t>(k[master]);
    settings.largest = bluetooth::dh5 - static_cast<std::size_t>(k[largest]);
    settings.poll_interval = std::llround(k[poll_interval]) * bluetooth::slot;
    settings.flush = std::llround(1e9 * k[flush_timeout]);
    settings.noise = milliwatts(k[noise]);
    settings.queue = static_cast<std::size_t>(k[queue]);
    try {
      board.step(k, medium, settings, {bluetooth::band_of(0).low, bluetooth::band_of(78).high});
    } catch (const bluetooth::JammingMaster& e) {
      throw BadInput("attribute \"master\": \"" + std::string(k.name("radio", settings.master)) + "\" " + e.what() +
                     "; expected one that does not jam, of " + names(k, e.there));
    } catch (const bluetooth::TooManyRadios& e) {
      throw BadInput(e.what() + std::string("; expected ") + std::to_string(1 + bluetooth::most_slaves) +
                     " radios or fewer, or another network in its place, such as <network.wifi/>; the radios are " +
                     names(k, e.there));
    }
  }

  static std::string names(const Step& k, const std::vector<std::size_t>& radios) {
    std::string list;
    for (const std::size_t radio : radios)
      list += (list.empty() ? "" : ", ") + std::string(k.name("radio", static_cast<uint32_t>(radio)));
    return list;
  }

  Value master, largest, poll_interval, flush_timeout, noise, queue;
  medium::Board board;
  bluetooth::Medium medium;
};

}  // namespace

MUSTER_PLUGIN_IS(NetworkBluetooth)
