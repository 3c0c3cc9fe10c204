#include "diagnosis/pipeline/own_world_fits.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "diagnosis/inference/noise/over_time.hpp"
#include "diagnosis/inference/score/refine.hpp"
#include "diagnosis/radio/links/drawn_term.hpp"
#include "diagnosis/radio/links/measurement_geometry.hpp"
#include "muster/random.hpp"

namespace muster::diagnosis {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Least squares within bounds: a coefficient beyond one is held there.
VectorXd bounded_least_squares(const MatrixXd& design, VectorXd y, const VectorXd& lower, const VectorXd& upper) {
  VectorXd result = VectorXd::Zero(design.cols());
  std::vector<Index> free(static_cast<std::size_t>(design.cols()));
  for (std::size_t j = 0; j < free.size(); ++j) free[j] = static_cast<Index>(j);
  while (!free.empty()) {
    const VectorXd found = design(Eigen::all, free).colPivHouseholderQr().solve(y);
    std::vector<Index> inside;
    for (std::size_t j = 0; j < free.size(); ++j) {
      const Index k = free[j];
      result[k] = std::clamp(found[static_cast<Index>(j)], lower[k], upper[k]);
      if (result[k] == found[static_cast<Index>(j)]) inside.push_back(k);
    }
    if (inside.size() == free.size()) break;
    for (const Index k : free) {
      if (!std::count(inside.begin(), inside.end(), k)) y -= result[k] * design.col(k);
    }
    free = std::move(inside);
  }
  return result;
}

// About so many of the readings of the search, fewer than twice as many, one at random of each stretch: each so manieth
// would be of one link where links take turns.
std::vector<Index> some_of(std::size_t all, std::size_t about) {
  const std::size_t every = std::max<std::size_t>(1, all / about);
  const Stream any(key_of("readings of own worlds"));
  std::vector<Index> result;
  for (std::size_t first = 0; first + every <= all; first += every)
    result.push_back(static_cast<Index>(first) + static_cast<Index>(any.uniform(first) * static_cast<double>(every)));
  return result;
}

std::vector<Index> those(const std::vector<Index>& rows, const std::vector<Index>& which) {
  std::vector<Index> result;
  for (const Index i : which) result.push_back(rows[static_cast<std::size_t>(i)]);
  return result;
}

// Levels, or their slopes by parameters of the world.
bool alike(const MatrixXd& a, const MatrixXd& b) {
  constexpr double much = 1e-6;  // dB
  return a.size() == b.size() && (a.size() == 0 || (a - b).cwiseAbs().maxCoeff() < much);
}

}  // namespace

VectorXd centred(const VectorXd& values, const std::vector<std::size_t>& group) {
  std::map<std::size_t, std::pair<double, double>> sums;  // and counts
  for (Index i = 0; i < values.size(); ++i) {
    auto& [sum, count] = sums[group[static_cast<std::size_t>(i)]];
    sum += values[i];
    count += 1;
  }
  VectorXd result = values;
  for (Index i = 0; i < values.size(); ++i) {
    const auto& [sum, count] = sums[group[static_cast<std::size_t>(i)]];
    result[i] -= sum / count;
  }
  return result;
}

OwnWorldFits::OwnWorldFits(DiagnosisSetup& setup, double time_unit, const VectorXd& levels, std::size_t readings)
    : s_(setup),
      of_used_(some_of(s_.used.rows.size(), readings)),
      kept_(those(s_.used.rows, of_used_)),
      all_(s_.model, kept_),
      scale_(scale_of(setup.model)),
      time_unit_(time_unit) {
  y_ = levels(of_used_);
  // What each radio sends, or each hears where one sends.
  const bool of_senders = s_.data.tx.levels.size() > 1;
  for (const Index row : kept_)
    radio_.push_back((of_senders ? s_.data.tx : s_.data.rx).level[static_cast<std::size_t>(row)]);
  radios_ = std::set(radio_.begin(), radio_.end());
  set(s_.base.values);
}

