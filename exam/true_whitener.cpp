#include "exam/true_whitener.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "exam/reading_law.hpp"

namespace muster::exam {
namespace {

constexpr double row_length = 0.4;       // m
constexpr double row_duration = 3;       // s, for stationary robots
constexpr std::size_t places_a_row = 4;  // at most, for averages over a row

// The nearest so far, as a heap with the farthest one first.
class Nearest {
 public:
  explicit Nearest(std::size_t most) : most_(most) {}

  void offer(double square, int mean) {
    if (heap_.size() == most_) {
      if (square >= heap_.front().first) return;
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.pop_back();
    }
    heap_.push_back({square, mean});
    std::push_heap(heap_.begin(), heap_.end());
  }
  void move_to(std::vector<int>& list) {
    for (const auto& [square, mean] : heap_) list.push_back(mean);
    heap_.clear();
  }

 private:
  std::size_t most_;
  std::vector<std::pair<double, int>> heap_;
};

template <class T>
void shuffle(std::vector<T>& list, std::size_t from, const char* name) {
  Random random(7, name);
  for (std::size_t i = list.size() - from; i > 1; --i)
    std::swap(list[from + i - 1], list[from + static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
}

}  // namespace

double reading_variance(const ReadingLaw& law) {
  double channels = 0, mean = 0;
  for (const double c : law.channels) mean += c / static_cast<double>(law.channels.size());
  for (const double c : law.channels) channels += (c - mean) * (c - mean) / static_cast<double>(law.channels.size());
  return fading_moments(law).variance + channels + law.outliers * 400 / 3 + 1.0 / 12;
}

Whitener::Whitener(const Data& data, const Noise& noise, const std::vector<char>& use, Detail detail)
    : noise_(noise), reading_variance_(reading_variance(noise.reading)) {
  gather_rows(data, use);
  if (detail == Detail::readings) add_single_readings(data);
  find_neighbours(detail);
  const Kernel kernel(noise_.field);
  for (int i = 0; i < static_cast<int>(means_.size()); ++i) weights_.push_back(weights(joint(kernel, i)));
}

Whitener::Mean Whitener::mean_of(const Data& data, std::vector<int> readings) {
  Mean result;
  const std::size_t count = readings.size(), places = std::min(count, places_a_row);
  const auto at = [&](int i) { return data.readings[static_cast<std::size_t>(i)].at; };
  for (const int i : readings) {
    result.at.x += at(i).x / static_cast<double>(count);
    result.at.y += at(i).y / static_cast<double>(count);
  }
  for (std::size_t k = 0; k < places; ++k) {
    const int i = readings[k * count / places];
    result.places.push_back({at(i).x, at(i).y});
  }
  result.station = data.readings[static_cast<std::size_t>(readings[0])].station;
  result.readings = std::move(readings);
  return result;
}

void Whitener::gather_rows(const Data& data, const std::vector<char>& use) {
  std::vector<std::vector<int>> rows;
  std::map<std::tuple<int, int, bool>, std::size_t> open;
  for (std::size_t i = 0; i < data.size(); ++i) {
    if (!use[i]) continue;
    const Reading& r = data.readings[i];
    const auto [entry, is_new] = open.try_emplace({r.station, r.robot, r.up}, 0);
    if (!is_new) {
      const Reading& first = data.readings[static_cast<std::size_t>(rows[entry->second][0])];
      if (std::hypot(first.at.x - r.at.x, first.at.y - r.at.y) < row_length && r.t - first.t < row_duration) {
        rows[entry->second].push_back(static_cast<int>(i));
        continue;
      }
    }
    entry->second = rows.size();
    rows.push_back({static_cast<int>(i)});
  }
  for (std::vector<int>& row : rows) means_.push_back(mean_of(data, std::move(row)));
  shuffle(means_, 0, "order of rows");
  rows_ = means_.size();
  for (std::size_t i = 0; i < rows_; ++i) means_[i].row = static_cast<int>(i);
}

// All but one of a row, which the mean and the others determine.
void Whitener::add_single_readings(const Data& data) {
  for (std::size_t i = 0; i < rows_; ++i) {
    for (std::size_t k = 1; k < means_[i].readings.size(); ++k) {
      Mean alone = mean_of(data, {means_[i].readings[k]});
      alone.row = static_cast<int>(i);
      means_.push_back(std::move(alone));
    }
  }
  shuffle(means_, rows_, "order of readings");
}

void Whitener::find_neighbours(Detail detail) {
  const bool few = detail == Detail::rows;
  // For the same station and for others: rows near a row, rows near a reading, readings near a reading.
  std::array<std::array<Nearest, 2>, 3> lists{{{Nearest(few ? 25 : 50), Nearest(few ? 10 : 20)},  //
                                               {Nearest(12), Nearest(4)},
                                               {Nearest(16), Nearest(4)}}};
  for (std::size_t i = 0; i < means_.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double x = means_[i].at.x - means_[j].at.x, y = means_[i].at.y - means_[j].at.y;
      const std::size_t kind = i < rows_ ? 0 : j < rows_ ? 1 : 2;
      const bool own_row = kind == 1 && static_cast<int>(j) == means_[i].row;
      lists[kind][means_[i].station != means_[j].station].offer(own_row ? -1 : x * x + y * y, static_cast<int>(j));
    }
    std::vector<int>& nearest = neighbours_.emplace_back();
    for (auto& kind : lists)
      for (Nearest& list : kind) list.move_to(nearest);
  }
}

double Whitener::covariance(const Kernel& kernel, int one, int other) const {
  const Mean &a = mean(one), &b = mean(other);
  double sum = 0;
  for (const Vec2 p : a.places)
    for (const Vec2 q : b.places) sum += kernel.table(std::sqrt((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y)));
  const FieldLaw& law = kernel.law;
  const double field = law.sigma * law.sigma * (a.station == b.station ? 1 : law.shared) * sum /
                       static_cast<double>(a.places.size() * b.places.size());
  const auto most = static_cast<double>(std::max(a.readings.size(), b.readings.size()));
  const bool shares_readings = one == other || one == b.row || other == a.row;
  return field + (shares_readings ? reading_variance_ / most : 0);
}

Eigen::MatrixXd Whitener::joint(const Kernel& kernel, int mean) const {
  std::vector<int> all = neighbours_[static_cast<std::size_t>(mean)];
  all.push_back(mean);
  const auto count = static_cast<Eigen::Index>(all.size());
  const auto one = [&](Eigen::Index k) { return all[static_cast<std::size_t>(k)]; };
  Eigen::MatrixXd result(count, count);
  for (Eigen::Index a = 0; a < count; ++a)
    for (Eigen::Index b = 0; b <= a; ++b) result(a, b) = result(b, a) = covariance(kernel, one(a), one(b));
  return result;
}

Whitener::Weights Whitener::weights(const Eigen::MatrixXd& joint) {
  const Eigen::Index count = joint.rows() - 1;
  const Eigen::VectorXd with = joint.col(count).head(count);
  const Eigen::VectorXd w = joint.topLeftCorner(count, count).llt().solve(with);
  return {{w.begin(), w.end()}, std::sqrt(joint(count, count) - w.dot(with))};
}

Eigen::MatrixXd Whitener::operator()(const Eigen::MatrixXd& columns) const {
  const auto count = static_cast<Eigen::Index>(means_.size());
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(count, columns.cols());
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::vector<int>& readings = mean(static_cast<int>(i)).readings;
    for (const int r : readings) means.row(i) += columns.row(r) / static_cast<double>(readings.size());
  }
  Eigen::MatrixXd result = means;
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    for (std::size_t n = 0; n < neighbours_[k].size(); ++n)
      result.row(i) -= weights_[k].of[n] * means.row(neighbours_[k][n]);
    result.row(i) /= weights_[k].deviation;
  }
  return result;
}

