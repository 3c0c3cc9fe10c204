#include "diagnosis/radio/laws/kriging.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "diagnosis/inference/noise/over_time.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr noise::Conditioning conditioning{12, 0, 1};

std::vector<Index> finite_of(const VectorXd& residual) {
  std::vector<Index> result;
  for (Index i = 0; i < residual.size(); ++i) {
    if (std::isfinite(residual[i])) result.push_back(i);
  }
  return result;
}

LinkReadings those(const LinkReadings& all, const std::vector<Index>& which) {
  LinkReadings result;
  result.tx_at = all.tx_at(Eigen::all, which);
  result.rx_at = all.rx_at(Eigen::all, which);
  for (const Index i : which) {
    if (!all.t.empty()) result.t.push_back(all.t[static_cast<std::size_t>(i)]);
    result.tx.push_back(all.tx[static_cast<std::size_t>(i)]);
    result.rx.push_back(all.rx[static_cast<std::size_t>(i)]);
  }
  return result;
}

// Each reading as a row of its own, in the given order.
noise::Sites sites_of(const LinkReadings& readings, std::shared_ptr<const noise::StatedCorrelation> stated,
                      double time_unit) {
  LinkRowLimits single;
  single.way = -1;
  const noise::Rows rows = link_rows(readings, single);
  noise::Sites sites = link_sites(rows, readings).of(rows.row_of());
  sites.stated = std::move(stated);
  return time_unit > 0 ? noise::over_time(std::move(sites), readings.t, time_unit) : sites;
}

// Index of each site's cell of this side, in order of first visit, separate for each anchor's radio.
std::vector<Index> cells_of(const noise::Sites& sites, double side) {
  std::map<std::tuple<int, long, long, long>, Index> numbers;
  std::vector<Index> result;
  for (Index i = 0; i < sites.size(); ++i) {
    const auto along = [&](int axis) { return std::lround(sites.place(axis, i) / side); };
    const std::tuple cell(sites.group[static_cast<std::size_t>(i)], along(0), along(1), along(2));
    result.push_back(numbers.try_emplace(cell, static_cast<Index>(numbers.size())).first->second);
  }
  return result;
}

// Readings that repeat an earlier one of their site, or of one stream there; all of them where nothing is fixed.
std::vector<Index> repeats_of(const noise::RecurringSites& recurring, Index size, noise::Family fitted) {
  const auto least = noise::stream_part(fitted) > 0 ? noise::Relation::stream : noise::Relation::site;
  std::vector<Index> result;
  for (Index i = 0; i < size; ++i) {
    const std::vector<Index>& alike = recurring.rows_with(i);
    if (noise::fixed_share(fitted) == 0 ||
        std::any_of(alike.begin(), alike.end(), [&](Index j) { return j < i && recurring.of(i, j) >= least; }))
      result.push_back(i);
  }
  return result;
}

// y = value + slope x by least squares; unknown if x hardly varies.
struct Intercept {
  bool known = false;
  double value = 0, standard_error = 0, left = 0;  // left: residual sum of squares
};

Intercept intercept_of(const VectorXd& y, const Eigen::ArrayXd& x) {
  Eigen::MatrixX2d line(y.size(), 2);
  line << VectorXd::Ones(y.size()), x.matrix();
  const Eigen::Matrix2d normal = line.transpose() * line;
  if (normal.determinant() < 1e-6 * static_cast<double>(y.size() * y.size())) return {};
  const Eigen::Matrix2d inverse = normal.inverse();
  const Eigen::Vector2d fitted = inverse * (line.transpose() * y);
  // Sandwich variance: farther differences vary more (White 1980).
  const Eigen::VectorXd left = (y - line * fitted).array().square();
  const Eigen::Matrix2d uncertainty = inverse * (line.transpose() * left.asDiagonal() * line) * inverse;
  return {true, fitted[0], std::sqrt(uncertainty(0, 0)), left.sum()};
}

}  // namespace

std::shared_ptr<const Kriging::Weights> Kriging::weights(const FieldShape& shape, int place) {
  constexpr std::size_t most = 32'000'000;  // numbers that are kept, 8 bytes each
  const auto found = kept_.find({shape, place});
  if (found != kept_.end()) return found->second;
  constexpr double log_variance = 3;  // the field's, dB^2; the result does not depend on it
  const noise::Covariance at{shape.family, {log_variance, 1e-3 * shape.distance, log_variance + 1e-3 * place, 0}};
  const auto result = std::make_shared<Weights>(Weights{noise::Whitener(field_, at), {}, {}});
  const VectorXd own = Eigen::Map<const VectorXd>(result->whitener.stencil().own.data(), field_.size());
  result->spread = ((own.array().inverse().square() - at.reading_variance()) / at.field_variance()).max(1e-3).matrix();
  result->log_spread = result->spread.array().log();
  const auto numbers = static_cast<std::size_t>(field_.size() * (field_.slots() + 3));
  if ((kept_.size() + 1) * numbers <= most) kept_.emplace(std::pair(shape, place), result);
  return result;
}

KrigedReadings::KrigedReadings(const LinkReadings& readings, const VectorXd& residual,
                               std::shared_ptr<const noise::StatedCorrelation> stated, noise::Family fitted,
                               double time_unit)
    : KrigedReadings(residual(finite_of(residual)),
                     std::make_shared<Kriging>(noise::Field(
                         sites_of(those(readings, finite_of(residual)), std::move(stated), time_unit), conditioning)),
                     fitted, 4) {}

