// Describes a run's world for the page: walls, doors, floors, meshes, radios, and robots with their bodies.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "description/robot.hpp"
#include "kernel/simulation.hpp"
#include "text/json.hpp"

namespace muster::viewer {

class RunScene {
 public:
  // Take it before the first tick: places and doors are those of the start. `folders` are those of the plugins, in
  // which models are.
  RunScene(const Simulation& run, std::vector<std::filesystem::path> folders);

  // With the robots that joined on the way.
  Json json(const Simulation& run);
  // What could not be read, and is drawn otherwise.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  Json meshes(const Simulation& run);
  Json robots(const Simulation& run);
  void add_model(const std::string& model, const description::UrdfSetting& declared);

  std::vector<std::filesystem::path> folders_;
  Json fixed_;                              // walls, doors, floors, meshes, radios
  std::vector<std::vector<double>> poses_;  // of robots at the start
  std::map<std::string, Json> models_;
  std::vector<std::string> notes_;
};

// The chains that observe.chain watches: its table, and the columns with each link's RSSI.
Json chains_of(const Simulation& run);

}  // namespace muster::viewer
