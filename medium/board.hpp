// A medium's place on the blackboard: levels and requests in; messages, counts and its state out.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <muster/emission.hpp>
#include <muster/plugin.hpp>
#include <muster/printed.hpp>
#include <string>

#include "medium/readings.hpp"
#include "medium/request_moments.hpp"
#include "medium/transmit_queue.hpp"

namespace muster::medium {

// Ends of a scale of link quality: mean ratio of a frame to noise and others [dB].
struct Quality {
  double worst, best;
};

class Board {
 public:
  // `state`: name of its table, a different one for each kind of medium, since their formats differ.
  Board(Setup& s, const char* state, Quality quality)
      : quality_(quality),
        request_(s.read<Outgoing>("outbox/*/message")),
        endpoint_(s.read<Endpoint>("endpoint/*/radio")),
        ends_(s.read<Ends>("link/*/ends")),
        level_(s.read<Level>("link/*/level")),
        fading_(s.read_if_any<Fading>("link/*/fading")),
        rssi_(s.read<Rssi>("link/*/rssi")),
        readings_(s),
        emission_(s.read_if_any<Emission>("radio/*/emission")),
        inbox_(s.write<Incoming>("inbox/*/message")),
        traffic_(s.write<Traffic>("radio/*/traffic")),
        state_(s.write<State>(state)),
        moments_(s) {}

  // Runs the medium through the tick. `band`: all that its radios may receive in; `sensitivity`: of a profile whose
  // world gives none, where it depends on the mode.
  template <class Medium, class Settings>
  void step(const Step& k, Medium& medium, const Settings& settings, const Band& band,
            std::optional<double> sensitivity = {}) {
    look(k, sensitivity);
    if (k.last_bytes(state_, 0, 0).empty()) warn_of_jammers_elsewhere(k, band);  // its first step
    if (const auto bytes = k.last_bytes(state_, 0, 0); bytes != saved_) medium.load(bytes);
    ask(k, medium);
    const Report& report = medium.run(nanoseconds(k.time() - k.dt()), nanoseconds(k.time()), channel_, settings);
    hand_over(k, report);
    count(k, report);
    saved_ = medium.save();
    k.put_bytes(state_, 0, 0, saved_);
  }

 private:
  // The whole state of the medium, as bytes.
  struct State {
    static constexpr const char* columns = "medium{}";
    double medium;
  };

  static Time nanoseconds(double seconds) { return std::llround(1e9 * seconds); }

  void look(const Step& k, std::optional<double> sensitivity) {
    const std::size_t n = k[traffic_].size();
    channel_.radios = n;
    channel_.power.assign(n * n, 0);
    channel_.rssi.assign(n * n, null());
    channel_.alive.assign(n, 0);
    channel_.keys.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      channel_.alive[i] = k.alive("radio", i);
      channel_.keys[i] = k.key("radio", i);
    }
    const auto gains = k[fading_];
    readings_.look(k, sensitivity);
    const auto radio = [&](double end) {
      return static_cast<std::size_t>(k[endpoint_][static_cast<std::size_t>(end)].radio);
    };
    for (std::size_t i = 0; i < k[ends_].size(); ++i) {
      const std::size_t at = radio(k[ends_][i].tx) * n + radio(k[ends_][i].rx);
      channel_.power[at] = milliwatts(k[level_][i].level) * (gains.empty() ? 1 : gains[i].gain);
      channel_.rssi[at] = readings_.of(k, k[rssi_][i].rssi);
    }
    look_for_jammers(k);
  }

  void look_for_jammers(const Step& k) {
    channel_.jammers.clear();
    for (std::size_t i = 0; i < k[emission_].size(); ++i) {
      const Emission& e = k[emission_][i];
      const Time period = nanoseconds(e.period), on = std::min(period, nanoseconds(e.duty * e.period));
      if (on <= 0 || !channel_.alive[i]) continue;
      Jammer jammer;
      jammer.radio = i;
      jammer.band = {e.frequency - e.bandwidth / 2, e.frequency + e.bandwidth / 2};
      jammer.pulses = {period, on, nanoseconds(e.phase)};
      for (std::size_t to = 0; to < channel_.radios; ++to)
        jammer.power.push_back(milliwatts(e.excess) * channel_.power_from(i)[to]);
      jammer.power[i] = std::numeric_limits<double>::infinity();
      channel_.jammers.push_back(std::move(jammer));
    }
  }

