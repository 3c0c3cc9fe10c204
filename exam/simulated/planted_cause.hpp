// A cause plugin of the simulator as an element of a world: the exam's generator `run` plants it with parameters drawn
// for the case's plan and tour.
#pragma once

#include <optional>

#include "exam/ground_truth.hpp"

namespace muster::exam::simulated {

struct Attribute {
  std::string name;
  double value = 0;
  std::string unit{};
};

enum class Acts { mean = 1, receiver, reading_law, field_law, blockage };

struct PlantedCause {
  std::string id;  // without "effect."
  Acts acts = Acts::mean;
  std::vector<std::pair<std::string, std::string>> texts{};  // radio="beacon1"
  std::vector<Attribute> numbers{};
  std::string size{};            // the attribute that its shift is proportional to, where there is one
  double least = 0, most = 1e9;  // of its absolute value
  std::vector<std::string> rows{}, also{}, kin{};
  double lambda = 0, wanted = 0;

  std::string element() const;
  double number(const std::string& name) const;
  void scale(double factor);
};

// What the drawing of a cause needs to know.
struct Setting {
  const GroundTruth& site;
  const Data& data;
  Eigen::VectorXd expected;                               // level in dBm of each reading without any cause
  double shadowing = 0, decorrelation = 1, rician_k = 6;  // of the world
  bool fades_by_reading = false;
  bool both_ways = false;
  bool counts_walls = false;  // no plan in the world, numbers of walls in the data
};

struct CauseKind {
  const char* id;
  SiteNeeds needs;
  // Empty where the world cannot have it.
  std::optional<PlantedCause> (*draw)(const Setting&, Random&);
};

// Every cause plugin of plugins/causes.
const std::vector<CauseKind>& cause_kinds();

std::vector<CauseKind> radio_causes();
std::vector<CauseKind> building_causes();
std::vector<CauseKind> time_causes();
std::vector<CauseKind> law_causes();

}  // namespace muster::exam::simulated
