#include "exam/simulated/link_covariance.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <map>
#include <tuple>

namespace muster::exam::simulated {
namespace {

constexpr std::size_t most_cells = 600;  // of a dense matrix

double length_of(const Link& l) { return std::max(distance_of(l.a, l.b), 0.01); }

Eigen::Array3Xd points_on(const Link& l, double decorrelation) {
  const int count = std::clamp(static_cast<int>(std::ceil(3 * length_of(l) / decorrelation)), 4, 40);
  Eigen::Array3Xd points(3, count);
  for (int i = 0; i < count; ++i) {
    const double u = (i + 0.5) / count;
    points.col(i) << l.a.x + u * (l.b.x - l.a.x), l.a.y + u * (l.b.y - l.a.y), l.a.z + u * (l.b.z - l.a.z);
  }
  return points;
}

double integral(const Eigen::Array3Xd& one, const Eigen::Array3Xd& other, double decorrelation) {
  double sum = 0;
  for (Eigen::Index i = 0; i < one.cols(); ++i)
    sum += (-(other.colwise() - one.col(i)).square().colwise().sum().sqrt() / decorrelation).exp().sum();
  return sum / static_cast<double>(one.cols()) / static_cast<double>(other.cols());
}

// Places of robots, on a grid of some width, with the station.
std::tuple<int, int, int> bin(const Reading& r, double width) {
  return {r.station, static_cast<int>(std::floor(r.at.x / width)), static_cast<int>(std::floor(r.at.y / width))};
}

double finest_grid(const Data& data, const std::vector<char>& used) {
  for (double width = 0.3;; width *= 1.25) {
    std::map<std::tuple<int, int, int>, int> cells;
    for (std::size_t i = 0; i < data.size(); ++i)
      if (used[i]) cells[bin(data.readings[i], width)];
    if (cells.size() <= most_cells) return width;
  }
}

}  // namespace

double shadowing_covariance(const Link& one, const Link& other, double shadowing, double decorrelation) {
  return shadowing * shadowing / (2 * decorrelation) * std::sqrt(length_of(one) * length_of(other)) *
         integral(points_on(one, decorrelation), points_on(other, decorrelation), decorrelation);
}

LinkCovariance::LinkCovariance(const GroundTruth& site, const Data& data, const LinkLaw& law,
                               const std::vector<char>& used)
    : law_(law) {
  const double width = finest_grid(data, used);
  std::map<std::tuple<int, int, int>, int> cells;
  std::map<std::tuple<int, double, double, double>, int> spots;  // station, robot's place, time
  std::vector<int> cell_count;
  std::vector<std::pair<Vec3, Vec3>> extremes;  // of a cell: its first place, and the one furthest from it
  for (std::size_t i = 0; i < data.size(); ++i) {
    spot_of_.push_back(-1);
    if (!used[i]) continue;
    const Reading& r = data.readings[i];
    const auto [cell, new_cell] = cells.try_emplace(bin(r, width), static_cast<int>(cells.size()));
    const auto c = static_cast<std::size_t>(cell->second);
    if (new_cell) {
      cells_.push_back({place_of(site, r), {0, 0, r.at.z}});
      cell_count.push_back(0);
      extremes.emplace_back(r.at, r.at);
    }
    const auto [spot, new_spot] = spots.try_emplace({r.station, r.at.x, r.at.y, r.t}, static_cast<int>(spots.size()));
    if (new_spot) {
      cell_of_.push_back(cell->second);
      spot_count_.push_back(0);
    }
    spot_of_.back() = spot->second;
    ++spot_count_[static_cast<std::size_t>(spot->second)];
    ++cell_count[c];
    cells_[c].b.x += r.at.x;
    cells_[c].b.y += r.at.y;
    if (distance_of(r.at, extremes[c].first) > distance_of(extremes[c].second, extremes[c].first))
      extremes[c].second = r.at;
  }
  std::vector<double> within(cells_.size(), 0);
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    cells_[c].b.x /= cell_count[c];
    cells_[c].b.y /= cell_count[c];
    if (law.shadowing == 0) continue;
    const Link p{cells_[c].a, extremes[c].first}, q{cells_[c].a, extremes[c].second};
    const auto with = [&](const Link& u, const Link& v) {
      return shadowing_covariance(u, v, law.shadowing, law.decorrelation);
    };
    // Half of what the two furthest places differ by: the mean over a cell.
    within[c] = std::max(0.0, (with(p, p) + with(q, q)) / 2 - with(p, q)) / 2;
  }
  cell_weight_.assign(cells_.size(), 0);
  for (std::size_t s = 0; s < cell_of_.size(); ++s) {
    const auto c = static_cast<std::size_t>(cell_of_[s]);
    spot_variance_.push_back(law.fading * law.fading + within[c] + law.step * law.step / 12 / spot_count_[s]);
    cell_weight_[c] += 1 / spot_variance_[s];
  }
  root_ = of_cells(law_).llt().matrixL();
}

