// Interface of a measurement domain to the search for causes: testable causes, their search ranges, their competition.
// The engine evaluates, whitens, scores and selects; a domain describes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/causes/start_grid.hpp"

namespace muster::diagnosis {

class CauseDomain {
 public:
  virtual ~CauseDomain() = default;

  // Reason why the data cannot test a cause; empty if they can.
  virtual std::string why_not(const Cause& cause) const = 0;
  // Rows of the world that a cause may concern; a single one without names for a cause without references.
  virtual std::vector<CauseRow> rows_for(const Cause& cause) const = 0;
  // Reason why rows_for() is empty.
  virtual std::string why_no_rows(const Cause& /*cause*/) const {
    return "not testable: the world has no row that it could be about";
  }
  // Fills shape.held with parameters that are fixed, not searched.
  virtual void hold(CauseShape& /*shape*/) const {}
  // Search range of a parameter; nothing if the data cannot identify it. `alone`: the only parameter searched.
  virtual std::optional<Axis> axis_of(const muster_param& declared, const CauseShape& shape, bool alone) const = 0;
  // Sets bounds and first steps of the place's entries.
  virtual void bound_place(const CauseShape& /*shape*/, inference::Refinement& /*out*/) const {}
  // Sets covariates, role, and starts, evaluations and charge of the refinement. Identity and design are already set.
  virtual void describe(const CauseShape& shape, inference::Candidate& out) const = 0;
  virtual std::vector<Eigen::VectorXd> starts_of(const CauseShape& shape, const inference::Candidate&) const {
    return start_grid(shape, {Eigen::VectorXd()});
  }
  // False where such an object is physically impossible.
  virtual bool admits(const CauseShape& /*shape*/, const inference::Candidate&,
                      const Eigen::VectorXd& /*theta*/) const {
    return true;
  }
  // Sets priors, moves and proposals of places, after the grid.
  virtual void finish(const std::shared_ptr<const CauseShape>& /*shape*/, inference::Candidate& /*out*/) const {}
};

}  // namespace muster::diagnosis
