#include "diagnosis/inference/noise/rows.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace muster::noise {
Rows::Rows(std::vector<Index> order, std::vector<Index> first)
    : order_(std::move(order)), first_(std::move(first)), row_of_(order_.size()) {
  count_readings();
}

void Rows::count_readings() {
  count_.resize(size());
  for (Index i = 0; i < size(); ++i)
    count_[i] = static_cast<double>(first_[static_cast<std::size_t>(i) + 1] - first_[static_cast<std::size_t>(i)]);
  for (Index i = 0; i < size(); ++i) {
    for (Index k = first_[static_cast<std::size_t>(i)]; k < first_[static_cast<std::size_t>(i) + 1]; ++k)
      row_of_[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])] = i;
  }
  by_count_.resize(static_cast<std::size_t>(size()));
  std::iota(by_count_.begin(), by_count_.end(), 0);
  std::stable_sort(by_count_.begin(), by_count_.end(), [this](Index a, Index b) { return count_[a] < count_[b]; });
}

Rows Rows::ended_where(const Eigen::VectorXd& effect, double step, std::vector<Index>& parent) const {
  Rows result = *this;
  result.first_.clear();
  parent.clear();
  const auto at = [&](Index k) { return effect[order_[static_cast<std::size_t>(k)]]; };
  for (Index i = 0; i < size(); ++i) {
    Index first = first_[static_cast<std::size_t>(i)];
    result.first_.push_back(first);
    parent.push_back(i);
    for (Index k = first + 1; k < first_[static_cast<std::size_t>(i) + 1]; ++k) {
      if (std::abs(at(k) - at(first)) <= step) continue;
      first = k;
      result.first_.push_back(k);
      parent.push_back(i);
    }
  }
  result.first_.push_back(first_.back());
  result.count_readings();
  return result;
}

Eigen::MatrixXd Rows::mean(const Eigen::Ref<const Eigen::MatrixXd>& columns) const {
  Eigen::MatrixXd result(size(), columns.cols());
  for (Index j = 0; j < columns.cols(); ++j) {
    for (const Index i : by_count_) {
      double sum = 0;
      for (Index k = first_[static_cast<std::size_t>(i)]; k < first_[static_cast<std::size_t>(i) + 1]; ++k)
        sum += columns(order_[static_cast<std::size_t>(k)], j);
      result(i, j) = sum / count_[i];
    }
  }
  return result;
}

Eigen::VectorXd Rows::at_readings(const Eigen::VectorXd& rows) const {
  Eigen::VectorXd result(static_cast<Index>(row_of_.size()));
  for (Index k = 0; k < result.size(); ++k) result[k] = rows[row_of_[static_cast<std::size_t>(k)]];
  return result;
}

double Sites::within() const {
  if (size() == 0) return 0;
  return mean_of_three *
         (place_stretch.colwise().squaredNorm() + anchor_stretch.colwise().squaredNorm()).cwiseSqrt().mean();
}

Sites Sites::of(const std::vector<Index>& rows) const {
  Sites result{place(Eigen::all, rows),
               anchor(Eigen::all, rows),
               place_stretch(Eigen::all, rows),
               anchor_stretch(Eigen::all, rows),
               {},
               count(rows),
               stated};
  for (const Index i : rows) {
    result.group.push_back(group[static_cast<std::size_t>(i)]);
    if (!stream.empty()) result.stream.push_back(stream[static_cast<std::size_t>(i)]);
  }
  return result;
}

Sites Sites::with(const Sites& more) const {
  Sites result = *this;
  for (Eigen::Matrix3Xd Sites::*columns :
       {&Sites::place, &Sites::anchor, &Sites::place_stretch, &Sites::anchor_stretch}) {
    (result.*columns).conservativeResize(3, size() + more.size());
    (result.*columns).rightCols(more.size()) = more.*columns;
  }
  result.count.conservativeResize(size() + more.size());
  result.count.tail(more.size()) = more.count;
  result.group.insert(result.group.end(), more.group.begin(), more.group.end());
  result.stream.insert(result.stream.end(), more.stream.begin(), more.stream.end());
  return result;
}

}  // namespace muster::noise
