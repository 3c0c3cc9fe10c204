// Named causes as the simulator executes them: what each adds to the level of every measured reading.
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>

#include "kernel/simulation.hpp"

namespace muster::diagnosis {

// A plugin that bears a `muster_cause`.
struct Cause {
  std::string id;  // "effect.step", without its revision
  std::shared_ptr<Library> library;
  const muster_plugin* plugin = nullptr;  // the newest revision; lives as long as the library

  const muster_cause& meaning() const { return *plugin->cause; }
  // Its parameters in words: the one that what it adds is proportional to, or null if there is not exactly one.
  const muster_param* linear() const;
  // The reference that says which row it is about, or null.
  const muster_param* row() const;
};

// All of the plugin path, by id. Libraries that cannot be loaded are left out.
std::vector<Cause> causes_on(const Library::SearchPath& plugins);

// A world that holds nothing but its rows, the measured links and one instance of a cause for each row it may be about.
class CauseModel {
 public:
  // An empty name stands for a cause that names no row. Throws Error.
  CauseModel(const Cause& cause, const std::filesystem::path& world, const std::filesystem::path& data,
             const Library::SearchPath& plugins, const std::vector<std::string>& rows,
             const std::map<std::string, double>& world_parameters);

  // dB that instance `row` adds to each reading, its linear parameter being 1 and the others as given.
  Eigen::VectorXd column(std::size_t row, const std::map<std::string, double>& parameters);

 private:
  static std::string name_of(std::size_t row) { return "cause" + std::to_string(row); }

  std::unique_ptr<Simulation> run_;
  std::size_t count_;
  std::map<std::string, double> now_;
  bool evaluated_ = false;
};

}  // namespace muster::diagnosis
