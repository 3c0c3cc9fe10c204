// network.lrwpan: Zigbee's radio and medium access on the blackboard.
#include <algorithm>
#include <cmath>
#include <muster/plugin.hpp>

#include "medium.hpp"

namespace {

using namespace muster;
using lrwpan::Fate;
using lrwpan::Time;

// All that the medium remembers, as bytes.
struct State {
  static constexpr const char* columns = "medium{}";
  double medium;
};

double milliwatts(double dbm) { return std::pow(10, dbm / 10); }
Time nanoseconds(double seconds) { return std::llround(1e9 * seconds); }

struct NetworkLrwpan {
  static constexpr auto id = "network.lrwpan/1";
  static constexpr auto summary = "IEEE 802.15.4 at 2.4 GHz: radios that share a channel by CSMA/CA";
  static constexpr auto manual =
      R"(Messages as frames of IEEE 802.15.4-2006 (the radio of Zigbee), unslotted CSMA/CA, 250 kbit/s: back-off, clear-channel
assessment, turnaround, frame spacing; frames to one receiver are acknowledged and sent again. What is larger than 116
bytes goes in fragments cut as RFC 4944 does. A receiver locks on a frame that it hears (rssi not null) and
that stands 5 dB below noise and interference or better; each bit then comes right or wrong by the standard's O-QPSK
formula for its ratio to noise and to all other frames in the air; a lock is kept, whatever stronger begins (no
capture). Power is link/*/level with link/*/fading, as it stands in the tick.
`spread`: a request is made at some moment of its tick, since robots' clocks do not agree; else at its start, all at
once. `cca`: power of others against cca_threshold, as its mean over 8 symbols (standard), as ns-3 3.37 samples it
(ns3), or at the end alone (instant). -77 dBm: a CC2420's data sheet; noise: 5 MHz at 290 K.
Each copy has one outcome in radio/*/traffic: asked = delivered + too_weak + no_link + collided + no_access +
queue_full + no_ack + gone + those still under way.)";
  static constexpr auto phase = MUSTER_NETWORK;
  static constexpr Param params[] = {
      choice("cca", "standard|ns3|instant", "how a radio listens before it talks"),
      real("cca_threshold", -77, -250, 50, "dBm", "power above which the channel is busy"),
      real("noise", -106.987, -250, 50, "dBm", "of a receiver"),
      flag("acknowledge", true, "messages to one receiver are acknowledged"),
      integer("retries", 3, 0, 7, "of a frame that was not acknowledged"),
      integer("queue", 16, 0, 1e6, "messages that may wait at a radio beside the one that it sends"),
      flag("spread", true, "requests come at any moment of their tick"),
  };

  explicit NetworkLrwpan(Setup& s)
      : cca(s.value("cca")),
        cca_threshold(s.value("cca_threshold")),
        noise(s.value("noise")),
        acknowledge(s.value("acknowledge")),
        retries(s.value("retries")),
        queue(s.value("queue")),
        spread(s.value("spread")),
        request(s.read<Outgoing>("outbox/*/message")),
        endpoint(s.read<Endpoint>("endpoint/*/radio")),
        ends(s.read<Ends>("link/*/ends")),
        level(s.read<Level>("link/*/level")),
        fading(s.read_if_any<Fading>("link/*/fading")),
        rssi(s.read<Rssi>("link/*/rssi")),
        inbox(s.write<Incoming>("inbox/*/message")),
        traffic(s.write<Traffic>("radio/*/traffic")),
        state(s.write<State>("self/state")),
        moments(s.stream("moments of requests")),
        medium(s.stream("medium access")) {}

