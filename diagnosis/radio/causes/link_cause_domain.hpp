// Domain of causes on radio links: radios, walls and places that they may concern, and their competition.
#pragma once

#include "diagnosis/causes/cause_domain.hpp"
#include "diagnosis/data/dataset.hpp"
#include "diagnosis/inference/noise/rows.hpp"
#include "diagnosis/radio/links/link_model.hpp"
#include "diagnosis/radio/links/measurement_geometry.hpp"

namespace muster::diagnosis {

class LinkCauseDomain : public CauseDomain {
 public:
  // Keeps references to all. `used`: rows of the table behind the readings of the search; `rows`: of the search.
  LinkCauseDomain(const LinkModel& model, const Dataset& data, const std::vector<Eigen::Index>& used,
                  const noise::Rows& rows);

  std::string why_not(const Cause& cause) const override;
  std::vector<CauseRow> rows_for(const Cause& cause) const override;
  std::string why_no_rows(const Cause& cause) const override;
  void hold(CauseShape& shape) const override;
  std::optional<Axis> axis_of(const muster_param& declared, const CauseShape& shape, bool alone) const override;
  void bound_place(const CauseShape& shape, inference::Refinement& out) const override;
  void describe(const CauseShape& shape, inference::Candidate& out) const override;
  std::vector<Eigen::VectorXd> starts_of(const CauseShape& shape, const inference::Candidate& candidate) const override;
  bool admits(const CauseShape& shape, const inference::Candidate& candidate,
              const Eigen::VectorXd& theta) const override;
  void finish(const std::shared_ptr<const CauseShape>& shape, inference::Candidate& out) const override;

 private:
  bool tells_carrier() const;
  std::size_t given_sizes(const CauseShape& shape) const;
  double charge_of(const CauseShape& shape, const inference::Candidate& c) const;
  void believe_in_map(const CauseShape& shape, inference::Candidate& c) const;
  void let_scan(const CauseShape& shape, inference::Candidate& c) const;

  const LinkModel& model_;
  const Dataset& data_;
  const std::vector<Eigen::Index>& used_;
  const noise::Rows& rows_;
  MeasurementGeometry geometry_;
};

}  // namespace muster::diagnosis
