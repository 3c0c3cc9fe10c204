#include "whiten.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "reading_law.hpp"

namespace muster::exam {
namespace {

constexpr double row_length = 0.4;       // m
constexpr double row_duration = 3;       // s, for robots that stand
constexpr std::size_t places_a_row = 4;  // at most, for averages over a row
constexpr std::size_t same_station = 25, other_stations = 10;

}  // namespace

double reading_variance(const ReadingLaw& law) {
  double channels = 0, mean = 0;
  for (const double c : law.channels) mean += c / static_cast<double>(law.channels.size());
  for (const double c : law.channels) channels += (c - mean) * (c - mean) / static_cast<double>(law.channels.size());
  return fading_moments(law).variance + channels + law.outliers * 400 / 3 + 1.0 / 12;
}

Whitener::Whitener(const Data& data, const Noise& noise, const std::vector<char>& use)
    : noise_(noise), reading_variance_(reading_variance(noise.reading)) {
  gather(data, use);
  find_neighbours();
  const Kernel kernel(noise_.field);
  for (std::size_t i = 0; i < rows_.size(); ++i) weights_.push_back(weights(kernel, i));
}

void Whitener::settle(const Data& data, Row& row) const {
  const std::size_t count = row.readings.size();
  for (const int i : row.readings) {
    const Vec3 at = data.readings[static_cast<std::size_t>(i)].at;
    row.at.x += at.x / static_cast<double>(count);
    row.at.y += at.y / static_cast<double>(count);
  }
  const std::size_t places = std::min(count, places_a_row);
  for (std::size_t k = 0; k < places; ++k) {
    const Vec3 at = data.readings[static_cast<std::size_t>(row.readings[k * count / places])].at;
    row.places.push_back({at.x, at.y});
  }
  double apart = 0;  // mean loss of correlation between two readings of the row
  for (std::size_t a = 0; a < places; ++a)
    for (std::size_t b = 0; b < a; ++b)
      apart += 1 - correlation(noise_.field,
                               std::hypot(row.places[a].x - row.places[b].x, row.places[a].y - row.places[b].y));
  const double pairs = std::max(1.0, static_cast<double>(places * (places - 1)) / 2);
  row.within = reading_variance_ + noise_.field.sigma * noise_.field.sigma * apart / pairs;
}

void Whitener::gather(const Data& data, const std::vector<char>& use) {
  std::map<std::tuple<int, int, bool>, std::size_t> open;
  for (std::size_t i = 0; i < data.size(); ++i) {
    if (!use[i]) continue;
    const Reading& r = data.readings[i];
    const auto [entry, is_new] = open.try_emplace({r.station, r.robot, r.up}, 0);
    if (!is_new) {
      const Reading& first = data.readings[static_cast<std::size_t>(rows_[entry->second].readings[0])];
      if (std::hypot(first.at.x - r.at.x, first.at.y - r.at.y) < row_length && r.t - first.t < row_duration) {
        rows_[entry->second].readings.push_back(static_cast<int>(i));
        continue;
      }
    }
    entry->second = rows_.size();
    rows_.push_back({{}, r.station, {static_cast<int>(i)}, {}, 0});
  }
  for (Row& row : rows_) settle(data, row);
  Random random(7, "order of conditioning");
  for (std::size_t i = rows_.size(); i > 1; --i)
    std::swap(rows_[i - 1], rows_[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
}

void Whitener::find_neighbours() {
  std::vector<std::pair<double, int>> same, other;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    same.clear();
    other.clear();
    for (std::size_t j = 0; j < i; ++j) {
      const double x = rows_[i].at.x - rows_[j].at.x, y = rows_[i].at.y - rows_[j].at.y;
      (rows_[i].station == rows_[j].station ? same : other).push_back({x * x + y * y, static_cast<int>(j)});
    }
    std::vector<int>& nearest = neighbours_.emplace_back();
    const auto take = [&](auto& from, std::size_t count) {
      count = std::min(count, from.size());
      std::nth_element(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(count), from.end());
      for (std::size_t k = 0; k < count; ++k) nearest.push_back(from[k].second);
    };
    take(same, same_station);
    take(other, other_stations);
  }
}

double Whitener::covariance(const Kernel& kernel, const Row& a, const Row& b) {
  double sum = 0;
  for (const Vec2 p : a.places)
    for (const Vec2 q : b.places) sum += kernel.table(std::sqrt((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y)));
  const FieldLaw& law = kernel.law;
  return law.sigma * law.sigma * (a.station == b.station ? 1 : law.shared) * sum /
         static_cast<double>(a.places.size() * b.places.size());
}

Whitener::Weights Whitener::weights(const Kernel& kernel, std::size_t row) const {
  const std::vector<int>& near = neighbours_[row];
  const auto count = static_cast<Eigen::Index>(near.size());
  Eigen::MatrixXd among(count, count);
  Eigen::VectorXd with(count);
  for (Eigen::Index a = 0; a < count; ++a) {
    const Row& one = rows_[static_cast<std::size_t>(near[static_cast<std::size_t>(a)])];
    for (Eigen::Index b = 0; b <= a; ++b)
      among(a, b) = covariance(kernel, one, rows_[static_cast<std::size_t>(near[static_cast<std::size_t>(b)])]);
    among(a, a) += nugget(one);
    with[a] = covariance(kernel, one, rows_[row]);
  }
  Weights result;
  double left = covariance(kernel, rows_[row], rows_[row]) + nugget(rows_[row]);
  if (count > 0) {
    const Eigen::VectorXd w = among.selfadjointView<Eigen::Lower>().llt().solve(with);
    left -= w.dot(with);
    result.of.assign(w.begin(), w.end());
  }
  result.deviation = std::sqrt(left);
  return result;
}

Eigen::MatrixXd Whitener::operator()(const Eigen::MatrixXd& columns) const {
  const auto rows = static_cast<Eigen::Index>(rows_.size());
  Eigen::Index used = 0;
  for (const Row& row : rows_) used += static_cast<Eigen::Index>(row.readings.size());
  Eigen::MatrixXd means(rows, columns.cols()), result(rows + used, columns.cols());
  Eigen::Index next = rows;
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Row& row = rows_[static_cast<std::size_t>(i)];
    means.row(i).setZero();
    for (const int r : row.readings) means.row(i) += columns.row(r) / static_cast<double>(row.readings.size());
    for (const int r : row.readings) result.row(next++) = (columns.row(r) - means.row(i)) / std::sqrt(row.within);
  }
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Weights& w = weights_[static_cast<std::size_t>(i)];
    result.row(i) = means.row(i);
    for (std::size_t k = 0; k < w.of.size(); ++k)
      result.row(i) -= w.of[k] * means.row(neighbours_[static_cast<std::size_t>(i)][k]);
    result.row(i) /= w.deviation;
  }
  return result;
}