  void warn_of_jammers_elsewhere(const Step& k, const Band& band) const {
    constexpr double mega = 1e6;  // [Hz]
    const auto megahertz = [](const Band& b) {
      return printed(b.low / mega) + (b.high > b.low ? " to " + printed(b.high / mega) : "") + " MHz";
    };
    for (const Jammer& jammer : channel_.jammers) {
      if (share_of(jammer.band, band) > 0 || jammer.band.high < mega) continue;  // of another unit, as is told there
      k.warn("self", "radio '" + std::string(k.name("radio", jammer.radio)) + "' jams at " + megahertz(jammer.band) +
                         ", outside of this network's " + megahertz(band) +
                         ", and does nothing to it; expected a frequency inside");
    }
  }

  template <class Medium>
  void ask(const Step& k, Medium& medium) {
    const auto requests = k[request_];
    moments_.start(channel_.radios);
    const Time last = nanoseconds(k.time()) - 1;  // of this run: a request that rounds to its end would be dropped
    for (std::size_t i = 0; i < requests.size(); ++i) {
      const auto from = static_cast<std::size_t>(requests[i].radio);
      medium.ask(std::min(nanoseconds(moments_.next(k, from)), last), from,
                 is_null(requests[i].to) ? everyone : static_cast<std::size_t>(requests[i].to),
                 std::string(k.bytes(request_, i, Outgoing::payload_column)));
    }
  }

  void hand_over(const Step& k, const Report& report) const {
    const auto made = k.append(inbox_, report.deliveries.size());
    for (std::size_t i = 0; i < report.deliveries.size(); ++i) {
      const Delivery& it = report.deliveries[i];
      const Arrival& message = report.arrivals[it.arrival];
      made[i].radio = static_cast<double>(it.to);
      made[i].from = static_cast<double>(message.from);
      made[i].rssi = it.rssi;
      made[i].lqi = lqi(it.ratio);
      made[i].t_sent = 1e-9 * static_cast<double>(message.sent);
      made[i].t_received = 1e-9 * static_cast<double>(message.received);
      k.put_bytes(inbox_, i, Incoming::payload_column, message.payload);
    }
  }

  // Whole numbers from 0 to 255, uniform in dB between the worst and the best (IEEE 802.15.4-2006, 6.9.8).
  double lqi(double ratio) const {
    const double share = (10 * std::log10(ratio) - quality_.worst) / (quality_.best - quality_.worst);
    return std::round(255 * std::clamp(share, 0.0, 1.0));
  }

  void count(const Step& k, const Report& report) const {
    for (std::size_t i = 0; i < channel_.radios; ++i) {
      const auto made = [&](DeliveryOutcome fate) {
        return static_cast<double>(report.fates[i][static_cast<std::size_t>(fate)]);
      };
      const Traffic& t = k.last(traffic_)[i];
      k[traffic_][i] = {t.asked + made(DeliveryOutcome::under_way),
                        t.delivered + made(DeliveryOutcome::delivered),
                        t.too_weak + made(DeliveryOutcome::too_weak),
                        t.no_link + made(DeliveryOutcome::no_link),
                        t.collided + made(DeliveryOutcome::collided),
                        t.no_access + made(DeliveryOutcome::no_access),
                        t.queue_full + made(DeliveryOutcome::queue_full),
                        t.no_ack + made(DeliveryOutcome::no_ack),
                        t.gone + made(DeliveryOutcome::gone)};
    }
  }

  Quality quality_;
  In<Outgoing> request_;
  In<Endpoint> endpoint_;
  In<Ends> ends_;
  In<Level> level_;
  In<Fading> fading_;
  In<Rssi> rssi_;
  Readings readings_;
  In<Emission> emission_;
  Out<Incoming> inbox_;
  Out<Traffic> traffic_;
  Out<State> state_;
  RequestMoments moments_;
  Channel channel_;    // buffer, kept from step to step
  std::string saved_;  // state that the medium holds now
};

}  // namespace muster::medium
