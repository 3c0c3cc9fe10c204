// The nine sets of ../shared/data/radio_field: what is known of each (radio_field.json), and what muster diagnose
// reports.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace muster::real_data {

// What other evidence says of a set.
struct Known {
  std::string set;
  std::string words;
  std::string first{};    // pattern of "ID LABEL" of the first causes; empty: no name is known for it
  std::size_t count = 1;  // first causes that must match
  bool held = false;      // found first by now, so that it must remain so
  std::string never{};    // pattern of causes that are false there
  std::string verdict_not{};
};

// ../shared/data/radio_field; does not exist where the data are not there.
std::filesystem::path field_data();

// All sets in the order of the file, or those named. Throws std::runtime_error for an unknown name.
std::vector<Known> known_sets(const std::vector<std::string>& names = {});

// A run of muster diagnose --json.
struct Run {
  nlohmann::json report;
  double cpu = 0;     // s
  double memory = 0;  // MB, at most
};

// Throws std::runtime_error if the program fails.
Run diagnosed(const std::string& set);

// True if the known cause, or each of them, comes first.
bool found_first(const Known& known, const nlohmann::json& report);

}  // namespace muster::real_data
