#include "diagnosis/inference/noise/rows.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "diagnosis/inference/noise/recurring_sites.hpp"

namespace muster::noise {
namespace {

// More rows are of the series of their site, long after it; of a site that has none, of a new one.
void join_series(const Sites& sites, const Sites& more, Sites& both) {
  constexpr double later = 20;  // decorrelation distances, about
  const double end = *std::max_element(sites.moment.begin(), sites.moment.end()) + later;
  std::map<SiteKey, int> series;
  for (Index i = 0; i < sites.size(); ++i)
    series.emplace(site_key(sites, i), sites.series[static_cast<std::size_t>(i)]);
  int next = *std::max_element(sites.series.begin(), sites.series.end()) + 1;
  for (Index i = 0; i < more.size(); ++i) {
    const auto [known, is_new] = series.try_emplace(site_key(more, i), next);
    if (is_new) ++next;
    both.series.push_back(known->second);
    both.moment.push_back(end);
  }
}

}  // namespace

Rows::Rows(std::vector<Index> order, std::vector<Index> first, std::vector<Index> twin)
    : order_(std::move(order)), first_(std::move(first)), row_of_(std::max(order_.size(), twin.size())) {
  if (!twin.empty()) {
    second_.assign(twin.size(), 0);
    for (const Index reading : order_) {
      const Index other = twin[static_cast<std::size_t>(reading)];
      twins_.push_back(other < 0 ? reading : other);
      if (other >= 0) second_[static_cast<std::size_t>(other)] = 1;
    }
  }
  count_readings();
}

void Rows::count_readings() {
  mean_row_.clear();
  for (Index i = 0; i < means(); ++i) {
    const auto first = static_cast<std::size_t>(first_[static_cast<std::size_t>(i)]);
    if (!twins_.empty() && twins_[first] != order_[first]) mean_row_.push_back(i);
  }
  count_.resize(size());
  for (Index i = 0; i < size(); ++i) count_[i] = static_cast<double>(end_of(i) - first_of(i));
  for (Index i = 0; i < means(); ++i) {
    for (Index k = first_of(i); k < end_of(i); ++k) {
      row_of_[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])] = i;
      if (!twins_.empty()) row_of_[static_cast<std::size_t>(twins_[static_cast<std::size_t>(k)])] = i;
    }
  }
  by_count_.resize(static_cast<std::size_t>(means()));
  std::iota(by_count_.begin(), by_count_.end(), 0);
  std::stable_sort(by_count_.begin(), by_count_.end(), [this](Index a, Index b) { return count_[a] < count_[b]; });
}

Rows Rows::ended_where(const Eigen::VectorXd& effect, double step, std::vector<Index>& parent) const {
  Rows result = *this;
  result.first_.clear();
  parent.clear();
  const auto differs = [&](Index k, Index first) {
    const auto apart = [&](const std::vector<Index>& readings) {
      return std::abs(effect[readings[static_cast<std::size_t>(k)]] -
                      effect[readings[static_cast<std::size_t>(first)]]);
    };
    return apart(order_) > step || (!twins_.empty() && apart(twins_) > step);
  };
  for (Index i = 0; i < means(); ++i) {
    Index first = first_of(i);
    result.first_.push_back(first);
    parent.push_back(i);
    for (Index k = first + 1; k < end_of(i); ++k) {
      if (!differs(k, first)) continue;
      first = k;
      result.first_.push_back(k);
      parent.push_back(i);
    }
  }
  result.first_.push_back(first_.back());
  result.count_readings();
  std::vector<Index> difference(static_cast<std::size_t>(means()), -1);
  for (std::size_t k = 0; k < mean_row_.size(); ++k)
    difference[static_cast<std::size_t>(mean_row_[k])] = means() + static_cast<Index>(k);
  for (const Index row : result.mean_row_)
    parent.push_back(difference[static_cast<std::size_t>(parent[static_cast<std::size_t>(row)])]);
  return result;
}

Eigen::MatrixXd Rows::mean(const Eigen::Ref<const Eigen::MatrixXd>& columns) const {
  Eigen::MatrixXd result(size(), columns.cols());
  for (Index j = 0; j < columns.cols(); ++j) {
    const auto sum_of = [column = columns.col(j).data(), this](const std::vector<Index>& readings, Index row) {
      const Index *const those = readings.data(), *const end = those + end_of(row);
      double sum = 0;
      for (const Index* one = those + first_of(row); one < end; ++one) sum += column[*one];
      return sum;
    };
    for (const Index i : by_count_) result(i, j) = sum_of(order_, i) / count_[i];
    for (Index i = means(); i < size(); ++i) {
      const double one = result(mean_of(i), j), other = sum_of(twins_, mean_of(i)) / count_[i];
      result(mean_of(i), j) = (one + other) / 2;
      result(i, j) = (one - other) / 2;
    }
  }
  return result;
}

Eigen::VectorXd Rows::at_readings(const Eigen::VectorXd& rows) const {
  const Eigen::VectorXd streams = by_stream(rows);
  Eigen::VectorXd result(static_cast<Index>(row_of_.size()));
  for (Index k = 0; k < result.size(); ++k) result[k] = streams[row_of_[static_cast<std::size_t>(k)]];
  for (Index i = means(); i < size(); ++i) {
    for (Index k = first_of(i); k < end_of(i); ++k) result[twins_[static_cast<std::size_t>(k)]] = streams[i];
  }
  return result;
}

Eigen::MatrixXd Rows::by_stream(Eigen::MatrixXd rows) const {
  for (Index i = means(); i < size(); ++i) {
    const Eigen::RowVectorXd mean = rows.row(mean_of(i)), half = rows.row(i);
    rows.row(mean_of(i)) = mean + half;
    rows.row(i) = mean - half;
  }
  return rows;
}

Eigen::MatrixXd Rows::by_twins(Eigen::MatrixXd streams) const {
  for (Index i = means(); i < size(); ++i) {
    const Eigen::RowVectorXd one = streams.row(mean_of(i)), other = streams.row(i);
    streams.row(mean_of(i)) = (one + other) / 2;
    streams.row(i) = (one - other) / 2;
  }
  return streams;
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
    if (!alone.empty()) result.alone.push_back(alone[static_cast<std::size_t>(i)]);
    if (!over_time()) continue;
    result.series.push_back(series[static_cast<std::size_t>(i)]);
    result.moment.push_back(moment[static_cast<std::size_t>(i)]);
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
  if (!alone.empty() || !more.alone.empty()) {
    result.alone.resize(static_cast<std::size_t>(size()), 0);
    result.alone.insert(result.alone.end(), more.alone.begin(), more.alone.end());
    result.alone.resize(static_cast<std::size_t>(result.size()), 0);
  }
  if (over_time()) join_series(*this, more, result);
  return result;
}

}  // namespace muster::noise
