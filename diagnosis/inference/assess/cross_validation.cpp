#include "diagnosis/inference/assess/cross_validation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnosis/inference/noise/basis.hpp"
#include "diagnosis/inference/state/layout.hpp"
#include "diagnosis/inference/thresholds.hpp"
#include "muster/random.hpp"

namespace muster::inference {
namespace {

constexpr int most_folds = 5, resamples = 1000;

// Fold of each block: blocks in a random order, dealt in turn.
std::vector<int> fold_of_block(int blocks, uint64_t seed) {
  const Stream stream(combined(key_of("held-out folds"), seed));
  std::vector<int> order(static_cast<std::size_t>(blocks)), result(order.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return stream.uniform(static_cast<uint64_t>(a)) < stream.uniform(static_cast<uint64_t>(b));
  });
  for (std::size_t k = 0; k < order.size(); ++k)
    result[static_cast<std::size_t>(order[k])] = static_cast<int>(k) % std::min(blocks, most_folds);
  return result;
}

}  // namespace

std::vector<int> blocks_of(const noise::Sites& sites, const noise::Covariance& covariance) {
  const double apart = sites.over_time() ? std::exp(thresholds::prior_log_decorrelation) : covariance.decorrelation();
  const double side = thresholds::block_side * apart;
  const Eigen::Vector3d corner = sites.place.rowwise().minCoeff();
  std::vector<std::array<long, 3>> cells;
  for (Index i = 0; i < sites.size(); ++i) {
    const Eigen::Vector3d at = (sites.place.col(i) - corner) / side;
    cells.push_back(
        {std::lround(std::floor(at.x())), std::lround(std::floor(at.y())), std::lround(std::floor(at.z()))});
  }
  return numbered(cells);
}

Folds::Folds(const noise::Sites& sites, const std::vector<int>& block_of_row, const std::vector<Index>& row_of,
             const noise::Covariance& covariance, uint64_t seed)
    : seed_(seed) {
  for (const Index row : row_of) block_of_.push_back(block_of_row[static_cast<std::size_t>(row)]);
  blocks_ = *std::max_element(block_of_row.begin(), block_of_row.end()) + 1;
  if (!possible()) return;
  const std::vector<int> fold = fold_of_block(blocks_, seed);
  const auto is_in = [&](int block, int k) { return fold[static_cast<std::size_t>(block)] == k; };
  for (int k = 0; k < std::min(blocks_, most_folds); ++k) {
    std::vector<Index> rows, readings;
    for (std::size_t i = 0; i < block_of_row.size(); ++i) {
      if (!is_in(block_of_row[i], k)) rows.push_back(static_cast<Index>(i));
    }
    for (std::size_t i = 0; i < block_of_.size(); ++i) {
      if (is_in(block_of_[i], k)) readings.push_back(static_cast<Index>(i));
    }
    auto field = std::make_shared<const noise::Field>(sites.of(rows));
    noise::Whitener whitener(*field, noise::StatedTables::nearest(covariance));
    folds_.push_back({std::move(rows), std::move(readings), std::move(field), std::move(whitener)});
  }
}

Folds::Folds(const Folds& other, const noise::Covariance& covariance) : Folds(other) {
  for (Fold& fold : folds_) fold.whitener = noise::Whitener(*fold.field, noise::StatedTables::nearest(covariance));
}

Eigen::VectorXd Folds::squared_errors(const Sample& rows, const Sample& readings) const {
  Eigen::VectorXd result(readings.y.size());
  for (const auto& fold : folds_) {
    const Eigen::MatrixXd x = fold.whitener(rows.design(fold.fitted, Eigen::all));
    const auto basis = noise::basis_of(x);
    const Eigen::VectorXd explained = basis.q.transpose() * fold.whitener(rows.y(fold.fitted)).col(0);
    const Eigen::VectorXd mean = readings.design(fold.left_out, Eigen::all) * basis.coefficients(explained, x.cols());
    for (Index k = 0; k < mean.size(); ++k) {
      const Index i = fold.left_out[static_cast<std::size_t>(k)];
      const double off = readings.bounds ? readings.bounds->error(static_cast<std::size_t>(i), readings.y[i], mean[k])
                                         : readings.y[i] - mean[k];
      result[i] = off * off;
    }
  }
  return result;
}

HeldOutGain compared(const Unseen& unseen) {
  const auto& [before, after, block_of, seed] = unseen;
  const int blocks = *std::max_element(block_of.begin(), block_of.end()) + 1;
  std::vector<double> won(static_cast<std::size_t>(blocks)), readings(won.size()), means;
  for (Index i = 0; i < before.size(); ++i) {
    const auto block = static_cast<std::size_t>(block_of[static_cast<std::size_t>(i)]);
    won[block] += before[i] - after[i];
    readings[block] += 1;
  }
  const Stream stream(combined(key_of("block bootstrap"), seed));
  for (uint64_t k = 0; k < resamples; ++k) {
    double sum = 0, count = 0;
    for (uint64_t j = 0; j < won.size(); ++j) {
      const auto block = static_cast<std::size_t>(stream.uniform(k, j) * static_cast<double>(won.size()));
      sum += won[block];
      count += readings[block];
    }
    means.push_back(sum / count);
  }
  std::sort(means.begin(), means.end());
  return {std::sqrt(before.mean()),
          std::sqrt(after.mean()),
          (before - after).mean(),
          means[resamples / 40],
          means[resamples - 1 - resamples / 40],
          blocks};
}

Stair stair_of(Unseen unseen) {
  unseen.after.setZero();
  const HeldOutGain all = compared(unseen);
  return {all.rmse_before, std::sqrt(all.lower95), std::sqrt(all.upper95), {}};
}

}  // namespace muster::inference
