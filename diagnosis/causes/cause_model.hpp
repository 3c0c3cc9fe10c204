// Evaluates named causes by the simulator: the dB that each adds to the level of every measured reading.
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/prediction/measured_world.hpp"

namespace muster::diagnosis {

// A plugin with a `muster_cause`.
struct Cause {
  std::string id;  // "effect.step", without its revision
  std::shared_ptr<Library> library;
  const muster_plugin* plugin = nullptr;  // the newest revision; lives as long as the library

  const muster_cause& meaning() const { return *plugin->cause; }
  // `name`: a declared parameter.
  const muster_param& parameter(const std::string& name) const;
  // Parameters that the effect is proportional to.
  std::vector<const muster_param*> linear() const;
  // References to the rows that it concerns: none, one, or two (of radios).
  std::vector<const muster_param*> rows() const;
  // The parameter of the table that it reads, or null.
  const muster_param* file() const;
  // True if its effect depends on other instances, so that it is evaluated in the whole world.
  bool needs_world() const;
  // True if it is no term beside others, but judged in a world that has it (MUSTER_OWN_WORLD).
  bool needs_own_world() const;
  // True if it is about radios that send and receive alone (MUSTER_BOTH_ENDS).
  bool needs_both_ends() const;
};

// All causes on the plugin path, sorted by id. Libraries that cannot be loaded are left out.
std::vector<Cause> causes_on(const Library::SearchPath& plugins);

// Rows that one instance concerns, one for each reference; an empty name for none.
using CauseRow = std::vector<std::string>;

// An instance with the names of `row`, the file `table`, default values of required numbers, and `linear` for each
// linear parameter.
InstanceDeclaration instance_of(const Cause& cause, const std::string& name, const CauseRow& row,
                                const std::filesystem::path& table, double linear, const Place& place);

// Texts whose default is the id of a plugin ("of" radio.fading) with the name of the world's instance of it, where that
// has another one.
std::map<std::string, std::string> names_of_instances(const Cause& cause, const Simulation& world);

// Evaluates causes on the measured links in two worlds. The bare world has only rows and their edits, for terms that
// depend on no other instance. In the whole world, an effect is the difference that its instance makes to the expected
// level.
class CauseModel {
 public:
  // `whole`: a world with the measured links of `data`; unchanged after clear(). Throws Error.
  CauseModel(MeasuredWorld& whole, const std::filesystem::path& world, const std::filesystem::path& data,
             const Library::SearchPath& plugins);

  // Fills `column` with the dB that an instance of the cause on rows[row], at these parameters, adds to each of
  // `readings`.
  void fill(const Cause& cause, const std::vector<CauseRow>& rows, std::size_t row,
            const std::map<std::string, double>& parameters, const std::vector<Eigen::Index>& readings,
            Eigen::Ref<Eigen::VectorXd> column);
  // Removes all inserted instances from both worlds.
  void clear();

 private:
  struct Evaluated {  // all rows of a cause at the same parameters
    std::map<std::string, double> parameters;
    std::vector<Eigen::VectorXd> added;  // dB at every reading, one a row
  };
  struct Present {  // instances inserted in a world, beside its own
    std::string cause;
    std::size_t first = 0, count = 0;                 // rows
    std::optional<std::map<std::string, double>> at;  // parameters at which it was evaluated last
    std::vector<Evaluated> recent;                    // newest first
  };

  void put(Simulation& run, Present& present, const Cause& cause, const std::vector<CauseRow>& rows, std::size_t first,
           std::size_t count);
  void evaluate(Simulation& run, Present& present, const std::map<std::string, double>& parameters);
  // dB added by the instances in the bare world at these parameters, one vector a row.
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
