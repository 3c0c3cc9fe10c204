// ns-3's path loss between radios in an office of rooms: log-distance, and HybridBuildings, which takes walls by
// counting rooms and draws a shadowing for each ordered pair once.
#pragma once

#include <ns3/buildings-module.h>
#include <ns3/core-module.h>
#include <ns3/mobility-module.h>
#include <ns3/propagation-module.h>

#include <vector>

#include "scene/walls.hpp"

namespace muster::bench {

class Ns3Channel {
 public:
  Ns3Channel(const std::vector<scene::Point>& points, double length, double width, int rooms_x, int rooms_y) {
    using namespace ns3;
    building_ = CreateObject<Building>();
    building_->SetBoundaries(Box(0, length, 0, width, 0, 9));
    building_->SetNFloors(3);
    building_->SetNRoomsX(static_cast<std::uint16_t>(rooms_x));
    building_->SetNRoomsY(static_cast<std::uint16_t>(rooms_y));
    nodes_.Create(static_cast<std::uint32_t>(points.size()));
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const auto place = CreateObject<ConstantPositionMobilityModel>();
      nodes_.Get(i)->AggregateObject(place);
      place->SetPosition(Vector(points[i].x, points[i].y, points[i].z));
      BuildingsHelper::Install(nodes_.Get(i));
      place->GetObject<MobilityBuildingInfo>()->MakeConsistent(place);
      places_.push_back(place);
    }
    log_distance_ = CreateObject<LogDistancePropagationLossModel>();
    log_distance_->SetAttribute("ReferenceLoss", DoubleValue(40));
    log_distance_->SetAttribute("Exponent", DoubleValue(2));
    hybrid_ = CreateObject<HybridBuildingsPropagationLossModel>();
    hybrid_->SetAttribute("Frequency", DoubleValue(2.44e9));
  }

  Ns3Channel(const Ns3Channel&) = delete;
  Ns3Channel& operator=(const Ns3Channel&) = delete;
  ~Ns3Channel() { ns3::Simulator::Destroy(); }  // or its buildings stand in the next one's way

  void move(double x) {
    for (const auto& place : places_) {
      ns3::Vector at = place->GetPosition();
      at.x += x;
      place->SetPosition(at);
    }
  }

  // Received power in dBm at 0 dBm of each ordered pair, by sender.
  void hybrid(std::vector<double>& levels) const { all(*hybrid_, levels); }
  void log_distance(std::vector<double>& levels) const { all(*log_distance_, levels); }

 private:
  void all(const ns3::PropagationLossModel& model, std::vector<double>& levels) const {
    levels.clear();
    for (const auto& from : places_) {
      for (const auto& to : places_) {
        if (from != to) levels.push_back(model.CalcRxPower(0, from, to));
      }
    }
  }

  ns3::Ptr<ns3::Building> building_;
  ns3::NodeContainer nodes_;
  std::vector<ns3::Ptr<ns3::MobilityModel>> places_;
  ns3::Ptr<ns3::PropagationLossModel> log_distance_, hybrid_;
};

}  // namespace muster::bench
