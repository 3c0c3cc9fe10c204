// Hidden effects: parts of a case's truth that its world file lacks. Each is an ordinary function of readings and of
// one strength, which sets its lambda. They share no code with the plugins that diagnose them.
#pragma once

#include <functional>

#include "exam/ground_truth.hpp"

namespace muster::exam {

struct Parameter {
  std::string name;
  double value = 0;
  std::string unit;
};

enum class Acts { mean = 1, receiver, reading_law, field_law };

struct Effect {
  std::string id;
  Acts acts = Acts::mean;
  bool linear = true;                     // in the strength
  double least = 0.1, most = 25;          // of the strength
  std::vector<std::string> rows{};        // the world's rows concerned: "radio/beacon2", "wall/w7"
  std::vector<std::string> covariates{};  // outside the vocabulary: accepted names for it; "a*b" a product
  std::vector<std::string> also{};        // other names in the vocabulary for the same shift of readings

  // dB on every reading. For events at unknown times (passages), one column for each event.
  std::function<Eigen::VectorXd(const Data&, double strength)> shift{};
  std::function<Eigen::MatrixXd(const Data&, double strength)> passages{};
  // Reported reading of a level in dBm; NaN: none.
  std::function<double(double level, double strength)> receive{};
  std::function<void(ReadingLaw&, double strength)> change_reading{};
  std::function<void(FieldLaw&, double strength)> change_field{};
  std::function<std::vector<Parameter>(double strength)> parameters{};
  // Index of a reading's shadowing field; by default its station.
  std::function<int(const Reading&)> field_of{};
};

// Inputs to the draw of an effect.
struct Scene {
  const GroundTruth& site;
  const Data& measured;
  const Data& second;
};

struct Recipe {
  const char* id;
  bool in_vocabulary;
  SiteNeeds needs;
  Effect (*draw)(const Scene&, Random&);
};

// All recipes, from the files effects_*.cpp, one for each kind.
const std::vector<Recipe>& recipes();
const Recipe& recipe(const std::string& id);

std::vector<Recipe> radio_recipes();
std::vector<Recipe> map_recipes();
std::vector<Recipe> distance_recipes();
std::vector<Recipe> time_recipes();
std::vector<Recipe> receiver_recipes();
std::vector<Recipe> outside_recipes();

// strength x shape(reading).
template <class Shape>
auto scaled(Shape shape) {
  return [shape](const Data& data, double strength) {
    Eigen::VectorXd result(static_cast<Eigen::Index>(data.size()));
    for (std::size_t i = 0; i < data.size(); ++i)
      result[static_cast<Eigen::Index>(i)] = strength * shape(data.readings[i]);
    return result;
  };
}

inline std::string radio_row(const GroundTruth& site, int station) {
  return "radio/" + site.plan.stations[static_cast<std::size_t>(station)].name;
}
inline std::string robot_name(int robot) { return "robot" + std::to_string(robot + 1); }

}  // namespace muster::exam