// Levels and slopes of the world as it is must be those among all readings.
void OwnWorldFits::look_at_few() {
  auto made = with_fewer_readings(s_.model, s_.file, kept_);
  if (!made) return;
  few_.emplace(std::move(*made));
  const MatrixXd slopes = slopes_at(few_->by.model, s_.base);
  set(s_.base.values);
  if (!alike(few_->by.levels(), s_.base.mean(kept_)) ||
      !alike(slopes(few_->by.rows, Eigen::all), s_.base.slopes(kept_, Eigen::all)))
    few_.reset();
}

bool OwnWorldFits::may_level() const { return radios_.size() > 1 && radios_.size() <= thresholds::own_world_levels; }

VectorXd OwnWorldFits::Predictor::levels_with(const Hypothesis& h) try {
  const Supposed supposed(model, h);
  return levels();
} catch (const Error&) {
  return {};
}

DeclaredLevels OwnWorldFits::declared_levels(const std::vector<Hypothesis>& all) {
  look_at_few();
  ParameterGuard declared(s_.model);
  std::optional<ParameterGuard> declared_of_few;
  if (few_) declared_of_few.emplace(few_->by.model);
  for (const FitParameter& p : s_.fitted.parameters) {
    declared.set(p.path, p.start);
    if (few_) declared_of_few->set(p.path, p.start);
  }
  DeclaredLevels result{all_.levels(), {}};
  const auto change = [&](std::size_t k) {
    return result.with[k].size() > 0 ? (result.with[k] - result.plain).cwiseAbs().maxCoeff() : -1;
  };
  std::map<Kind, std::size_t> most;
  for (std::size_t k = 0; k < all.size(); ++k) {
    result.with.push_back(predictor_for(all[k]).levels_with(all[k]));
    const auto [entry, is_new] = most.try_emplace(kind_of(all[k]), k);
    if (!is_new && change(k) > change(entry->second)) entry->second = k;
  }
  if (!few_) return result;
  // A cause may take what a reading is from others, as of rows that slipped: each is looked at where it changes most.
  for (const auto& [kind, at] : most) {
    const VectorXd by_all = all_.levels_with(all[at]);
    if (alike(result.with[at], by_all)) continue;
    by_all_.insert(kind);
    for (std::size_t k = 0; k < all.size(); ++k)
      if (kind_of(all[k]) == kind) result.with[k] = k == at ? by_all : all_.levels_with(all[k]);
  }
  return result;
}

void OwnWorldFits::set(const VectorXd& values) {
  for (std::size_t j = 0; j < s_.base.paths.size(); ++j) {
    all_.moved.set(s_.base.paths[j], values[static_cast<Index>(j)]);
    if (few_) few_->by.moved.set(s_.base.paths[j], values[static_cast<Index>(j)]);
  }
}

OwnWorld OwnWorldFits::world_with(const Hypothesis& hypothesis) {
  set(s_.base.values);
  Predictor& predictor = predictor_for(hypothesis);
  Supposed supposed(predictor.model, hypothesis);
  OwnWorld world = linearised(hypothesis);
  for (int round = 0; round < 2 && world.hypothesis.place; ++round) {
    set(world.values);
    world.hypothesis.place = supposed.move(moved_to_best(supposed, predictor, *world.hypothesis.place));
    world = linearised(world.hypothesis);
  }
  set(s_.base.values);
  return world;
}

// At the parameters of the fit.
OwnWorld OwnWorldFits::linearised(const Hypothesis& hypothesis) {
  Predictor& predictor = predictor_for(hypothesis);
  Sensitivities own = s_.base;
  own.slopes = slopes_at(predictor.model, own);
  set(own.values);
  own.mean = predictor.model.expected();
  OwnWorld world{hypothesis, 0, 0, y_ - own.offset()(predictor.rows), own.slopes(predictor.rows, Eigen::all)};
  const auto ends = predictor.model.ends_now();
  for (const Index row : predictor.rows) world.ends.push_back(ends[static_cast<std::size_t>(row)]);
  world.rows = std::make_shared<std::optional<RowsOfWorld>>();
  world.values = bounded_least_squares(world.design, world.rest, own.lower, own.upper);
  world.squares = (world.rest - world.design * world.values).squaredNorm();
  world.levelled = world.squares;
  if (!may_level()) return world;
  MatrixXd design = world.design;
  for (Index j = 0; j < design.cols(); ++j) design.col(j) = centred(world.design.col(j), radio_);
  const VectorXd rest = centred(world.rest, radio_);
  world.levelled = (rest - design * bounded_least_squares(design, rest, own.lower, own.upper)).squaredNorm();
  return world;
}

