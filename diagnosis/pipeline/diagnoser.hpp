// One diagnosis of a table of readings by one world: search, laws of scatter, joint refit, advice.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/inference/assess/search.hpp"
#include "diagnosis/pipeline/own_world.hpp"
#include "diagnosis/pipeline/setup.hpp"
#include "diagnosis/result.hpp"

namespace muster::diagnosis {

class Diagnoser {
 public:
  // Laws of the cause `without_law` are not tested.
  Diagnoser(const std::filesystem::path& world, const std::filesystem::path& file, const Library::SearchPath& plugins,
            const std::shared_ptr<TableCache>& tables, const inference::Watch& watch, const Earlier& earlier = {},
            const std::string& without_law = "");

  // `given`: the diagnosis of the given world, if this world is corrected for its first cause. `by_itself`: the gain of
  // that cause is what it changes before all else, in either world.
  Diagnosis run(const Diagnosis* given = nullptr, bool by_itself = false);

  // The exchange of two radios that explains what that cause does, if it does so better.
  std::optional<CauseEstimate> exchange(const CauseEstimate& instead_of, const Diagnosis& found);
  OwnWorldVerdict in_own_worlds(const Diagnosis& found);

 private:
  Diagnosis summed_up(const inference::Result& result, const CauseSearch& causes, const inference::ModelState& state);
  std::vector<AddedRadio> added_radios() const;
  void doubt_by_maps(const CauseSearch& causes, Diagnosis& out) const;
  void doubt_at_bounds(Diagnosis& out) const;
  std::pair<inference::Finding, const CauseCandidate*> simplest(const inference::Finding& f,
                                                                const CauseCandidate& cause, const CauseSearch& causes,
                                                                const inference::ModelState& state,
                                                                const Eigen::VectorXd& base);
  void add_what_scatters(const inference::ModelState& state, Diagnosis& out);
  Eigen::VectorXd measured(const inference::ModelState& state) const;
  Eigen::VectorXd extend(const inference::ModelState& state, Diagnosis& out);

  const inference::Watch& watch_;
  DiagnosisSetup setup_;
  ParameterGuard moved_;       // from the fit to the joint refit, until the end of the diagnosis
  std::vector<Cause> causes_;  // laws among them are tested
  std::filesystem::path world_;
  Library::SearchPath plugins_;
};

// By status, sure ones first, then by what they gain in held-out data, or explain.
void in_order(Diagnosis& found);

// With a note of that.
Diagnosis interrupted(Diagnosis found);

}  // namespace muster::diagnosis