std::vector<double> Whitener::level_deviations() const {
  std::vector<double> result;
  const Kernel kernel(noise_.field);
  for (std::size_t i = 0; i < rows_; ++i) {
    const Mean& row = means_[i];
    const auto count = static_cast<double>(row.readings.size());
    const double of_level = std::max(1e-9, weights_[i].deviation * weights_[i].deviation - reading_variance_ / count);
    const double field = covariance(kernel, static_cast<int>(i), static_cast<int>(i)) - reading_variance_ / count;
    // Unbiased variance of levels about the row's mean.
    const auto places = static_cast<double>(row.places.size());
    const double about = std::max(0.0, noise_.field.sigma * noise_.field.sigma - field);
    const double apart = about * places / std::max(1.0, places - 1);
    for (std::size_t k = 0; k < row.readings.size(); ++k)  // earlier readings of the row add precision
      result.push_back(std::sqrt(1 / (1 / of_level + static_cast<double>(k) / (reading_variance_ + apart))));
  }
  return result;
}

FieldDivergence::FieldDivergence(const Whitener& whitener, const std::vector<FieldLaw>& stated) : whitener_(whitener) {
  for (const FieldLaw& law : stated) {
    const Whitener::Kernel kernel(law);
    std::vector<Whitener::Weights>& of_law = stated_.emplace_back();
    for (std::size_t i = 0; i < whitener.rows_; ++i)
      of_law.push_back(Whitener::weights(whitener.joint(kernel, static_cast<int>(i))));
  }
}

double FieldDivergence::operator()(const FieldLaw& truth) const {
  const Whitener::Kernel kernel(truth);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(stated_.size()));
  for (std::size_t i = 0; i < whitener_.rows_; ++i) {
    const Eigen::MatrixXd joint = whitener_.joint(kernel, static_cast<int>(i));
    const double of_truth = Whitener::weights(joint).deviation;
    for (std::size_t k = 0; k < stated_.size(); ++k) {
      const Whitener::Weights& of_stated = stated_[k][i];
      // Variance, under the truth, of the stated law's prediction error for this row.
      Eigen::VectorXd left = Eigen::VectorXd::Ones(joint.rows());
      left.head(joint.rows() - 1) = -Eigen::Map<const Eigen::VectorXd>(of_stated.of.data(), joint.rows() - 1);
      const double variance = left.dot(joint * left), ratio = of_stated.deviation / of_truth;
      sum[static_cast<Eigen::Index>(k)] +=
          variance / (of_stated.deviation * of_stated.deviation) - 1 + 2 * std::log(ratio);
    }
  }
  return std::max(0.0, sum.minCoeff());
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
