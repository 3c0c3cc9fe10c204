// Messages without contention: each copy above the sensitivity arrives, in the tick in which it was sent.
#include <algorithm>
#include <muster/plugin.hpp>
#include <vector>

#include "link_index.hpp"

namespace {

using namespace muster;

// A copy of a request that arrives.
struct Delivery {
  std::size_t request, from, to;
  double rssi;  // dBm
};

struct NetworkIdeal {
  static constexpr auto id = "network.ideal/2";
  static constexpr auto summary = "delivers every message whose link is strong enough";
  static constexpr auto manual =
      "A copy is asked for each receiver: one for a unicast, every other living radio for a broadcast. It is "
      "delivered\n"
      "in the same tick if the link from sender to receiver has an rssi of at least `sensitivity`; else it is counted\n"
      "as too weak, without link, or gone. Sender, rssi and times are filled in here, never by the sender.\n"
      "No contention, no delay, no loss by noise, no limit on size.";
  static constexpr auto phase = MUSTER_NETWORK;
  static constexpr Param params[] = {real("sensitivity", -95, -250, 50, "dBm", "weaker messages are lost")};

  explicit NetworkIdeal(Setup& s)
      : sensitivity(s.value("sensitivity")),
        request(s.read<Outgoing>("outbox/*/message")),
        endpoint(s.read<Endpoint>("endpoint/*/radio")),
        ends(s.read<Ends>("link/*/ends")),
        rssi(s.read<Rssi>("link/*/rssi")),
        inbox(s.write<Incoming>("inbox/*/message")),
        traffic(s.write<Traffic>("radio/*/traffic")) {}

  void step(const Step& k) const {
    const auto before = k.last(traffic);
    std::copy(before.begin(), before.end(), k[traffic].begin());
    const auto requests = k[request];
    if (requests.empty()) return;
    const LinkIndex links(k[ends], k[endpoint]);
    std::vector<Delivery> delivered;
    for (std::size_t i = 0; i < requests.size(); ++i) {
      const auto from = static_cast<std::size_t>(requests[i].radio);
      if (!is_null(requests[i].to)) {
        decide(k, links, i, from, static_cast<std::size_t>(requests[i].to), delivered);
        continue;
      }
      for (std::size_t to = 0; to < k[traffic].size(); ++to) {
        if (to != from && k.alive("radio", to)) decide(k, links, i, from, to, delivered);
      }
    }
    put(k, delivered);
  }

  // Each copy has exactly one outcome.
  void decide(const Step& k, const LinkIndex& links, std::size_t i, std::size_t from, std::size_t to,
              std::vector<Delivery>& delivered) const {
    Traffic& count = k[traffic][from];
    ++count.asked;
    const std::size_t link = links.find(from, to);
    const double level = link == LinkIndex::none ? null() : k[rssi][link].rssi;
    if (!k.alive("radio", to)) {
      ++count.gone;
    } else if (link == LinkIndex::none) {
      ++count.no_link;
    } else if (is_null(level) || level < k[sensitivity]) {
      ++count.too_weak;
    } else {
      ++count.delivered;
      delivered.push_back({i, from, to, level});
    }
  }

  void put(const Step& k, const std::vector<Delivery>& delivered) const {
    const auto made = k.append(inbox, delivered.size());
    for (std::size_t i = 0; i < delivered.size(); ++i) {
      const Delivery& it = delivered[i];
      made[i].radio = static_cast<double>(it.to);
      made[i].from = static_cast<double>(it.from);
      made[i].rssi = it.rssi;
      made[i].t_sent = made[i].t_received = k.time();
      made[i].lqi = null();
      k.put_bytes(inbox, i, Incoming::payload_column, k.bytes(request, it.request, Outgoing::payload_column));
    }
  }

  Value sensitivity;
  In<Outgoing> request;
  In<Endpoint> endpoint;
  In<Ends> ends;
  In<Rssi> rssi;
  Out<Incoming> inbox;
  Out<Traffic> traffic;
};

}  // namespace

MUSTER_PLUGIN_IS(NetworkIdeal)
