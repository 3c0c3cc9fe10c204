// Closed forms of slotted CSMA/CA: saturated devices, without acknowledgement, whose frames are a whole number of slots
// (back-off periods) long. They share no code with the simulator. Throughput is the share of slots with a frame that
// meets no other.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace muster::slotted {

constexpr int stages = 5;  // macMaxCSMABackoffs + 1
constexpr int window(int stage) { return 1 << std::min(3 + stage, 5); }

// Pollin, Ergen, Ergen, Bougard, Van der Perre, Moerman, Bahai, Varaiya, Catthoor: Performance analysis of slotted
// carrier sense IEEE 802.15.4 medium access layer (IEEE Transactions on Wireless Communications 7(9), 2008): a device
// makes its first assessment with the same probability phi in every slot. alpha: it finds the channel busy there; beta:
// at the second one. The spacing of frames, which the paper leaves out, is a wait beside the frame's.
inline double pollin(int devices, int frame, int spacing) {
  double phi = 0.05, alpha = 0.3, beta = 0.3;
  for (int i = 0; i < 20000; ++i) {
    const double on = alpha + beta - alpha * beta, through = (1 - alpha) * (1 - beta);
    double reached = 0, slots = 0;  // of each stage: how often it is reached; slots spent in it
    for (int stage = 0; stage < stages; ++stage) {
      const double times = std::pow(on, stage);
      reached += times;
      slots += times * ((window(stage) + 1) / 2.0 + (1 - alpha) + through * (frame + spacing));
    }
    const double others = 1 - std::pow(1 - phi, devices - 1);
    phi += 0.05 * (reached / slots - phi);
    alpha += 0.05 * (frame * others * through - alpha);
    beta += 0.05 * (others / (2 - std::pow(1 - phi, devices)) - beta);
  }
  return frame * devices * phi * std::pow(1 - phi, devices - 1) * (1 - alpha) * (1 - beta);
}

// State of one device as probabilities: its count in each stage, the second assessment to come, and the slots until it
// draws for its next frame.
struct Device {
  double count[stages][32] = {};
  double second[stages] = {};
  std::vector<double> apart;

  explicit Device(int spacing) : apart(static_cast<std::size_t>(spacing) + 1) {}
  void draw(int stage, double share) {
    stage %= stages;  // after the last one the frame is dropped, and the next one contends
    for (int k = 0; k < window(stage); ++k) count[stage][k] += share / window(stage);
  }
  void add(const Device& other, double share) {
    for (int stage = 0; stage < stages; ++stage) {
      for (int k = 0; k < 32; ++k) count[stage][k] += share * other.count[stage][k];
      second[stage] += share * other.second[stage];
    }
    for (std::size_t i = 0; i < apart.size(); ++i) apart[i] += share * other.apart[i];
  }
  // A slot later.
  Device after(bool is_busy) const {
    Device next(static_cast<int>(apart.size()) - 1);
    for (int stage = 0; stage < stages; ++stage) {
      for (int k = 1; k < 32; ++k) next.count[stage][k - 1] += count[stage][k];
      if (is_busy)
        next.draw(stage + 1, count[stage][0] + second[stage]);
      else
        next.second[stage] += count[stage][0];
    }
    for (std::size_t i = 1; i < apart.size(); ++i) next.apart[i - 1] += apart[i];
    next.draw(0, apart[0]);
    return next;
  }
};

// The same chain of a device, conditioned on the channel: what a device does depends on how long ago the last frame
// ended. Models that leave this out miss by more than 10 % (An accurate Markov model for slotted CSMA/CA algorithm in
// IEEE 802.15.4 networks, IEEE Communications Letters 12(6), 2008). Devices are independent given that.
inline double conditioned(int devices, int frame, int spacing) {
  Device at_end(spacing);  // as the last frame ended
  at_end.draw(0, 1);
  double throughput = 0;
  for (int round = 0; round < 300; ++round) {
    Device next(spacing), device = at_end;
    double still_idle = 1, slots = frame, alone = 0;
    for (int slot = 0; slot < 1000 && still_idle > 1e-13; ++slot) {
      double begins = 0;  // a frame in the next slot
      for (double& share : device.second) begins += share, share = 0;
      slots += still_idle;
      const double none = std::pow(1 - begins, devices);
      if (none < 1) {
        alone += still_idle * devices * begins * std::pow(1 - begins, devices - 1);
        const double is_sender = begins / (1 - none);
        Device other = device.after(false);
        for (int i = 0; i < frame; ++i) other = other.after(true);
        next.add(other, still_idle * (1 - none) * (1 - is_sender) / (1 - begins));
        next.apart[static_cast<std::size_t>(spacing) - 1] += still_idle * (1 - none) * is_sender;
      }
      still_idle *= none;
      Device later(spacing);
      later.add(device.after(false), 1 / (1 - begins));
      device = later;
    }
    at_end = next;
    throughput = frame * alone / slots;
  }
  return throughput;
}

}  // namespace muster::slotted
