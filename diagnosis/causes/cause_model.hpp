// Named causes as the simulator executes them: what each adds to the level of every measured reading.
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/prediction/measured_world.hpp"

namespace muster::diagnosis {

// A plugin that bears a `muster_cause`.
struct Cause {
  std::string id;  // "effect.step", without its revision
  std::shared_ptr<Library> library;
  const muster_plugin* plugin = nullptr;  // the newest revision; lives as long as the library

  const muster_cause& meaning() const { return *plugin->cause; }
  // One that it has.
  const muster_param& parameter(const std::string& name) const;
  // The parameters that what it adds is proportional to.
  std::vector<const muster_param*> linear() const;
  // The references that say which rows it is about: none, one, or two radios.
  std::vector<const muster_param*> rows() const;
  // The table that it reads, or null.
  const muster_param* file() const;
  // What other instances do is part of what it does: it has to be evaluated in the whole world.
  bool needs_world() const;
};

// All of the plugin path, by id. Libraries that cannot be loaded are left out.
std::vector<Cause> causes_on(const Library::SearchPath& plugins);

// The rows that one instance is about, one a reference; an empty name where it names none.
using CauseRow = std::vector<std::string>;

// An instance with its references, texts and required numbers as given; `linear` for each linear parameter.
InstanceDeclaration instance_of(const Cause& cause, const std::string& name, const CauseRow& row,
                                const std::filesystem::path& table, double linear, const Place& place);

// The measured links in two worlds: one that holds nothing but its rows, for terms that stand alone, and the whole one,
// in which a cause is the difference that its instance makes to the expected level.
class CauseModel {
 public:
  // `whole` has the measured links of `data` and stays as it is. Throws Error.
  CauseModel(MeasuredWorld& whole, const std::filesystem::path& world, const std::filesystem::path& data,
             const Library::SearchPath& plugins);

  // Fills `column` with the dB that an instance of the cause about rows[row] adds to these readings, the parameters
  // being as given.
  void fill(const Cause& cause, const std::vector<CauseRow>& rows, std::size_t row,
            const std::map<std::string, double>& parameters, const std::vector<Eigen::Index>& readings,
            Eigen::Ref<Eigen::VectorXd> column);
  // Takes away what still stands in either world.
  void clear();

 private:
  struct Evaluated {  // all rows of a cause at the same parameters
    std::map<std::string, double> parameters;
    std::vector<Eigen::VectorXd> added;  // dB at every reading, one a row
  };
  struct Present {  // what stands in a world beside its own instances
    std::string cause;
    std::size_t first = 0, count = 0;                 // rows
    std::optional<std::map<std::string, double>> at;  // parameters at which it was evaluated last
    std::vector<Evaluated> recent;                    // newest first
  };

  void put(Simulation& run, Present& present, const Cause& cause, const std::vector<CauseRow>& rows, std::size_t first,
           std::size_t count);
  void evaluate(Simulation& run, Present& present, const std::map<std::string, double>& parameters);
  // What stands in the bare world, at these parameters.
  const std::vector<Eigen::VectorXd>& added_at(const std::map<std::string, double>& parameters);
  static void remove(Simulation& run, Present& present);

  const Observable& observable_;
  Simulation& whole_;
  std::unique_ptr<Simulation> bare_;
  std::filesystem::path data_;
  Present in_whole_, in_bare_;
  Eigen::VectorXd before_;  // dBm: the whole world's expected level, without any cause
};

}  // namespace muster::diagnosis
