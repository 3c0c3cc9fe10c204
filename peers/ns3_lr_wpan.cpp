#include <ns3/lr-wpan-module.h>
#include <ns3/spectrum-module.h>

#include "peers/ns3_common.hpp"

namespace muster::peers {
namespace {

Counts* counts = nullptr;  // of the run: ns-3's callbacks are functions

void count_arrival(ns3::McpsDataIndicationParams, ns3::Ptr<ns3::Packet>) { ++counts->arrived; }
void count_end(ns3::McpsDataConfirmParams confirm) {
  if (confirm.m_status == ns3::IEEE_802_15_4_CHANNEL_ACCESS_FAILURE) ++counts->no_access;
}

using Devices = std::vector<ns3::Ptr<ns3::LrWpanNetDevice>>;

// Their short addresses are 1, 2, ...
Devices devices_of(const Task& task) {
  const ns3::NodeContainer nodes = nodes_at(task);
  auto channel = ns3::CreateObject<ns3::SingleModelSpectrumChannel>();
  channel->AddPropagationLossModel(loss());
  channel->SetPropagationDelayModel(ns3::CreateObject<ns3::ConstantSpeedPropagationDelayModel>());
  ns3::LrWpanSpectrumValueHelper spectrum;
  Devices devices;
  for (uint32_t i = 0; i < nodes.GetN(); ++i) {
    auto device = ns3::CreateObject<ns3::LrWpanNetDevice>();
    device->SetChannel(channel);
    nodes.Get(i)->AddDevice(device);
    const uint8_t address[] = {static_cast<uint8_t>((i + 1) >> 8), static_cast<uint8_t>(i + 1)};
    ns3::Mac16Address short_address;
    short_address.CopyFrom(address);
    device->SetAddress(short_address);
    device->GetMac()->SetPanId(0);
    device->GetPhy()->SetMobility(nodes.Get(i)->GetObject<ns3::MobilityModel>());
    device->GetPhy()->SetTxPowerSpectralDensity(spectrum.CreateTxPowerSpectralDensity(0, 11));
    device->GetPhy()->SetNoisePowerSpectralDensity(spectrum.CreateNoisePowerSpectralDensity(11));
    devices.push_back(device);
  }
  return devices;
}

ns3::McpsDataRequestParams request_to(const char* address) {
  ns3::McpsDataRequestParams request;
  request.m_dstPanId = 0;
  request.m_srcAddrMode = request.m_dstAddrMode = ns3::SHORT_ADDR;
  request.m_dstAddr = ns3::Mac16Address(address);
  request.m_txOptions = ns3::TX_OPTION_NONE;
  return request;
}

}  // namespace

Counts ns3_lr_wpan(const Task& task) {
  Counts result;
  counts = &result;
  const Devices devices = devices_of(task);
  for (const auto& device : devices) {
    device->GetMac()->SetMcpsDataIndicationCallback(ns3::MakeCallback(&count_arrival));
    device->GetMac()->SetMcpsDataConfirmCallback(ns3::MakeCallback(&count_end));
  }
  result.cpu = run_ns3(task, [&](uint32_t i) {
    devices[i]->GetMac()->McpsDataRequest(request_to("ff:ff"), ns3::Create<ns3::Packet>(task.payload));
  });
  return result;
}

Counts ns3_star(const Task& task, int order) {
  Counts result;
  counts = &result;
  const Devices devices = devices_of(task);
  const auto coordinator = devices[0]->GetMac();
  coordinator->SetMcpsDataIndicationCallback(ns3::MakeCallback(&count_arrival));
  ns3::MlmeStartRequestParams start;
  start.m_PanId = 0;
  start.m_logCh = 11;
  start.m_bcnOrd = start.m_sfrmOrd = static_cast<uint8_t>(order);
  start.m_panCoor = true;
  ns3::Simulator::ScheduleWithContext(0, ns3::Seconds(0), [=] { coordinator->MlmeStartRequest(start); });
  for (std::size_t i = 1; i < devices.size(); ++i) {
    const auto mac = devices[i]->GetMac();
    mac->SetAssociatedCoor(ns3::Mac16Address("00:01"));
    const auto ask = [=] { mac->McpsDataRequest(request_to("00:01"), ns3::Create<ns3::Packet>(task.payload)); };
    mac->SetMcpsDataConfirmCallback([=](ns3::McpsDataConfirmParams confirm) {
      count_end(confirm);
      ns3::Simulator::ScheduleNow(ask);
    });
    ns3::Simulator::ScheduleWithContext(static_cast<uint32_t>(i), ns3::Seconds(1), ask);
  }
  result.cpu = run_ns3(task, [](uint32_t) {});
  return result;
}

}  // namespace muster::peers
