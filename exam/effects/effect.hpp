// Hidden effects: what a case's truth has and its world file has not. Each is an ordinary function of readings and of
// one strength, by which it is made as heavy as the exam wants. Nothing here is shared with the plugins that diagnose
// them.
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
  bool linear = true;               // in its strength
  double least = 0.1, most = 25;    // of its strength
  std::vector<std::string> rows{};  // of the world that it is about: "radio/beacon2", "wall/w7"
  std::vector<std::string>
      covariates{};                 // outside the vocabulary: names under which it may be reported; "a*b" a product
  std::vector<std::string> also{};  // other names in the vocabulary of the very same shift of readings

  // dB on every reading; of what comes at times that nobody knows, a column for each time that it comes.
  std::function<Eigen::VectorXd(const Data&, double strength)> shift{};
  std::function<Eigen::MatrixXd(const Data&, double strength)> passages{};
  // What the receiver reports for a level in dBm; NaN: nothing.
  std::function<double(double level, double strength)> receive{};
  std::function<void(ReadingLaw&, double strength)> change_reading{};
  std::function<void(FieldLaw&, double strength)> change_field{};
  std::function<std::vector<Parameter>(double strength)> parameters{};
  // Whose shadowing a reading has; by default its station's.
  std::function<int(const Reading&)> field_of{};
};

// What an effect may look at while it is drawn.
struct Scene {
  const Site& site;
  const Data& measured;
  const Data& second;
};

struct Recipe {
  const char* id;
  bool in_vocabulary;
  SiteNeeds needs;
  Effect (*draw)(const Scene&, Random&);
};

// All of them; the files effects_*.cpp hold them by what they are about.
const std::vector<Recipe>& recipes();
const Recipe& recipe(const std::string& id);

std::vector<Recipe> radio_recipes();
std::vector<Recipe> map_recipes();
std::vector<Recipe> distance_recipes();
std::vector<Recipe> time_recipes();
std::vector<Recipe> receiver_recipes();
std::vector<Recipe> outside_recipes();

// strength x shape(reading), the shape being a function of one reading.
template <class Shape>
auto scaled(Shape shape) {
  return [shape](const Data& data, double strength) {
    Eigen::VectorXd result(static_cast<Eigen::Index>(data.size()));
    for (std::size_t i = 0; i < data.size(); ++i)
      result[static_cast<Eigen::Index>(i)] = strength * shape(data.readings[i]);
    return result;
  };
}

inline std::string radio_row(const Site& site, int station) {
  return "radio/" + site.plan.stations[static_cast<std::size_t>(station)].name;
}
inline std::string robot_name(int robot) { return "robot" + std::to_string(robot + 1); }

}  // namespace muster::exam
