// Our media set as the simulators that they are compared with.
#pragma once

#include "peers/ours.hpp"
#include "plugins/network_lrwpan/medium.hpp"
#include "plugins/network_wifi/medium.hpp"

namespace muster::peers {

// As ns-3 has it: noise of 5 MHz at 290 K, and a channel that is busy 10 dB above the sensitivity of -106.58 dBm.
inline Counts our_lr_wpan(const Task& task) {
  lrwpan::Settings s;
  s.noise = 1.380649e-23 * 290 * 5e6 * 1e3;
  s.busy = medium::milliwatts(-96.58);
  s.cca = lrwpan::Cca::ns3;
  s.queue = 1'000'000;
  return run_ours<lrwpan::Medium>(task, channel_of(task.places), s);
}

// Noise of 20 MHz at 290 K with a noise figure of 7 dB; frames below -82 dBm are not found.
inline Counts our_wifi(const Task& task) {
  wifi::Settings s;
  s.noise = 1.380649e-23 * 290 * 20e6 * 1e3 * std::pow(10, 0.7);
  s.busy = medium::milliwatts(-62);
  s.queue = 1'000'000;
  return run_ours<wifi::Medium>(task, channel_of(task.places, 16.0206, -82), s);
}

}  // namespace muster::peers
