// ns-3's radios for IEEE 802.15.4 at 2.4 GHz on our channel: the basis of each of its networks here.
#pragma once

#include <ns3/lr-wpan-module.h>
#include <ns3/mobility-module.h>
#include <ns3/network-module.h>
#include <ns3/propagation-module.h>
#include <ns3/spectrum-module.h>

#include <unordered_map>
#include <vector>

#include "backend.hpp"

namespace muster::external {

// Our channel as ns-3's loss model: a radio's received power from another that sends at 0 dBm. A frame has the level at
// its begin.
class OurLoss final : public ns3::PropagationLossModel {
 public:
  void join(const ns3::MobilityModel* place) { numbers_.emplace(place, numbers_.size()); }
  void set(const World& world);
  // Of the last frame between the two.
  double rssi(std::size_t from, std::size_t to) const { return rssi_[from][to]; }

 private:
  double DoCalcRxPower(double tx_power, ns3::Ptr<ns3::MobilityModel> a, ns3::Ptr<ns3::MobilityModel> b) const override;
  int64_t DoAssignStreams(int64_t) override { return 0; }

  std::unordered_map<const ns3::MobilityModel*, std::size_t> numbers_;
  const World* world_ = nullptr;
  mutable std::vector<std::vector<double>> rssi_;
};

struct Ns3Radio {
  ns3::Ptr<ns3::Node> node;
  ns3::Ptr<ns3::ConstantPositionMobilityModel> place;
  ns3::Ptr<ns3::LrWpanNetDevice> device;
};

// One simulation of ns-3, from init() on.
class Ns3Radios {
 public:
  explicit Ns3Radios(double noise) : noise_(noise) {}  // dBm
  ~Ns3Radios();
  Ns3Radios(const Ns3Radios&) = delete;
  Ns3Radios& operator=(const Ns3Radios&) = delete;

  void init(const World& world, std::uint64_t seed);
  // Creates the radios that joined; the caller sets their frame callbacks.
  void moved(const World& world);
  const std::vector<Ns3Radio>& all() const { return radios_; }
  void advance(double until);

  // Since the simulation began; ns-3 counts nanoseconds.
  ns3::Time at(double time) const;
  double now() const;  // s, of the world
  ns3::Time until(double time) const { return std::max(at(time) - ns3::Simulator::Now(), ns3::Time(0)); }
  double rssi(std::size_t from, std::size_t to) const { return loss_->rssi(from, to); }

  static ns3::Mac16Address address_of(std::size_t radio);
  static std::size_t radio_at(const ns3::Mac16Address& address);

 private:
  void join();

  double noise_, start_ = 0;
  World world_;
  ns3::Ptr<OurLoss> loss_;
  ns3::Ptr<ns3::SingleModelSpectrumChannel> channel_;
  std::vector<Ns3Radio> radios_;
};

}  // namespace muster::external
