#include "diagnosis/calibration/structure_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnosis/calibration/distributions.hpp"
#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/noise/dense_solvers.hpp"

namespace muster::diagnosis {
namespace {

constexpr std::size_t ranges = 12;

// Orthogonal basis of the columns with the fit's slopes projected out.
Eigen::MatrixXd beyond(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& slopes) {
  const Eigen::MatrixXd left = columns - slopes * noise::regress(slopes, columns);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    if (left.col(j).norm() > 1e-3 * columns.col(j).norm() && columns.col(j).norm() > 0) kept.push_back(j);
  }
  if (kept.empty()) return {columns.rows(), 0};
  Eigen::MatrixXd even = left(Eigen::all, kept);
  const Eigen::VectorXd lengths = even.colwise().norm();  // precomputed: else evaluated for each element below
  even = even * lengths.cwiseInverse().asDiagonal();
  const noise::SymmetricEigen parts = noise::symmetric_eigen(even.transpose() * even);
  Eigen::Index first = 0;
  while (first < parts.values.size() && parts.values[first] < 1e-4) ++first;
  return even * parts.vectors.rightCols(parts.values.size() - first);
}

// Wald F test; denominator degrees of freedom after Fai and Cornelius (1996).
double chance_of(const Eigen::VectorXd& sums, const Eigen::MatrixXd& columns, const ErrorModel& errors) {
  const auto q = static_cast<double>(columns.cols());
  const noise::SymmetricEigen parts = noise::symmetric_eigen(errors.of_sums(columns));
  const Eigen::VectorXd along = parts.vectors.transpose() * sums;
  double statistic = 0, expected = 0;
  for (Eigen::Index j = 0; j < along.size(); ++j) {
    const double freedom = errors.of_sum(columns * parts.vectors.col(j)).freedom;
    statistic += along[j] * along[j] / std::max(parts.values[j], 1e-300) / q;
    expected += freedom / (freedom - 2);
  }
  const double freedom = q < 1.5 ? errors.of_sum(columns.col(0)).freedom : std::max(2 * expected / (expected - q), 3.0);
  return fisher_tail(q, std::min(freedom, 1e6), statistic);
}

// Mean residual of these rows. Its error is that of the remainder, since the fit has absorbed a part.
Bin bin_of(const Fit& fit, const ErrorModel& errors, const std::vector<Eigen::Index>& rows) {
  Bin bin;
  bin.rows = static_cast<double>(rows.size());
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(fit.residual.size());
  for (const auto i : rows) {
    weights[i] = 1 / bin.rows;
    bin.mean += fit.residual[i] / bin.rows;
  }
  weights -= fit.slopes * noise::regress(fit.slopes, weights);
  bin.stderror = std::sqrt(errors.of_sum(weights).variance);
  return bin;
}

std::vector<Bin> ranges_of(const Fit& fit, const ErrorModel& errors, const std::vector<double>& values) {
  std::vector<Eigen::Index> order;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isnan(values[i])) order.push_back(static_cast<Eigen::Index>(i));
  }
  const auto value = [&](Eigen::Index i) { return values[static_cast<std::size_t>(i)]; };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return value(a) < value(b); });
  std::vector<Bin> bins;
  for (std::size_t b = 0, from = 0; b < ranges && from < order.size(); ++b) {
    std::size_t to = std::max(from + 1, order.size() * (b + 1) / ranges);
    while (to < order.size() && value(order[to]) == value(order[to - 1])) ++to;  // equal values stay together
    Bin bin =
        bin_of(fit, errors,
               {order.begin() + static_cast<std::ptrdiff_t>(from), order.begin() + static_cast<std::ptrdiff_t>(to)});
    bin.from = value(order[from]);
    bin.to = value(order[to - 1]);
    bins.push_back(bin);
    from = to;
  }
  return bins;
}

std::vector<Bin> names_of(const Fit& fit, const ErrorModel& errors, const Subject& subject) {
  std::vector<Bin> bins;
  for (std::size_t name = 0; name < subject.names.size(); ++name) {
    std::vector<Eigen::Index> rows;
    for (std::size_t i = 0; i < subject.level.size(); ++i) {
      if (subject.level[i] == static_cast<int>(name)) rows.push_back(static_cast<Eigen::Index>(i));
    }
    if (rows.empty()) continue;
    bins.push_back(bin_of(fit, errors, rows));
    bins.back().name = subject.names[name];
  }
  return bins;
}

// Coefficient of each shape beside the others.
std::vector<Bin> coefficients_of(const Fit& fit, const ErrorModel& errors, const Subject& subject) {
  const Eigen::MatrixXd all = noise::hstack(subject.shapes, fit.slopes);
  const Eigen::MatrixXd gain = noise::least_norm_gain(all);
  std::vector<Bin> bins;
  for (Eigen::Index j = 0; j < subject.shapes.cols(); ++j) {
    Bin bin;
    bin.name = subject.names[static_cast<std::size_t>(j)];
    bin.rows = static_cast<double>((subject.shapes.col(j).array() != 0).count());
    bin.mean = gain.row(j).dot(fit.residual);
    bin.stderror = std::sqrt(errors.of_sum(gain.row(j).transpose()).variance);
    bins.push_back(bin);
  }
  return bins;
}