  void step(const Step& k) {
    look(k);
    if (const auto bytes = k.last_bytes(state, 0, 0); bytes != saved) medium.load(bytes);
    ask(k);
    const lrwpan::Settings settings{milliwatts(k[noise]),
                                    milliwatts(k[cca_threshold]),
                                    static_cast<lrwpan::Cca>(static_cast<int>(k[cca]) + 1),
                                    static_cast<std::size_t>(k[queue]),
                                    k[acknowledge] != 0,
                                    static_cast<int>(k[retries])};
    const lrwpan::Report report = medium.run(nanoseconds(k.time() - k.dt()), nanoseconds(k.time()), channel, settings);
    hand_over(k, report);
    count(k, report);
    saved = medium.save();
    k.put_bytes(state, 0, 0, saved);
  }

  void look(const Step& k) {
    const std::size_t n = k[traffic].size();
    channel.radios = n;
    channel.power.assign(n * n, 0);
    channel.rssi.assign(n * n, null());
    channel.alive.assign(n, 0);
    channel.keys.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      channel.alive[i] = k.alive("radio", i);
      channel.keys[i] = k.key("radio", i);
    }
    const auto gains = k[fading];
    const auto radio = [&](double end) {
      return static_cast<std::size_t>(k[endpoint][static_cast<std::size_t>(end)].radio);
    };
    for (std::size_t i = 0; i < k[ends].size(); ++i) {
      const std::size_t at = radio(k[ends][i].tx) * n + radio(k[ends][i].rx);
      channel.power[at] = milliwatts(k[level][i].level) * (gains.empty() ? 1 : gains[i].gain);
      channel.rssi[at] = k[rssi][i].rssi;
    }
  }

  void ask(const Step& k) {
    const auto requests = k[request];
    for (std::size_t i = 0; i < requests.size(); ++i) {
      const auto from = static_cast<std::size_t>(requests[i].radio);
      const double share = k[spread] != 0 ? moments.of(channel.keys[from]).uniform(k.tick(), i) : 0;
      medium.ask(nanoseconds(k.time() - (1 - share) * k.dt()), from,
                 is_null(requests[i].to) ? lrwpan::Medium::everyone : static_cast<std::size_t>(requests[i].to),
                 std::string(k.bytes(request, i, Outgoing::payload_column)));
    }
  }

  void hand_over(const Step& k, const lrwpan::Report& report) const {
    const auto made = k.append(inbox, report.deliveries.size());
    for (std::size_t i = 0; i < report.deliveries.size(); ++i) {
      const lrwpan::Delivery& it = report.deliveries[i];
      made[i].radio = static_cast<double>(it.to);
      made[i].from = static_cast<double>(it.from);
      made[i].rssi = it.rssi;
      made[i].t_sent = 1e-9 * static_cast<double>(it.sent);
      made[i].t_received = 1e-9 * static_cast<double>(it.received);
      k.put_bytes(inbox, i, Incoming::payload_column, it.payload);
    }
  }

  void count(const Step& k, const lrwpan::Report& report) const {
    for (std::size_t i = 0; i < channel.radios; ++i) {
      const auto made = [&](Fate fate) { return static_cast<double>(report.fates[i][static_cast<std::size_t>(fate)]); };
      const Traffic& t = k.last(traffic)[i];
      k[traffic][i] = {t.asked + made(Fate::under_way),
                       t.delivered + made(Fate::delivered),
                       t.too_weak + made(Fate::too_weak),
                       t.no_link + made(Fate::no_link),
                       t.collided + made(Fate::collided),
                       t.no_access + made(Fate::no_access),
                       t.queue_full + made(Fate::queue_full),
                       t.no_ack + made(Fate::no_ack),
                       t.gone + made(Fate::gone)};
    }
  }

  Value cca, cca_threshold, noise, acknowledge, retries, queue, spread;
  In<Outgoing> request;
  In<Endpoint> endpoint;
  In<Ends> ends;
  In<Level> level;
  In<Fading> fading;
  In<Rssi> rssi;
  Out<Incoming> inbox;
  Out<Traffic> traffic;
  Out<State> state;
  Stream moments;
  lrwpan::Medium medium;
  lrwpan::Channel channel;  // room, kept from step to step
  std::string saved;        // what the medium holds
};

}  // namespace

MUSTER_PLUGIN_IS(NetworkLrwpan)