Eigen::MatrixXd LinkCovariance::of_cells(const LinkLaw& law) const {
  const auto size = static_cast<Eigen::Index>(cells_.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size, size);
  if (law.shadowing > 0) {
    std::vector<Eigen::Array3Xd> points;
    for (const Link& l : cells_) points.push_back(points_on(l, law.decorrelation));
    for (Eigen::Index i = 0; i < size; ++i)
      for (Eigen::Index j = 0; j <= i; ++j) {
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
        result(i, j) = result(j, i) = law.shadowing * law.shadowing / (2 * law.decorrelation) *
                                      std::sqrt(length_of(cells_[a]) * length_of(cells_[b])) *
                                      integral(points[a], points[b], law.decorrelation);
      }
  }
  for (Eigen::Index i = 0; i < size; ++i) result(i, i) += 1 / cell_weight_[static_cast<std::size_t>(i)];
  return result;
}

Eigen::MatrixXd LinkCovariance::whitened(const Eigen::MatrixXd& columns) const {
  const auto spots = static_cast<Eigen::Index>(spot_variance_.size()), cells = static_cast<Eigen::Index>(cells_.size());
  Eigen::MatrixXd of_spots = Eigen::MatrixXd::Zero(spots, columns.cols()),
                  of_cells = Eigen::MatrixXd::Zero(cells, columns.cols());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(columns.rows() + spots + cells, columns.cols());
  for (Eigen::Index i = 0; i < columns.rows(); ++i)
    if (const int s = spot_of_[static_cast<std::size_t>(i)]; s >= 0)
      of_spots.row(s) += columns.row(i) / spot_count_[static_cast<std::size_t>(s)];
  for (Eigen::Index i = 0; i < columns.rows(); ++i)
    if (const int s = spot_of_[static_cast<std::size_t>(i)]; s >= 0)
      result.row(i) = (columns.row(i) - of_spots.row(s)) / (law_.step / std::sqrt(12.0));
  for (Eigen::Index s = 0; s < spots; ++s) {
    const auto k = static_cast<std::size_t>(s), c = static_cast<std::size_t>(cell_of_[k]);
    of_cells.row(cell_of_[k]) += of_spots.row(s) / spot_variance_[k] / cell_weight_[c];
  }
  for (Eigen::Index s = 0; s < spots; ++s) {
    const auto k = static_cast<std::size_t>(s);
    result.row(columns.rows() + s) = (of_spots.row(s) - of_cells.row(cell_of_[k])) / std::sqrt(spot_variance_[k]);
  }
  root_.triangularView<Eigen::Lower>().solveInPlace(of_cells);
  result.bottomRows(cells) = of_cells;
  return result;
}

double LinkCovariance::field_divergence(const LinkLaw& truth) const {
  const Eigen::MatrixXd other = of_cells(truth);
  const Eigen::MatrixXd half = root_.triangularView<Eigen::Lower>().solve(other);
  const Eigen::MatrixXd both = root_.triangularView<Eigen::Lower>().solve(half.transpose());
  const Eigen::MatrixXd other_root = other.llt().matrixL();
  return both.trace() - static_cast<double>(other.rows()) +
         2 * (root_.diagonal().array().log().sum() - other_root.diagonal().array().log().sum());
}

}  // namespace muster::exam::simulated