InPlan OwnWorldFits::moved_to_best(Supposed& supposed, Predictor& predictor, const InPlan& start) {
  const auto value = [&](const VectorXd& theta) {
    supposed.move({theta[0], theta[1]});
    const VectorXd rest = y_ - predictor.levels();
    return -(rest.array() - rest.mean()).square().sum();
  };
  inference::Candidate place;
  const Eigen::Vector2d at(start[0], start[1]);
  place.refinement.lower = at.array() - thresholds::own_world_reach * scale_;
  place.refinement.upper = at.array() + thresholds::own_world_reach * scale_;
  place.refinement.step = Eigen::Vector2d::Constant(scale_);
  const VectorXd best = inference::local_search(place, at, 40, value).first;
  return {best[0], best[1]};
}

LinkReadings OwnWorldFits::readings_of(const OwnWorld& world) const {
  LinkReadings r;
  const auto n = static_cast<Index>(kept_.size());
  r.tx_at.resize(3, n);
  r.rx_at.resize(3, n);
  for (Index i = 0; i < n; ++i) {
    const auto& [tx, rx] = world.ends[static_cast<std::size_t>(i)];
    r.tx.push_back(tx.radio);
    r.rx.push_back(rx.radio);
    r.tx_at.col(i) << tx.x, tx.y, tx.z;
    r.rx_at.col(i) << rx.x, rx.y, rx.z;
    if (!s_.data.t.empty()) r.t.push_back(s_.data.t[static_cast<std::size_t>(kept_[static_cast<std::size_t>(i)])]);
  }
  r.twin = twins_in(world);
  r.twin_variance = s_.layout->readings().twin_variance;
  return r;
}

// The other direction's reading of each, where they are the two directions of one link in this world, too; empty:
// directions scatter apart.
std::vector<Index> OwnWorldFits::twins_in(const OwnWorld& world) const {
  const std::vector<Index>& twin = s_.layout->readings().twin;
  if (twin.empty()) return {};
  std::map<Index, Index> kept;  // by the number among the search's
  for (std::size_t i = 0; i < of_used_.size(); ++i) kept[of_used_[i]] = static_cast<Index>(i);
  std::vector<Index> result(of_used_.size(), -1);
  for (std::size_t i = 0; i < of_used_.size(); ++i) {
    const auto other = kept.find(twin[static_cast<std::size_t>(of_used_[i])]);
    if (other == kept.end()) continue;
    const auto& [tx, rx] = world.ends[i];
    const auto& [back_tx, back_rx] = world.ends[static_cast<std::size_t>(other->second)];
    if (tx.radio == back_rx.radio && rx.radio == back_tx.radio) result[i] = other->second;
  }
  return result;
}

// Single readings are rows: what is averaged in one world is of several links in another.
const RowsOfWorld& OwnWorldFits::rows_of(const OwnWorld& world) const {
  std::optional<RowsOfWorld>& made = *world.rows;
  if (!made) {
    LinkRowLimits limits;
    limits.way = -1;
    const LinkLayout layout(readings_of(world), limits, {}, true, drawn_correlation(s_.model));
    const noise::Rows rows = layout.rows();
    noise::Sites sites = layout.sites(rows);
    if (time_unit_ > 0) sites = noise::over_time(std::move(sites), layout.times(rows), time_unit_);
    made.emplace(RowsOfWorld{rows, noise::Field(std::move(sites), {.seed = s_.options.seed})});
  }
  return *made;
}

Likelihood OwnWorldFits::likelihood_of(const OwnWorld& world) const {
  const auto& [rows, field] = rows_of(world);
  const VectorXd y = rows.mean(world.rest);
  const MatrixXd design = rows.mean(world.design);
  const noise::Fit fit = noise::fit_families(field, y, design, prior()).front();
  return {fit.log_likelihood(), fit.covariance};
}

Likelihood OwnWorldFits::likelihood_of(const OwnWorld& world, const noise::Covariance& like, double least) const {
  const auto& [rows, field] = rows_of(world);
  const noise::Fit fit = noise::fit(field, rows.mean(world.rest), rows.mean(world.design), prior(), like);
  if (fit.log_likelihood() < least) return {fit.log_likelihood(), fit.covariance};
  return likelihood_of(world);
}

