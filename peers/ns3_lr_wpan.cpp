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

}  // namespace

Counts ns3_lr_wpan(const Task& task) {
  Counts result;
  counts = &result;
  const ns3::NodeContainer nodes = nodes_at(task);
  auto channel = ns3::CreateObject<ns3::SingleModelSpectrumChannel>();
  channel->AddPropagationLossModel(loss());
  channel->SetPropagationDelayModel(ns3::CreateObject<ns3::ConstantSpeedPropagationDelayModel>());
  ns3::LrWpanSpectrumValueHelper spectrum;
  std::vector<ns3::Ptr<ns3::LrWpanNetDevice>> devices;
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
    device->GetMac()->SetMcpsDataIndicationCallback(ns3::MakeCallback(&count_arrival));
    device->GetMac()->SetMcpsDataConfirmCallback(ns3::MakeCallback(&count_end));
    devices.push_back(device);
  }
  result.cpu = run_ns3(task, [&](uint32_t i) {
    ns3::McpsDataRequestParams request;
    request.m_dstPanId = 0;
    request.m_srcAddrMode = request.m_dstAddrMode = ns3::SHORT_ADDR;
    request.m_dstAddr = ns3::Mac16Address("ff:ff");
    request.m_txOptions = ns3::TX_OPTION_NONE;
    devices[i]->GetMac()->McpsDataRequest(request, ns3::Create<ns3::Packet>(task.payload));
  });
  return result;
}

}  // namespace muster::peers
