#include <ns3/wifi-module.h>

#include "peers/ns3_common.hpp"

namespace muster::peers {
namespace {

Counts* counts = nullptr;  // of the run: ns-3's callbacks are functions

bool count_arrival(ns3::Ptr<ns3::NetDevice>, ns3::Ptr<const ns3::Packet>, uint16_t, const ns3::Address&) {
  ++counts->arrived;
  return true;
}

}  // namespace

Counts ns3_wifi(const Task& task, unsigned mbit) {
  Counts result;
  counts = &result;
  const ns3::NodeContainer nodes = nodes_at(task);
  ns3::Config::SetDefault("ns3::WifiMacQueue::MaxDelay", ns3::TimeValue(ns3::Seconds(1e6)));
  ns3::Config::SetDefault("ns3::WifiMacQueue::MaxSize", ns3::QueueSizeValue(ns3::QueueSize("1000000p")));
  auto channel = ns3::CreateObject<ns3::YansWifiChannel>();
  channel->SetPropagationLossModel(loss());
  channel->SetPropagationDelayModel(ns3::CreateObject<ns3::ConstantSpeedPropagationDelayModel>());
  ns3::YansWifiPhyHelper phy;
  phy.SetChannel(channel);
  phy.SetErrorRateModel("ns3::NistErrorRateModel");
  ns3::WifiHelper wifi;
  wifi.SetStandard(ns3::WIFI_STANDARD_80211g);
  const ns3::StringValue mode("ErpOfdmRate" + std::to_string(mbit) + "Mbps");
  wifi.SetRemoteStationManager("ns3::ConstantRateWifiManager", "DataMode", mode, "NonUnicastMode", mode);
  ns3::WifiMacHelper mac;
  mac.SetType("ns3::AdhocWifiMac");
  const ns3::NetDeviceContainer devices = wifi.Install(phy, mac, nodes);
  for (uint32_t i = 0; i < devices.GetN(); ++i) devices.Get(i)->SetReceiveCallback(ns3::MakeCallback(&count_arrival));
  result.cpu = run_ns3(task, [&](uint32_t i) {
    devices.Get(i)->Send(ns3::Create<ns3::Packet>(task.payload), devices.Get(i)->GetBroadcast(), 0x88b5);
  });
  counts = nullptr;
  return result;
}

}  // namespace muster::peers