std::vector<double> Whitener::level_deviations() const {
  std::vector<double> result;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double of_level = std::max(1e-9, weights_[i].deviation * weights_[i].deviation - nugget(rows_[i]));
    for (std::size_t k = 0; k < rows_[i].readings.size(); ++k)  // those of the row before it say of it what they can
      result.push_back(std::sqrt(1 / (1 / of_level + static_cast<double>(k) / rows_[i].within)));
  }
  return result;
}

double Whitener::field_lambda(const FieldLaw& truth, const FieldLaw& stated) const {
  const Kernel true_kernel(truth), stated_kernel(stated);
  double sum = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Weights of_truth = weights(true_kernel, i), of_stated = weights(stated_kernel, i);
    // Variance, under the truth, of what the stated law leaves of this row.
    std::vector<int> set = neighbours_[i];
    std::vector<double> w = of_stated.of;
    for (double& v : w) v = -v;
    set.push_back(static_cast<int>(i));
    w.push_back(1);
    double variance = 0;
    for (std::size_t a = 0; a < set.size(); ++a) {
      const Row& one = rows_[static_cast<std::size_t>(set[a])];
      variance += w[a] * w[a] * (covariance(true_kernel, one, one) + nugget(one));
      for (std::size_t b = 0; b < a; ++b)
        variance += 2 * w[a] * w[b] * covariance(true_kernel, one, rows_[static_cast<std::size_t>(set[b])]);
    }
    const double ratio = of_stated.deviation / of_truth.deviation;
    sum += variance / (of_stated.deviation * of_stated.deviation) - 1 + 2 * std::log(ratio);
  }
  return std::max(0.0, sum);
}

double energy(const Whitener& whiten, const Eigen::VectorXd& effect, const Eigen::MatrixXd& others) {
  Eigen::MatrixXd all(effect.size(), others.cols() + 1);
  all << others, effect;
  const Eigen::MatrixXd white = whiten(all);
  const Eigen::VectorXd e = white.rightCols(1);
  if (others.cols() == 0) return e.squaredNorm();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> fit(white.leftCols(others.cols()));
  return (e - white.leftCols(others.cols()) * fit.solve(e)).squaredNorm();
}

}  // namespace muster::exam
