#include "exam/field_survey/information.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <map>

namespace muster::exam::survey {

Covariance::Covariance(const Campaign& campaign, const Scatter& scatter, const std::vector<char>& used)
    : reading_(std::sqrt(scatter.reading * scatter.reading + scatter.step * scatter.step / 12)),
      frozen_(scatter.frozen),
      has_field_(scatter.frozen > 0 || scatter.shadowing > 0) {
  for (const Row& row : campaign.rows) cells_ = std::max(cells_, row.cell + 1);
  std::vector<Point> at(static_cast<std::size_t>(cells_));
  std::vector<int> field(static_cast<std::size_t>(cells_), -1);
  count_.assign(static_cast<std::size_t>(cells_), 0);
  for (std::size_t i = 0; i < campaign.rows.size(); ++i) {
    const Row& row = campaign.rows[i];
    const auto cell = static_cast<std::size_t>(row.cell);
    cell_of_.push_back(used[i] ? row.cell : -1);
    count_[cell] += used[i] ? 1 : 0;
    at[cell] = row.mobile;
    // Of the other end; without an end that moves each cell is by itself.
    const bool tx_moves = campaign.scene.radios[static_cast<std::size_t>(row.tx)].moves,
               rx_moves = campaign.scene.radios[static_cast<std::size_t>(row.rx)].moves;
    field[cell] = scatter.shadowing > 0 && (tx_moves || rx_moves) ? (tx_moves ? row.rx : row.tx) : -1;
  }
  std::map<int, std::vector<int>> groups;
  for (int c = 0; c < cells_; ++c) {
    if (field[static_cast<std::size_t>(c)] >= 0)
      groups[field[static_cast<std::size_t>(c)]].push_back(c);
    else
      groups_.push_back({c});
  }
  for (const auto& [other, cells] : groups) groups_.push_back(cells);
  for (const std::vector<int>& cells : groups_) {
    const auto size = static_cast<Eigen::Index>(cells.size());
    Eigen::MatrixXd own(size, size);
    for (Eigen::Index i = 0; i < size; ++i)
      for (Eigen::Index j = 0; j < size; ++j) {
        const auto a = static_cast<std::size_t>(cells[static_cast<std::size_t>(i)]),
                   b = static_cast<std::size_t>(cells[static_cast<std::size_t>(j)]);
        own(i, j) = i == j ? frozen_ * frozen_ : 0;
        if (field[a] >= 0)
          own(i, j) += scatter.shadowing * scatter.shadowing * std::exp(-length(at[a], at[b]) / scatter.decorrelation);
      }
    field_.push_back(own);
    for (Eigen::Index i = 0; i < size; ++i) {
      const int n = count_[static_cast<std::size_t>(cells[static_cast<std::size_t>(i)])];
      own(i, i) += n > 0 ? reading_ * reading_ / n : 1e12;  // a cell without readings carries nothing
    }
    root_.emplace_back(own.llt().matrixL());
  }
}

Eigen::MatrixXd Covariance::whitened(const Eigen::MatrixXd& columns) const {
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(cells_, columns.cols());
  for (Eigen::Index i = 0; i < columns.rows(); ++i)
    if (const int c = cell_of_[static_cast<std::size_t>(i)]; c >= 0)
      means.row(c) += columns.row(i) / count_[static_cast<std::size_t>(c)];
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(cells_ + columns.rows(), columns.cols());
  for (Eigen::Index i = 0; i < columns.rows(); ++i)
    if (const int c = cell_of_[static_cast<std::size_t>(i)]; c >= 0)
      result.row(cells_ + i) = (columns.row(i) - means.row(c)) / reading_;
  Eigen::Index at = 0;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    Eigen::MatrixXd own(static_cast<Eigen::Index>(groups_[g].size()), columns.cols());
    for (std::size_t i = 0; i < groups_[g].size(); ++i)
      own.row(static_cast<Eigen::Index>(i)) = means.row(groups_[g][i]);
    root_[g].triangularView<Eigen::Lower>().solveInPlace(own);
    result.middleRows(at, own.rows()) = own;
    at += own.rows();
  }
  return result;
}

Eigen::VectorXd Covariance::draw_cells(Draws& draws) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(cells_);
  if (!has_field_) return result;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    Eigen::VectorXd own(static_cast<Eigen::Index>(groups_[g].size()));
    for (double& v : own) v = draws.gauss();
    const Eigen::MatrixXd& field = field_[g];
    // The last bits keep the factor of places that coincide real.
    const Eigen::MatrixXd jitter = 1e-9 * Eigen::MatrixXd::Identity(field.rows(), field.rows());
    own = (field + jitter).llt().matrixL() * own;
    for (std::size_t i = 0; i < groups_[g].size(); ++i) result[groups_[g][i]] = own[static_cast<Eigen::Index>(i)];
  }
  return result;
}

double unexplained_energy(const Eigen::VectorXd& effect, const Eigen::MatrixXd& others) {
  if (others.cols() == 0) return effect.squaredNorm();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> fit(others);
  return (effect - others * fit.solve(effect)).squaredNorm();
}

Eigen::MatrixXd map_columns(const Scene& map, const std::vector<Row>& rows) {
  std::vector<std::string> materials;
  for (const Panel& panel : map.panels)
    if (std::find(materials.begin(), materials.end(), panel.material) == materials.end())
      materials.push_back(panel.material);
  Eigen::MatrixXd columns =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), 2 + static_cast<Eigen::Index>(materials.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto r = static_cast<Eigen::Index>(i);
    const Path path = path_of(map, rows[i]);
    columns(r, 0) = 1;
    columns(r, 1) = -10 * std::log10(std::max(path.length, 0.01));
    for (const Panel& panel : map.panels)
      if (passes(panel, path.tx, path.rx))
        columns(r, 2 + (std::find(materials.begin(), materials.end(), panel.material) - materials.begin())) -= 1;
  }
  return columns;
}

}  // namespace muster::exam::survey
