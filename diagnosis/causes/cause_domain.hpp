// Interface of a kind of measurement to the search for causes: which causes its data can test, over what, and how they
// compete. The engine evaluates, whitens, scores and selects; a domain describes.
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
  // Rows of the world that a cause may be about; one without names where it is about none.
  virtual std::vector<CauseRow> rows_for(const Cause& cause) const = 0;
  // Reason why there are none.
  virtual std::string why_no_rows(const Cause& /*cause*/) const {
    return "not testable: the world has no row that it could be about";
  }
  // Parameters that are set and not sought, into shape.held.
  virtual void hold(CauseShape& /*shape*/) const {}
  // Search range of a parameter; nothing if the data cannot identify it. `alone`: it is the only one.
  virtual std::optional<Axis> axis_of(const muster_param& declared, const CauseShape& shape, bool alone) const = 0;
  // Bounds and first steps of the place's entries.
  virtual void bound_place(const CauseShape& /*shape*/, inference::Refinement& /*out*/) const {}
  // Covariates and role; starts, evaluations and charge of the refinement. Identity and design are there.
  virtual void describe(const CauseShape& shape, inference::Candidate& out) const = 0;
  virtual std::vector<Eigen::VectorXd> starts_of(const CauseShape& shape, const inference::Candidate&) const {
    return start_grid(shape, {Eigen::VectorXd()});
  }
  // False where no such object can be.
  virtual bool admits(const CauseShape& /*shape*/, const inference::Candidate&,
                      const Eigen::VectorXd& /*theta*/) const {
    return true;
  }
  // Priors, moves and proposals of places, once the grid is there.
  virtual void finish(const std::shared_ptr<const CauseShape>& /*shape*/, inference::Candidate& /*out*/) const {}
};

}  // namespace muster::diagnosis
