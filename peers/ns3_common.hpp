// What both of ns-3's radios have in common.
#pragma once

#include <ns3/core-module.h>
#include <ns3/mobility-module.h>
#include <ns3/network-module.h>
#include <ns3/propagation-module.h>

#include <ctime>
#include <functional>

#include "peers/ns3.hpp"

namespace muster::peers {

inline ns3::NodeContainer nodes_at(const Task& task) {
  ns3::RngSeedManager::SetRun(task.run);
  ns3::NodeContainer nodes;
  nodes.Create(static_cast<uint32_t>(task.places.size()));
  for (uint32_t i = 0; i < nodes.GetN(); ++i) {
    auto place = ns3::CreateObject<ns3::ConstantPositionMobilityModel>();
    place->SetPosition({task.places[i][0], task.places[i][1], 1});
    nodes.Get(i)->AggregateObject(place);
  }
  return nodes;
}

inline ns3::Ptr<ns3::LogDistancePropagationLossModel> loss() {
  auto model = ns3::CreateObject<ns3::LogDistancePropagationLossModel>();
  model->SetAttribute("Exponent", ns3::DoubleValue(3));
  model->SetAttribute("ReferenceLoss", ns3::DoubleValue(40));
  return model;
}

inline double cpu_time() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Runs the simulation while `send(from)` is called for each request at its time; CPU time.
inline double run_ns3(const Task& task, const std::function<void(uint32_t)>& send) {
  std::size_t next = 0;
  const auto wait = [&](const auto& again) {
    if (next == task.requests.size()) return;
    const ns3::Time after = ns3::Seconds(task.requests[next].at) - ns3::Simulator::Now();
    ns3::Simulator::ScheduleWithContext(task.requests[next].from, after, [&] {
      send(task.requests[next++].from);
      again(again);
    });
  };
  wait(wait);
  ns3::Simulator::Stop(ns3::Seconds(task.seconds));
  const double before = cpu_time();
  ns3::Simulator::Run();
  const double took = cpu_time() - before;
  ns3::Simulator::Destroy();
  return took;
}

}  // namespace muster::peers
