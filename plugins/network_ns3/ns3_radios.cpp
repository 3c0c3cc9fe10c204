#include "ns3_radios.hpp"

#include <ns3/core-module.h>

#include <algorithm>
#include <cmath>

namespace muster::external {
namespace {

constexpr double nothing = -1000;       // dBm
constexpr double ns3_noise = -106.987;  // dBm, of 5 MHz at 290 K
constexpr unsigned channel_number = 11;

}  // namespace

void OurLoss::set(const World& world) {
  world_ = &world;
  rssi_.resize(world.radios());
  for (auto& row : rssi_) row.resize(world.radios());
}

double OurLoss::DoCalcRxPower(double tx_power, ns3::Ptr<ns3::MobilityModel> a, ns3::Ptr<ns3::MobilityModel> b) const {
  const std::size_t from = numbers_.at(ns3::PeekPointer(a)), to = numbers_.at(ns3::PeekPointer(b));
  const std::size_t link = world_->link(from, to);
  rssi_[from][to] = world_->rssi[link];
  const bool both = world_->alive[from] && world_->alive[to];
  return both ? std::max(nothing, tx_power + world_->level[link]) : nothing;
}

Ns3Radios::~Ns3Radios() {
  if (channel_) ns3::Simulator::Destroy();
}

void Ns3Radios::init(const World& world, std::uint64_t seed) {
  start_ = world.time;
  ns3::RngSeedManager::SetSeed(static_cast<std::uint32_t>(seed % 4294967087u) + 1);
  ns3::RngSeedManager::SetRun(1);
  loss_ = ns3::CreateObject<OurLoss>();
  channel_ = ns3::CreateObject<ns3::SingleModelSpectrumChannel>();
  channel_->SetAttribute("MaxLossDb", ns3::DoubleValue(300));
  channel_->AddPropagationLossModel(loss_);
  channel_->SetPropagationDelayModel(ns3::CreateObject<ns3::ConstantSpeedPropagationDelayModel>());
}

void Ns3Radios::moved(const World& world) {
  world_ = world;
  while (radios_.size() < world.radios()) join();
  for (std::size_t i = 0; i < radios_.size(); ++i) {
    const auto& [x, y, z] = world.places[i];
    radios_[i].place->SetPosition({x, y, z});
    radios_[i].device->GetMac()->SetPanId(world.pans[i]);
  }
  loss_->set(world_);
}

void Ns3Radios::join() {
  const std::size_t number = radios_.size();
  Ns3Radio radio{ns3::CreateObject<ns3::Node>(), ns3::CreateObject<ns3::ConstantPositionMobilityModel>(),
                 ns3::CreateObject<ns3::LrWpanNetDevice>()};
  radio.device->SetChannel(channel_);
  radio.node->AggregateObject(radio.place);
  radio.node->AddDevice(radio.device);
  ns3::LrWpanSpectrumValueHelper spectrum;
  auto phy = radio.device->GetPhy();
  phy->SetMobility(radio.place);
  phy->SetTxPowerSpectralDensity(spectrum.CreateTxPowerSpectralDensity(0, channel_number));
  auto noise = spectrum.CreateNoisePowerSpectralDensity(channel_number);
  *noise *= std::pow(10, (noise_ - ns3_noise) / 10);
  phy->SetNoisePowerSpectralDensity(noise);
  radio.device->SetAddress(address_of(number));
  radio.device->AssignStreams(static_cast<int64_t>(16 * number));
  loss_->join(ns3::PeekPointer(radio.place));
  radios_.push_back(std::move(radio));
}

void Ns3Radios::advance(double time) {
  ns3::Simulator::Stop(at(time) - ns3::Simulator::Now());
  ns3::Simulator::Run();
}

ns3::Time Ns3Radios::at(double time) const { return ns3::NanoSeconds(std::llround(1e9 * (time - start_))); }
double Ns3Radios::now() const { return start_ + ns3::Simulator::Now().GetSeconds(); }

ns3::Mac16Address Ns3Radios::address_of(std::size_t radio) {
  const std::uint8_t bytes[] = {static_cast<std::uint8_t>((radio + 1) >> 8), static_cast<std::uint8_t>(radio + 1)};
  ns3::Mac16Address result;
  result.CopyFrom(bytes);
  return result;
}

std::size_t Ns3Radios::radio_at(const ns3::Mac16Address& address) {
  std::uint8_t bytes[2];
  address.CopyTo(bytes);
  return (std::size_t{bytes[0]} << 8 | bytes[1]) - 1;
}

}  // namespace muster::external
