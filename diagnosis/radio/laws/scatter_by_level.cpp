#include "diagnosis/radio/laws/scatter_by_level.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

std::vector<Index> in_order(const VectorXd& values) {
  std::vector<Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return values[a] < values[b]; });
  return order;
}

// Ranks about their middle; equal values share theirs.
VectorXd ranks(const VectorXd& values) {
  const std::vector<Index> order = in_order(values);
  VectorXd result(values.size());
  for (std::size_t from = 0; from < order.size();) {
    std::size_t to = from;
    while (to < order.size() && values[order[to]] == values[order[from]]) ++to;
    for (std::size_t k = from; k < to; ++k) result[order[k]] = static_cast<double>(from + to - 1) / 2;
    from = to;
  }
  return result.array() - result.mean();
}

double deviation(const VectorXd& differences, std::vector<Index>::const_iterator from, Index count) {
  double sum = 0;
  for (Index k = 0; k < count; ++k) sum += differences[*(from + k)] * differences[*(from + k)];
  return std::sqrt(sum / (2 * static_cast<double>(count)));
}

}  // namespace

ScatterByLevel scatter_by_level(const CloseReadings& close, const VectorXd& level) {
  const Index pairs = close.pairs, third = pairs / 3;
  if (third < 10) return {};
  VectorXd at = level(close.first);
  if (close.beside.size() == pairs) at += close.beside;
  const VectorXd by_level = ranks(at), by_size = ranks(close.apart);
  const double size = by_level.norm() * by_size.norm();
  const double z = size > 0 ? std::abs(by_level.dot(by_size)) / size * std::sqrt(static_cast<double>(pairs - 1)) : 0;
  const std::vector<Index> order = in_order(at);
  return {std::log(std::max(std::erfc(z / std::sqrt(2.0)), 1e-300)), deviation(close.apart, order.begin(), third),
          deviation(close.apart, order.end() - third, third)};
}

}  // namespace muster::diagnosis
