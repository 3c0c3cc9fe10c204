// What each radio of a robot knows of the peers that it has heard.
#include <cmath>
#include <cstring>
#include <map>
#include <muster/emission.hpp>
#include <muster/plugin.hpp>
#include <muster/routing.hpp>
#include <muster/senses.hpp>
#include <optional>
#include <string>
#include <utility>

#include "medium/jammer.hpp"
#include "plugins/periods.hpp"

namespace {

using namespace muster;

// The last reading of a peer.
struct Known {
  double radio, peer, rssi, last_seen;
};

// All readings, as bytes of Known in the order of their rows.
struct Memory {
  static constexpr const char* columns = "readings{}";
  double readings;
};

struct SensorsLinks {
  static constexpr auto id = "sensors.links/1";
  static constexpr auto summary = "the table of links of each robot's radios: peer, rssi, noise, last seen";
  static constexpr auto manual =
      R"(Each `period` a robot with radios is told, in heard/*/peer, of every peer that they have received a message
from, one row each: the rssi as the receiver reported it with the last message, when that was, and the noise. An rssi
older than `memory` is empty, a peer unheard for `forget` is left out. `smoothing` is the share of the value before that
a new rssi leaves, as drivers do it. Under a routing plugin the frames of each hop count, whatever they carry.
noise: what the radio's network states as the noise of a receiver is to be given as `noise`; -250 states none. With
`jammers` the power that jammers radiate in the band of `frequency` and `bandwidth` is added, as the links carry it
and as a mean over their pulses, and the sum is rounded to `noise_step`. Where nobody states any it is empty.
Nothing else passes through: without `jammers` this instance reads received messages and no channel.)";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {
      real("period", 0, 0, 1e6, "s", "between two tables; 0: each step"),
      real("memory", 1e6, 0, 1e6, "s", "an rssi older than this is empty"),
      real("forget", 1e6, 0, 1e6, "s", "a peer unheard for longer is left out"),
      real("smoothing", 0, 0, 0.999, "", "share of the value before in a new rssi, in dB"),
      real("noise", -250, -250, 50, "dBm", "of a receiver in its band; -250: not stated"),
      real("noise_step", 1, 0, 50, "dB", "to which noise is rounded; 0: it is not"),
      flag("jammers", false, "adds what jammers radiate; reads the levels of links from them"),
      real("frequency", 2.44e9, 1, 1e12, "Hz", "middle of the receivers' band; only with jammers"),
      real("bandwidth", 5e6, 1, 1e12, "Hz", "of the receivers' band; only with jammers"),
  };

  // Levels of links from jammers.
  struct Air {
    explicit Air(Setup& s)
        : endpoint(s.read<Endpoint>("endpoint/*/radio")),
          ends(s.read<Ends>("link/*/ends")),
          level(s.read<Level>("link/*/level")),
          fading(s.read_if_any<Fading>("link/*/fading")),
          emission(s.read_if_any<Emission>("radio/*/emission")) {}
    In<Endpoint> endpoint;
    In<Ends> ends;
    In<Level> level;
    In<Fading> fading;
    In<Emission> emission;
  };

  explicit SensorsLinks(Setup& s)
      : period(s.value("period")),
        memory(s.value("memory")),
        forget(s.value("forget")),
        smoothing(s.value("smoothing")),
        noise(s.value("noise")),
        noise_step(s.value("noise_step")),
        frequency(s.value("frequency")),
        bandwidth(s.value("bandwidth")),
        mount(s.read<Mount>("radio/*/mount")),
        inbox(s.read<Incoming>("inbox/*/message")),
        hops(s.read_if_any<Incoming>("inbox/*/message@base")),
        journeys(s.read_if_any<Journeys>("radio/*/journeys")),
        heard(s.write<Heard>("heard/*/peer", MUSTER_SENSED)),
        kept(s.write<Memory>("self/memory")) {
    if (s.param("jammers") != 0) air.emplace(s);
  }

  using Table = std::map<std::pair<double, double>, Known>;

  void step(const Step& k) const {
    Table known = remembered(k);
    // A routing plugin puts the origin of a packet in the place of the sender of the frame.
    const auto& arrivals = k[journeys].empty() ? inbox : hops;
    for (const Incoming& message : k[arrivals]) listen(k, message, known);
    for (auto at = known.begin(); at != known.end();) at = is_kept(k, at->second) ? std::next(at) : known.erase(at);
    std::string bytes;
    for (const auto& [rows, one] : known) bytes.append(reinterpret_cast<const char*>(&one), sizeof one);
    k.put_bytes(kept, 0, 0, bytes);
    const bool is_first = k.tick() == 0;
    if (is_first || k[period] <= 0 || is_due(k.time(), k.dt(), k[period])) tell(k, known);
  }

 private:
  Table remembered(const Step& k) const {
    const auto bytes = k.last_bytes(kept, 0, 0);
    Table result;
    for (std::size_t at = 0; at + sizeof(Known) <= bytes.size(); at += sizeof(Known)) {
      Known one;
      std::memcpy(&one, bytes.data() + at, sizeof one);
      result.emplace_hint(result.end(), std::pair(one.radio, one.peer), one);
    }
    return result;
  }

  void listen(const Step& k, const Incoming& message, Table& known) const {
    const auto [at, is_new] =
        known.try_emplace({message.radio, message.from}, Known{message.radio, message.from, message.rssi, 0});
    Known& one = at->second;
    one.rssi = is_new ? message.rssi : k[smoothing] * one.rssi + (1 - k[smoothing]) * message.rssi;
    one.last_seen = message.t_received;
  }

  bool is_kept(const Step& k, const Known& one) const {
    return k.alive("radio", static_cast<std::size_t>(one.radio)) && k.time() - one.last_seen <= k[forget];
  }

  void tell(const Step& k, const Table& known) const {
    std::map<double, double> noise_at;
    for (const auto& [rows, one] : known) {
      const double robot = k[mount][static_cast<std::size_t>(one.radio)].robot;
      if (is_null(robot) || !k.alive("robot", static_cast<std::size_t>(robot))) continue;
      const auto [at, is_new] = noise_at.try_emplace(one.radio, 0);
      if (is_new) at->second = noise_of(k, one.radio);
      const bool is_fresh = k.time() - one.last_seen <= k[memory];
      *k.append(heard, 1).begin() = {robot,      one.radio,     one.peer, is_fresh ? one.rssi : null(),
                                     at->second, one.last_seen, k.time()};
    }
  }

  double noise_of(const Step& k, double radio) const {
    double power = k[noise] > -250 ? std::pow(10, k[noise] / 10) : 0;  // [mW]
    if (air) power += jamming(k, radio);
    if (!(power > 0)) return null();
    const double level = 10 * std::log10(power), step = k[noise_step];
    return step > 0 ? step * std::round(level / step) : level;
  }

  double jamming(const Step& k, double radio) const {
    const auto emitted = k[air->emission];
    if (emitted.empty()) return 0;
    const medium::Band own{k[frequency] - k[bandwidth] / 2, k[frequency] + k[bandwidth] / 2};
    double power = 0;  // [mW]
    for (std::size_t i = 0; i < k[air->ends].size(); ++i) {
      const Ends& link = k[air->ends][i];
      if (k[air->endpoint][static_cast<std::size_t>(link.rx)].radio != radio) continue;
      const Emission& from =
          emitted[static_cast<std::size_t>(k[air->endpoint][static_cast<std::size_t>(link.tx)].radio)];
      if (from.duty <= 0) continue;
      const medium::Band spectrum{from.frequency - from.bandwidth / 2, from.frequency + from.bandwidth / 2};
      const double gain = k[air->fading].empty() ? 1 : k[air->fading][i].gain;
      power += from.duty * medium::share_of(spectrum, own) * gain *
               std::pow(10, (k[air->level][i].level + from.excess) / 10);
    }
    return power;
  }

  Value period, memory, forget, smoothing, noise, noise_step, frequency, bandwidth;
  In<Mount> mount;
  In<Incoming> inbox, hops;
  In<Journeys> journeys;
  Out<Heard> heard;
  Out<Memory> kept;
  std::optional<Air> air;  // with jammers
};

}  // namespace

MUSTER_PLUGIN_IS(SensorsLinks)
