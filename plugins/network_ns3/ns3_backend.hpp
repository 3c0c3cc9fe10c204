// Common parts of backends on ns-3's radios: radios that join, requests at their time, and a queue at each.
#pragma once

#include <ns3/core-module.h>

#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "ns3_radios.hpp"

namespace muster::external {

// `Radio`: the backend's state of each; its `queue` of requests, the first of which is being sent.
template <class Radio>
class Ns3Backend : public Backend {
 public:
  // `noise`: dBm; `queue`: limit of messages at a radio beside the one that it sends.
  Ns3Backend(double noise, std::size_t queue) : air_(noise), queue_(queue) {}
  ~Ns3Backend() override {
    for (const Ns3Radio& radio : air_.all()) {
      radio.device->GetMac()->SetMcpsDataConfirmCallback(ns3::McpsDataConfirmCallback());
      radio.device->GetMac()->SetMcpsDataIndicationCallback(ns3::McpsDataIndicationCallback());
    }
  }

  void init(const World& world, std::uint64_t seed) final { air_.init(world, seed); }

  void moved(const World& world) final {
    air_.moved(world);
    while (radios_.size() < world.radios()) radios_.push_back(join(radios_.size(), air_.all()[radios_.size()]));
    for (std::size_t i = 0; i < radios_.size(); ++i) {
      if (!world.alive[i]) radios_[i]->queue.clear();
    }
  }

  void request(Request request) final {
    const auto node = static_cast<std::uint32_t>(request.from);
    const auto delay = air_.until(request.at);
    ns3::Simulator::ScheduleWithContext(node, delay,
                                        [this, request = std::move(request)]() mutable { take(std::move(request)); });
  }

  void advance(double until) final { air_.advance(until); }

 protected:
  virtual std::unique_ptr<Radio> join(std::size_t number, const Ns3Radio& air) = 0;
  // Starts to send the first message of its queue, which was empty.
  virtual void start(Radio& radio) = 0;

  Ns3Radios air_;
  std::vector<std::unique_ptr<Radio>> radios_;

 private:
  void take(Request request) {
    Radio& radio = *radios_[request.from];
    if (radio.queue.size() > queue_) return this->end(request.message, End::queue_full);
    radio.queue.push_back(std::move(request));
    if (radio.queue.size() == 1) start(radio);
  }

  std::size_t queue_;
};

}  // namespace muster::external