InPlan OwnWorldFits::settle(OwnWorld& world, const noise::Covariance& covariance) {
  InPlan sd{};
  constexpr double step = 0.05;  // m
  const OwnWorld start = world;  // its rows, whatever becomes of the place
  const auto& [rows, field] = rows_of(start);
  const noise::Whitener whitener(field, covariance);
  Predictor& predictor = predictor_for(world.hypothesis);
  for (int round = 0; round < 2; ++round) {
    set(world.values);
    MatrixXd columns(static_cast<Index>(kept_.size()), 2);
    {
      Supposed supposed(predictor.model, world.hypothesis);
      const InPlan at = *world.hypothesis.place;
      for (const std::size_t k : {0, 1}) {
        InPlan more = at, less = at;
        more[k] += step;
        less[k] -= step;
        supposed.move(more);
        columns.col(static_cast<Index>(k)) = predictor.levels();
        supposed.move(less);
        columns.col(static_cast<Index>(k)) -= predictor.levels();
      }
    }
    columns /= 2 * step;
    const noise::Whitened base = noise::whitened(whitener, rows.mean(world.rest), rows.mean(world.design), prior());
    const noise::Basis place = noise::basis_of(base.basis.rest(whitener(rows.mean(columns))));
    const VectorXd by = place.coefficients(place.q.transpose() * base.residual, 2);
    const MatrixXd uncertainty = place.uncertainty(2);
    for (const std::size_t k : {0, 1}) {
      sd[k] = std::sqrt(uncertainty(static_cast<Index>(k), static_cast<Index>(k)));
      (*world.hypothesis.place)[k] += std::clamp(by[static_cast<Index>(k)], -1.0, 1.0);
    }
    Supposed supposed(predictor.model, world.hypothesis);
    const Hypothesis here = world.hypothesis;
    world = linearised(here);
  }
  if (std::sqrt(covariance.reading_variance()) < thresholds::least_stated_scatter) stepped(world, rows, whitener);
  return sd;
}

// A likelihood has steps where a link begins to cross a wall, over which no slope leads: a plan that is 3 cm off leaves
// a few readings a whole wall off, which are outliers where nothing else scatters readings.
void OwnWorldFits::stepped(OwnWorld& world, const noise::Rows& rows, const noise::Whitener& whitener) {
  constexpr double reach = 0.25, step = 0.03;  // m
  const noise::Whitened base = noise::whitened(whitener, rows.mean(world.rest), rows.mean(world.design), prior());
  set(world.values);
  Predictor& predictor = predictor_for(world.hypothesis);
  Supposed supposed(predictor.model, world.hypothesis);
  const VectorXd before = predictor.levels();
  const auto value = [&](const VectorXd& theta) {
    supposed.move({theta[0], theta[1]});
    const VectorXd moved = predictor.levels() - before;
    return -(base.residual - base.basis.rest(whitener(rows.mean(moved)))).squaredNorm();
  };
  inference::Candidate place;
  const Eigen::Vector2d at((*world.hypothesis.place)[0], (*world.hypothesis.place)[1]);
  place.refinement.lower = at.array() - reach;
  place.refinement.upper = at.array() + reach;
  place.refinement.step = Eigen::Vector2d::Constant(step);
  const VectorXd best = inference::local_search(place, at, 60, value).first;
  Hypothesis there = world.hypothesis;
  there.place = supposed.move({best[0], best[1]});
  world = linearised(there);
}

OwnWorld OwnWorldFits::with_levels(OwnWorld world) const {
  const Index own = world.design.cols();
  world.design.conservativeResize(Eigen::NoChange, own + static_cast<Index>(radios_.size()) - 1);
  world.design.rightCols(world.design.cols() - own).setZero();
  for (std::size_t i = 0; i < radio_.size(); ++i) {
    const auto at = std::distance(radios_.begin(), radios_.find(radio_[i]));
    if (at > 0) world.design(static_cast<Index>(i), own + at - 1) = 1;
  }
  return world;
}

}  // namespace muster::diagnosis