KrigedReadings::KrigedReadings(VectorXd residual, std::shared_ptr<Kriging> kriging, noise::Family fitted,
                               double far_off)
    : residual_(std::move(residual)),
      kriging_(std::move(kriging)),
      fitted_(fitted),
      judged_(repeats_of(kriging_->field().recurring(), residual_.size(), fitted)),
      far_off_(far_off) {}

KrigedReadings KrigedReadings::untamed() const {
  return {residual_, kriging_, fitted_, std::numeric_limits<double>::infinity()};
}

KrigedReadings KrigedReadings::with(VectorXd residual) const {
  return {std::move(residual), kriging_, fitted_, far_off_};
}

std::vector<noise::Family> KrigedReadings::families() const {
  if (noise::fixed_share(fitted_) == 0) return kriging_->field().families();
  std::vector<noise::Family> result{fitted_};
  for (const noise::Family next : {noise::with_less_fixed(fitted_), noise::with_more_fixed(fitted_)}) {
    if (next != fitted_) result.push_back(next);
  }
  return result;
}

KrigedReadings KrigedReadings::some(Index about) const {
  constexpr Index whole = 100;  // mean readings a cell: more than a neighbourhood
  std::vector<Index> cells;
  for (double side = 0.5; side < 1000; side *= 2) {  // m
    cells = cells_of(kriging_->field().sites(), side);
    if (size() >= whole * (*std::max_element(cells.begin(), cells.end()) + 1)) break;
  }
  const Index every = (size() + about - 1) / about;
  std::vector<Index> chosen;
  for (Index i = 0; i < size(); ++i) {
    if (cells[static_cast<std::size_t>(i)] % every == 0) chosen.push_back(i);
  }
  return {residual_(chosen),
          std::make_shared<Kriging>(noise::Field(kriging_->field().sites().of(chosen), conditioning)), fitted_,
          far_off_};
}

const ReadingView& KrigedReadings::view(const FieldShape& shape, int place) {
  const auto found = known_.find({shape, place});
  if (found != known_.end()) return found->second;
  const auto weights = kriging_->weights(shape, place);
  ReadingView view{1e-3 * place, error_by(weights->whitener), weights->spread, weights->log_spread};
  return known_.emplace(std::pair(shape, place), std::move(view)).first->second;
}

VectorXd KrigedReadings::error_by(const noise::Whitener& whitener) const {
  const VectorXd own = Eigen::Map<const VectorXd>(whitener.stencil().own.data(), size());
  const VectorXd white = whitener(residual_);
  const VectorXd off = (white - white.cwiseMax(-far_off_).cwiseMin(far_off_)).cwiseQuotient(own);
  return whitener(residual_ - off).cwiseQuotient(own) + off;
}

CloseReadings KrigedReadings::close_readings() const {
  // Side by side the variogram of shadowing is linear, or parabolic for a smooth field.
  const noise::Field& field = kriging_->field();
  const noise::Sites& sites = field.sites();
  std::vector<bool> paired(static_cast<std::size_t>(size()), false);
  std::vector<double> apart, half, beside;
  std::vector<Index> first;
  const auto mean_of_others = [&](Index i, Index j) {
    double sum = 0, count = 0;
    for (int a = 0; a < field.slots() && count < thresholds::readings_beside_a_pair; ++a) {
      const Index k = field.neighbour(i, a);
      if (k >= 0 && k != j) sum += residual_[k], count += 1;
    }
    return count > 0 ? sum / count : 0;
  };
  for (Index i = 0; i < size(); ++i) {
    for (int a = 0; a < field.slots() && !paired[static_cast<std::size_t>(i)]; ++a) {
      const Index j = field.neighbour(i, a);
      if (j < 0 || paired[static_cast<std::size_t>(j)]) continue;
      const double distance = std::hypot((sites.place.col(i) - sites.place.col(j)).norm(),
                                         (sites.anchor.col(i) - sites.anchor.col(j)).norm());
      if (distance > thresholds::side_by_side) continue;  // those of another direction follow those of its own
      apart.push_back(distance);
      first.push_back(i);
      beside.push_back(mean_of_others(i, j));
      half.push_back(std::pow(residual_[i] - residual_[j], 2) / 2);
      paired[static_cast<std::size_t>(i)] = paired[static_cast<std::size_t>(j)] = true;
    }
  }
  const auto pairs = static_cast<Index>(half.size());
  const VectorXd differences = (2 * Eigen::Map<const Eigen::ArrayXd>(half.data(), pairs)).sqrt();
  const VectorXd about = Eigen::Map<const VectorXd>(beside.data(), pairs);
  CloseReadings nothing{pairs, 0, std::numeric_limits<double>::infinity(), differences, first, about};
  if (pairs < thresholds::fewest_pairs) return nothing;
  const Eigen::Map<const Eigen::ArrayXd> at(apart.data(), pairs);
  const Eigen::Map<const VectorXd> y(half.data(), pairs);
  const Intercept rough = intercept_of(y, at), smooth = intercept_of(y, at.square());
  if (!rough.known) return nothing;
  const bool parabola =
      smooth.known && std::log(rough.left / smooth.left) * static_cast<double>(pairs) / 2 > thresholds::parabola_nats;
  const Intercept& likelier = parabola ? smooth : rough;
  return {pairs, likelier.value, likelier.standard_error, differences, first, about};
}

}  // namespace muster::diagnosis
