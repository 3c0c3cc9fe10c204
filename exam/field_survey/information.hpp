// Lambda of each planted effect: twice the expected log-likelihood ratio of the truth, with its true covariance,
// against the best that the map, its level, exponent and losses of materials, and the other effects can do.
#pragma once

#include <Eigen/Core>

#include "exam/field_survey/campaign.hpp"

namespace muster::exam::survey {

// Covariance of readings: an exponential field over the places of the end that moves, one for each other end; a
// constant of place and link; and an error of each reading. Exact: means of the readings of a cell, and what is left
// beside these, are independent.
class Covariance {
 public:
  Covariance(const Campaign& campaign, const Scatter& scatter, const std::vector<char>& used);
  // Columns over all rows; of unit covariance afterwards.
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& columns) const;
  // One draw of the field and the frozen part, by cell.
  Eigen::VectorXd draw_cells(Draws& draws) const;
  int cells() const { return cells_; }

 private:
  std::vector<int> cell_of_;                   // by row; -1: not used
  std::vector<int> count_;                     // readings of a cell
  std::vector<std::vector<int>> groups_;       // cells that share a field
  std::vector<Eigen::MatrixXd> field_, root_;  // by group, without and with the error of the cells' means
  double reading_ = 1, frozen_ = 0;            // dB
  bool has_field_ = false;
  int cells_ = 0;
};

// Squared length of `effect`, both whitened, that no combination of `others` reaches.
double unexplained_energy(const Eigen::VectorXd& effect, const Eigen::MatrixXd& others);

// Constant, -10 log10 distance, and -walls of each material, by the map.
Eigen::MatrixXd map_columns(const Scene& map, const std::vector<Row>& rows);

}  // namespace muster::exam::survey
