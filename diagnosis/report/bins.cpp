#include "diagnosis/report/bins.hpp"

#include <algorithm>
#include <cmath>

#include "muster/random.hpp"

namespace muster::report {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int resamples = 400;

// Bin of each value, or -1.
std::vector<int> parts_of(const std::vector<double>& edges, const VectorXd& x) {
  std::vector<int> out;
  for (const double v : x) {
    const auto above = std::upper_bound(edges.begin(), edges.end(), v);
    const bool last = v == edges.back();
    const bool inside = std::isfinite(v) && above != edges.begin() && (above != edges.end() || last);
    out.push_back(!inside ? -1 : static_cast<int>(above - edges.begin()) - 1 - (last ? 1 : 0));
  }
  return out;
}

struct Sums {
  VectorXd sum, rows;  // of each block
};

void interval_of(Bin& bin, const Sums& sums, uint64_t part) {
  const Stream stream(combined(key_of("means by block"), part));
  std::vector<double> means;
  std::vector<Index> held;  // blocks with rows in this bin
  for (Index b = 0; b < sums.rows.size(); ++b) {
    if (sums.rows[b] > 0) held.push_back(b);
  }
  for (uint64_t k = 0; k < resamples; ++k) {
    double sum = 0, rows = 0;
    for (uint64_t j = 0; j < held.size(); ++j) {
      const auto at = static_cast<std::size_t>(stream.uniform(k, j) * static_cast<double>(held.size()));
      sum += sums.sum[held[at]];
      rows += sums.rows[held[at]];
    }
    means.push_back(sum / rows);
  }
  std::sort(means.begin(), means.end());
  bin.low = means[resamples / 40];
  bin.high = means[resamples - 1 - resamples / 40];
}

}  // namespace

std::vector<Bin> means_over(const std::vector<double>& edges, const VectorXd& x, const VectorXd& y,
                            const std::vector<int>& block, int least) {
  const std::vector<int> part = parts_of(edges, x);
  const Index blocks = block.empty() ? 0 : *std::max_element(block.begin(), block.end()) + 1;
  std::vector<Sums> sums(edges.size() - 1, {VectorXd::Zero(blocks), VectorXd::Zero(blocks)});
  for (Index i = 0; i < y.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (part[k] < 0) continue;
    sums[static_cast<std::size_t>(part[k])].sum[block[k]] += y[i];
    sums[static_cast<std::size_t>(part[k])].rows[block[k]] += 1;
  }
  std::vector<Bin> out;
  for (std::size_t p = 0; p < sums.size(); ++p) {
    const double rows = sums[p].rows.sum();
    if (rows < least) continue;
    Bin bin{(edges[p] + edges[p + 1]) / 2, sums[p].sum.sum() / rows, 0, 0, rows};
    interval_of(bin, sums[p], p);
    out.push_back(bin);
  }
  return out;
}

std::vector<Bin> whitened_means_over(const std::vector<double>& edges, const VectorXd& x, const VectorXd& y,
                                     int least) {
  const std::vector<int> part = parts_of(edges, x);
  std::vector<Bin> all(edges.size() - 1), out;
  for (Index i = 0; i < y.size(); ++i) {
    const int p = part[static_cast<std::size_t>(i)];
    if (p < 0) continue;
    all[static_cast<std::size_t>(p)].mean += y[i];
    all[static_cast<std::size_t>(p)].rows += 1;
  }
  for (std::size_t p = 0; p < all.size(); ++p) {
    Bin bin = all[p];
    if (bin.rows < least) continue;
    bin.at = (edges[p] + edges[p + 1]) / 2;
    bin.mean /= bin.rows;
    const double half = 1.96 / std::sqrt(bin.rows);
    bin.low = bin.mean - half;
    bin.high = bin.mean + half;
    out.push_back(bin);
  }
  return out;
}

std::vector<double> edges_of(const VectorXd& x, int count, bool log) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double v : x) {
    if (!std::isfinite(v)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  if (!(low < high)) return {low - 0.5, low + 0.5};
  std::vector<double> edges;
  for (int k = 0; k <= count; ++k) {
    const double share = static_cast<double>(k) / count;
    edges.push_back(log ? low * std::pow(high / low, share) : low + share * (high - low));
  }
  edges.back() = high;
  return edges;
}

std::vector<double> edges_of_names(std::size_t names) {
  std::vector<double> edges;
  for (std::size_t k = 0; k <= names; ++k) edges.push_back(static_cast<double>(k) - 0.5);
  return edges;
}

}  // namespace muster::report
