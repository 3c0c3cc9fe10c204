#include "diagnosis/inference/state/null_calibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/inference/state/null_tail.hpp"

namespace muster::inference {
namespace {

constexpr float least_left = 1e-3f;  // share of a squared length, that a column must have left

// Inverse of the lower Cholesky factor, zero for a column of which less than `least` is left by those before it.
void turn(const Eigen::MatrixXf& products, float least, Eigen::Ref<Eigen::MatrixXf> inverse) {
  const Index width = products.rows();
  Eigen::MatrixXf root = Eigen::MatrixXf::Zero(width, width);
  inverse.setZero();
  for (Index j = 0; j < width; ++j) {
    for (Index k = 0; k < j; ++k) root(j, k) = inverse.row(k).head(k + 1).dot(products.row(j).head(k + 1));
    const float left = products(j, j) - root.row(j).head(j).squaredNorm();
    if (left <= least) continue;
    root(j, j) = std::sqrt(left);
    inverse.row(j) = -root.row(j) * inverse;
    inverse(j, j) = 1;
    inverse.row(j) /= root(j, j);
  }
}

}  // namespace

// Squared lengths of projections on atoms: rows of `along` are the atoms' columns.
Eigen::MatrixXf statistics(const Candidate& candidate, Eigen::MatrixXf along) {
  if (candidate.design.width == 1) {
    if (candidate.design.sign) along = (along * static_cast<float>(candidate.design.sign)).cwiseMax(0.f);
    return along.cwiseAbs2();
  }
  const Index atoms = along.rows() / candidate.design.width;
  Eigen::MatrixXf result(atoms, along.cols());
  for (Index k = 0; k < atoms; ++k)
    result.row(k) = along.middleRows(k * candidate.design.width, candidate.design.width).colwise().squaredNorm();
  return result;
}

float median(Eigen::VectorXf values) {
  float* const middle = values.data() + values.size() / 2;
  std::nth_element(values.data(), middle, values.data() + values.size());
  return *middle;
}

OrthonormalAtoms::OrthonormalAtoms(noise::Sheet columns, Index width, const Eigen::VectorXf& before)
    : columns_(std::move(columns)), width_(width), turns_(width, columns_.cols()) {
  const Index count = columns_.cols();
  // Products of each column with itself and its neighbours in the atom, in one pass over the rows.
  std::vector<Eigen::ArrayXf> apart;
  for (Index by = 0; by < std::min(width, count); ++by) apart.emplace_back(Eigen::ArrayXf::Zero(count - by));
  for (Index i = 0; i < columns_.rows(); ++i) {
    const auto row = columns_.row(i).transpose().array();
    for (Index by = 0; by < static_cast<Index>(apart.size()); ++by)
      apart[static_cast<std::size_t>(by)] += row.head(count - by) * row.tail(count - by);
  }
  if (count == 0) return;
  const float longest = std::max(apart[0].maxCoeff(), 1e-9f);
  Eigen::MatrixXf products(width, width);
  for (Index first = 0; first < count; first += width) {
    for (Index j = 0; j < width; ++j) {
      for (Index k = 0; k <= j; ++k)
        products(j, k) = products(k, j) = apart[static_cast<std::size_t>(j - k)][first + k];
    }
    const float of = before.size() ? std::min(longest, before.segment(first, width).maxCoeff()) : longest;
    turn(products, least_left * of, turns_.middleCols(first, width));
  }
}

Eigen::MatrixXf OrthonormalAtoms::along(const Eigen::Ref<const noise::Sheet>& x) const {
  Eigen::MatrixXf result = columns_.transpose() * x;
  for (Index first = 0; first < result.rows(); first += width_)
    result.middleRows(first, width_) = (turns_.middleCols(first, width_) * result.middleRows(first, width_)).eval();
  return result;
}

double log_effective_tests(const Candidate& candidate, const OrthonormalAtoms& unit, const noise::Sheet& normals) {
  const Eigen::MatrixXf all = statistics(candidate, unit.along(normals));
  Eigen::VectorXf most = all.colwise().maxCoeff();
  std::sort(most.begin(), most.end());
  std::array<double, 3> estimates;
  constexpr std::array quantiles{0.5, 0.75, 0.9};
  for (std::size_t k = 0; k < 3; ++k) {
    // P(largest < m) = (1 - tail(m))^number
    const double m = most[static_cast<Index>(quantiles[k] * static_cast<double>(most.size() - 1))];
    const double tail = std::exp(log_tail(m, candidate.design.width)) * (candidate.design.sign ? 0.5 : 1);
    estimates[k] = std::log(quantiles[k]) / std::log1p(-std::min(tail, 0.999));
  }
  std::sort(estimates.begin(), estimates.end());
  return std::log(std::max(estimates[1], 0.5));
}

}  // namespace muster::inference
