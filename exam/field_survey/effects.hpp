// What is wrong in a campaign: each effect edits the map (what the examinee is told) or the truth.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exam/field_survey/campaign.hpp"

namespace muster::exam::survey {

struct Value {
  std::string name;
  double value = 0;
  std::string unit;
};

struct Planted {
  std::string id;
  bool in_vocabulary = true;
  std::string acts = "mean";              // or receiver, reading_law
  std::vector<std::string> rows{};        // of the world: radio/mast1, wall/w3
  std::vector<std::string> covariates{};  // accepted reports of it as unexplained; "a*b" a product
  std::vector<std::string> also{};        // further names that are right
  std::vector<std::string> kin{};         // names that are right by class
  std::vector<Value> values{};
  std::function<void(Scene& map, Scene& truth)> apply{};
  double lambda = 0;
};

struct Kind {
  const char* id;
  // Empty where the campaign cannot have it.
  std::optional<Planted> (*draw)(const Campaign&, Draws&);
  bool in_vocabulary = true;
};

// Effects of the map, of radios, of the way of waves, of time, of receivers.
const std::vector<Kind>& kinds();

std::vector<Kind> map_kinds();
std::vector<Kind> radio_kinds();
std::vector<Kind> wave_kinds();
std::vector<Kind> time_kinds();
std::vector<Kind> receiver_kinds();

}  // namespace muster::exam::survey