std::string words_of(const StructureTest& look) {
  std::vector<const Bin*> order;
  for (const Bin& bin : look.bins) {
    if (bin.stderror > 0) order.push_back(&bin);
  }
  std::sort(order.begin(), order.end(),
            [](auto a, auto b) { return std::abs(a->mean) / a->stderror > std::abs(b->mean) / b->stderror; });
  std::string words;
  for (std::size_t i = 0; i < std::min<std::size_t>(2, order.size()); ++i) {
    const Bin& bin = *order[i];
    const std::string place = bin.name.empty() ? fmt::format("{} {:.3g} to {:.3g}{}{}", look.by, bin.from, bin.to,
                                                             look.unit.empty() ? "" : " ", look.unit)
                                               : fmt::format("{} {}", look.by, bin.name);
    words += fmt::format("{}{}: {:+.1f} +- {:.1f} dB", words.empty() ? "" : "; ", place, bin.mean, bin.stderror);
  }
  return words;
}

Eigen::VectorXd without(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns) {
  return residual - columns * noise::regress(columns, residual);
}

// Error model refitted beside the columns.
ErrorModel errors_beside(const Fit& fit, const Eigen::MatrixXd& columns, bool shared) {
  ErrorModel errors(fit.clusters, fit.kernels);
  const Eigen::VectorXd left = without(fit.residual, columns);
  const Eigen::MatrixXd all = noise::hstack(fit.slopes, columns);
  if (shared)
    errors.fit(left, all);
  else
    errors.fit_white(left, all);
  return errors;
}

}  // namespace

double chance_of_structure(const Fit& fit, const Eigen::MatrixXd& shapes, bool shared) {
  const Eigen::MatrixXd columns = beyond(shapes, fit.slopes);
  if (columns.cols() == 0) return 1;
  return chance_of(columns.transpose() * fit.residual, columns, errors_beside(fit, columns, shared));
}

// Three variances, each 0 in half of all sound worlds, and the best of several distances. In simulated worlds the
// true p-value stays below this (tests/diagnosis/calibration/coverage_test.cpp).
double chance_of_sharing(double evidence) {
  if (evidence <= 0) return 1;
  return std::min(1.0, 2 * std::exp(-evidence / 2));
}

StructureTest structure_along(const Fit& fit, const Subject& subject, bool shared) {
  StructureTest look{.by = subject.by, .unit = subject.unit};
  const Eigen::MatrixXd columns = beyond(subject.shapes, fit.slopes);
  look.columns = static_cast<int>(columns.cols());
  if (look.columns == 0) return look;
  const ErrorModel errors = errors_beside(fit, columns, shared);
  look.explains = 1 - without(fit.residual, columns).squaredNorm() / fit.residual.squaredNorm();
  look.p = chance_of(columns.transpose() * fit.residual, columns, errors);
  look.bins = subject.by_shape         ? coefficients_of(fit, errors, subject)
              : subject.values.empty() ? names_of(fit, errors, subject)
                                       : ranges_of(fit, errors, subject.values);
  look.where = words_of(look);
  return look;
}

Eigen::MatrixXd waves(const std::vector<double>& values, int count) {
  double low = 1e300, high = -1e300;
  for (const double v : values) {
    if (std::isnan(v)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  const auto rows = static_cast<Eigen::Index>(values.size());
  Eigen::MatrixXd shapes = Eigen::MatrixXd::Zero(rows, count + 1);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double v = values[static_cast<std::size_t>(i)];
    if (std::isnan(v)) continue;
    for (int k = 0; k <= count; ++k)
      shapes(i, k) = std::cos(3.141592653589793 * k * (v - low) / std::max(high - low, 1e-300));
  }
  return shapes;  // the first is constant: it separates empty cells from others; without any the fit absorbs it
}

Eigen::MatrixXd lobes(const std::vector<double>& angles, int count) {
  Eigen::MatrixXd shapes(static_cast<Eigen::Index>(angles.size()), 2 * count);
  for (Eigen::Index i = 0; i < shapes.rows(); ++i) {
    for (int k = 0; k < count; ++k) {
      shapes(i, 2 * k) = std::cos((k + 1) * angles[static_cast<std::size_t>(i)]);
      shapes(i, 2 * k + 1) = std::sin((k + 1) * angles[static_cast<std::size_t>(i)]);
    }
  }
  return shapes;
}

Eigen::MatrixXd indicators(const std::vector<int>& level, std::size_t levels) {
  Eigen::MatrixXd shapes =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(level.size()), static_cast<Eigen::Index>(levels));
  for (Eigen::Index i = 0; i < shapes.rows(); ++i) {
    if (level[static_cast<std::size_t>(i)] >= 0) shapes(i, level[static_cast<std::size_t>(i)]) = 1;
  }
  return shapes;
}

}  // namespace muster::diagnosis
