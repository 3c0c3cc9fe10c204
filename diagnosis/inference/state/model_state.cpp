#include "diagnosis/inference/state/model_state.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/noise/exact_covariance.hpp"
#include "diagnosis/inference/noise/over_time.hpp"
#include "diagnosis/inference/state/null_calibration.hpp"
#include "diagnosis/inference/state/null_tail.hpp"
#include "diagnosis/inference/state/smooths.hpp"
#include "diagnosis/inference/thresholds.hpp"
#include "muster/random.hpp"

namespace muster::inference {
namespace {

noise::Sheet normals_of(Index rows, int count, uint64_t seed) {
  const Stream stream(combined(key_of("whitened nulls"), seed));
  noise::Sheet result(rows, count);
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < count; ++j)
      result(i, j) = static_cast<float>(stream.normal(static_cast<uint64_t>(i), static_cast<uint64_t>(j)));
  }
  return result;
}

// True if draws with one field serve for the other.
bool alike(const noise::StatedField& one, const noise::StatedField& other) {
  const auto close = [](double a, double b) { return std::abs(std::log(a / b)) < thresholds::same_field; };
  return close(one.shadowing, other.shadowing) && close(one.decorrelation, other.decorrelation);
}

// Adapts a tally of split rows to the problem's rows.
class OfOrigin : public Tally {
 public:
  OfOrigin(const std::vector<Index>& origin, Tally& tally) : tally_(tally) {
    for (std::size_t row = 0; row < origin.size(); ++row) {
      while (static_cast<std::size_t>(origin[row]) >= first_.size()) first_.push_back(static_cast<Index>(row));
    }
    first_.push_back(static_cast<Index>(origin.size()));
  }

  Index rows() const override { return static_cast<Index>(first_.size()) - 1; }
  void clear() override { tally_.clear(); }
  void add(Index row, double value) override {
    const auto k = static_cast<std::size_t>(row);
    for (Index of = first_[k]; of < first_[k + 1]; ++of) tally_.add(of, value);
  }
  double gain() const override { return tally_.gain(); }

 private:
  Tally& tally_;
  std::vector<Index> first_;
};

}  // namespace

Eigen::MatrixXd Entry::atom(Index k) const {
  return atoms->middleCols(k * candidate->design.width, candidate->design.width).cast<double>();
}

double WhitenedModel::gain(const Eigen::MatrixXd& columns) const {
  const auto added = noise::basis_of(at.basis.rest(whitener(columns)));
  return (added.q.transpose() * at.residual).squaredNorm();
}

double WhitenedModel::exact_gain(const noise::Field& field, const Eigen::MatrixXd& columns) const {
  const auto added = noise::basis_of(at.basis.rest(whitener(columns)));
  return noise::exact_gain(field, whitener, added.q, at.residual);
}

double WhitenedModel::gain_as_it_is(const Eigen::MatrixXd& columns) const {
  const Eigen::VectorXd left = at.basis.rest(whitener(columns)).rowwise().sum();
  return 2 * left.dot(at.residual) - left.squaredNorm();
}

double WhitenedModel::skew_charge(const Eigen::MatrixXd& columns) const {
  const auto added = noise::basis_of(at.basis.rest(whitener(columns)));
  const Eigen::ArrayXd effect = (added.q * (added.q.transpose() * at.residual)).array();
  const Eigen::ArrayXd scatter = at.residual.array() - effect;
  double third = 0;  // cumulant of the columns' sum
  for (const bool of_alone : {false, true}) {
    double count = 0, squares = 0, cubes = 0, weights = 0;
    for (Index i = 0; i < scatter.size(); ++i) {
      if ((!alone.empty() && alone[static_cast<std::size_t>(i)]) != of_alone) continue;
      count += 1;
      squares += scatter[i] * scatter[i];
      cubes += scatter[i] * scatter[i] * scatter[i];
      weights += effect[i] * effect[i] * effect[i];
    }
    // What scatters less than the noise counts as it is: a few of many exact zeros are as skewed as can be.
    if (squares > 0) third += cubes / count / std::pow(std::max(1.0, squares / count), 1.5) * weights;
  }
  const double energy = effect.square().sum();
  return inference::skew_charge(std::sqrt(energy), third / std::pow(energy, 1.5));
}

Eigen::VectorXd WhitenedModel::coefficients(Index columns) const {
  return at.basis.coefficients(at.basis.q.transpose() * at.y, columns);
}

ModelState::ModelState(const Problem& problem, const Options& options)
    : problem_(problem),
      options_(options),
      rows_(problem.layout->rows()),
      field_(field_of(rows_)),
      base_(rows_.mean(problem.base)),
      normals_(normals_of(rows_.size(), options.nulls, options.seed)) {
  impute(6);
  families = noise::fit_families(field_, y_, base_, options_.prior);
  fit = families[0];
  if (problem_.bounds.any()) {
    fit_to_draws();
    families = noise::fit_families(field_, y_, base_, options_.prior);
  }
  for (const Candidate& candidate : problem.candidates) entries_.push_back(entry(candidate));
  for (const Candidate& candidate : problem.smooths) entries_.push_back(entry(candidate));
  fixed_ = entries_.size();
  correlate_over_time();
  fit = families[0];
  if (time_unit_ > 0 && problem_.bounds.any()) {
    fit_to_draws();
    families[0] = fit;
  }
}

noise::Sites ModelState::sites_of(const noise::Rows& rows) const {
  noise::Sites sites = problem_.layout->sites(rows);
  return time_unit_ > 0 ? noise::over_time(std::move(sites), problem_.layout->times(rows), time_unit_) : sites;
}

noise::Field ModelState::field_of(const noise::Rows& rows) const {
  return noise::Field(sites_of(rows), {.seed = options_.seed});
}

Index ModelState::end_rows_at(const Candidate& candidate, const Eigen::VectorXd& theta) {
  const Eigen::MatrixXd at_readings = candidate.design.columns(theta);
  const Eigen::VectorXd effect = at_readings.rowwise().sum();
  const double most = effect.cwiseAbs().maxCoeff();
  std::vector<Index> parent;
  noise::Rows rows = rows_.ended_where(effect, thresholds::edge_share * most, parent);
  const Index more = rows.size() - rows_.size();
  if (more == 0) return 0;
  rows_ = std::move(rows);
  field_ = field_of(rows_);
  far_.reset();
  starts_.clear();
  whiteners_.clear();
  base_ = rows_.mean(problem_.base);
  y_ = rows_.mean(measured_);
  for (Term& term : terms) term.columns = columns_of(*term.candidate, term.theta);
  // Atoms keep their values in the split rows: grids are coarse.
  for (Entry& entry : entries_) {
    noise::Sheet atoms = (*entry.atoms)(parent, Eigen::all);
    entry.atoms = std::make_shared<const noise::Sheet>(std::move(atoms));
  }
  normals_ = normals_(parent, Eigen::all).eval();
  for (Index& row : parent) row = origin_.empty() ? row : origin_[static_cast<std::size_t>(row)];
  origin_ = std::move(parent);
  return more;
}

Eigen::MatrixXd ModelState::sketch_of(const Candidate& candidate, const Eigen::VectorXd& theta) const {
  Eigen::MatrixXd sketch = candidate.design.sketch(theta);
  if (origin_.empty()) return sketch;
  return sketch(origin_, Eigen::all);
}

std::vector<Eigen::VectorXd> ModelState::proposals(const Candidate& candidate, Tally& tally) const {
  if (origin_.empty()) return candidate.refinement.proposed(tally);
  OfOrigin of_origin(origin_, tally);
  return candidate.refinement.proposed(of_origin);
}

Eigen::MatrixXd ModelState::design_of_readings() const {
  Eigen::MatrixXd design = problem_.base;
  for (const Term& term : terms) {
    const Index from = design.cols();
    design.conservativeResize(Eigen::NoChange, from + term.columns.cols());
    for (Index j = 0; j < term.columns.cols(); ++j) design.col(from + j) = rows_.at_readings(term.columns.col(j));
  }
  return design;
}

Eigen::VectorXd ModelState::mean_of_readings() const {
  const Eigen::MatrixXd at_readings = design_of_readings();
  return at_readings * whitened_model(design()).coefficients(at_readings.cols());
}

Eigen::MatrixXd ModelState::units_of(const std::vector<Index>& rows) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows_.size(), static_cast<Index>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k) result(rows[k], static_cast<Index>(k)) = 1;
  return result;
}

void ModelState::set_aside(const std::vector<Index>& rows, const WhitenedModel& model) {
  const Eigen::MatrixXd units = units_of(rows);
  const WhitenedModel without = whitened_model(noise::hstack(model.design, units), model.whitener.covariance());
  const Eigen::VectorXd off =
      rows_.at_readings(units * without.coefficients(model.design.cols() + units.cols()).tail(units.cols()));
  if (aside_.size() == 0) aside_ = Eigen::VectorXd::Zero(off.size());
  aside_ += off;
  measured_ -= off;
  y_ = rows_.mean(measured_);
}

Index ModelState::take_back_all() {
  if (aside_.size() == 0) return 0;
  const Index count = (aside_.array() != 0).count();
  measured_ += aside_;
  aside_.resize(0);
  y_ = rows_.mean(measured_);
  return count;
}

Eigen::MatrixXd ModelState::design(const std::function<bool(const Term&)>& left_out) const {
  Eigen::MatrixXd result = base_;
  for (const Term& term : terms) {
    if (left_out && left_out(term)) continue;
    result.conservativeResize(Eigen::NoChange, result.cols() + term.columns.cols());
    result.rightCols(term.columns.cols()) = term.columns;
  }
  return result;
}

Eigen::MatrixXd ModelState::design_without(const Term& term) const {
  return design([&](const Term& other) { return &other == &term; });
}

WhitenedModel ModelState::whitened_model(const Eigen::MatrixXd& design, const noise::Covariance& covariance) const {
  noise::Whitener whitener = whitener_at(covariance);
  noise::Whitened at = noise::whitened(whitener, y_, design, options_.prior);
  std::vector<bool> alone;
  if (!field_.sites().alone.empty()) {
    for (Index i = 0; i < rows_.size(); ++i) alone.push_back(field_.sites().is_alone(i));
  }
  return {std::move(whitener), std::move(at), design, std::move(alone)};
}

const noise::Whitener& ModelState::whitener_at(const noise::Covariance& covariance) const {
  constexpr std::size_t most = 4;
  const auto there = std::find_if(whiteners_.begin(), whiteners_.end(),
                                  [&](const noise::Whitener& known) { return known.covariance() == covariance; });
  if (there != whiteners_.end()) return *there;
  if (whiteners_.size() == most) whiteners_.pop_front();
  return whiteners_.emplace_back(field_, covariance);
}

noise::Fit ModelState::fitted(const Eigen::MatrixXd& design, const noise::Covariance& start, int steps) const {
  const noise::WhitenerSlopes& from = factorised_at({start.family, options_.prior.inside(start.theta)});
  return steps >= thresholds::steps_over_shares
             ? noise::fit_over_shares(field_, y_, design, options_.prior, from, steps)
             : noise::fit(field_, y_, design, options_.prior, from, steps);
}

const noise::WhitenerSlopes& ModelState::factorised_at(const noise::Covariance& start) const {
  constexpr std::size_t most = 4;
  const auto there = std::find_if(starts_.begin(), starts_.end(), [&](const noise::WhitenerSlopes& known) {
    return known.is_of(field_) && known.whitener().covariance() == start;
  });
  if (there != starts_.end()) return *there;
  if (starts_.size() == most) starts_.pop_front();
  return starts_.emplace_back(field_, start);
}

std::vector<noise::Family> ModelState::likely_families(noise::Family first) const {
  std::vector<noise::Family> result{first};
  for (const noise::Fit& other : families) {
    if (other.covariance.family != first && other.value < families[0].value + thresholds::likely_nats)
      result.push_back(other.covariance.family);
  }
  return result;
}

std::vector<noise::StatedField> ModelState::drawable(const noise::Covariance& fitted) const {
  const noise::StatedField there = noise::stated_by(fitted, within());
  if (stated().shadowing <= 0) return {there};
  if (alike(stated(), there)) return {stated()};
  return {stated(), there};
}

const Eigen::MatrixXd& ModelState::drawn(const noise::StatedField& field) const {
  Drawn& kept = alike(problem_.stated, field) ? of_stated_ : of_fitted_;
  if (problem_.drawn && time_unit_ == 0 && !alike(kept.field, field))
    kept = {field, problem_.drawn(field, thresholds::model_draws), {}};
  if (kept.rows.rows() != rows_.size())
    kept.rows = kept.readings.size() ? rows_.mean(kept.readings) : Eigen::MatrixXd(rows_.size(), 0);
  return kept.rows;
}

const LongRangeRows& ModelState::far() const {
  if (!far_) {
    noise::Rows rows = problem_.layout->long_rows();
    noise::Sites sites = sites_of(rows);
    far_ = std::make_unique<const LongRangeRows>(std::move(rows), std::move(sites), options_, rows_);
  }
  return *far_;
}

Entry ModelState::entry(Candidate candidate) const {
  if (candidate.design.grid.empty() || candidate.covariates.empty())
    throw std::invalid_argument(candidate.id + ": a candidate has at least one start and one covariate");
  std::shared_ptr<const noise::Sheet> known = std::move(candidate.design.atoms);
  Entry result{std::make_shared<const Candidate>(std::move(candidate)), std::move(known)};
  if (result.atoms && result.atoms->rows() == rows_.size()) return result;
  const Candidate& c = *result.candidate;
  noise::Sheet atoms(rows_.size(), result.count() * c.design.width);
  for (Index k = 0; k < result.count(); ++k) {
    const Eigen::VectorXd& theta = c.design.grid[static_cast<std::size_t>(k)];
    atoms.middleCols(k * c.design.width, c.design.width) = columns_of(c, theta).cast<float>();
  }
  result.atoms = std::make_shared<const noise::Sheet>(std::move(atoms));
  return result;
}

void ModelState::renew_depending(const Eigen::VectorXd& coefficients) {
  entries_.resize(fixed_);
  const Eigen::VectorXd of_base = coefficients.head(base_.cols());
  if (problem_.depending) {
    for (Candidate& candidate : problem_.depending(of_base)) entries_.push_back(entry(std::move(candidate)));
  }
  Candidate level = smooth_of("level", problem_.base * of_base, 5);
  level.role.level_like = true;
  entries_.push_back(entry(std::move(level)));
}

const Entry& ModelState::entry_of(const Candidate& candidate) const {
  for (const Entry& entry : entries_) {
    if (entry.candidate->id == candidate.id) return entry;
  }
  throw std::logic_error(candidate.id + ": no such candidate");
}

Eigen::MatrixXd ModelState::columns_of(const Candidate& candidate, const Eigen::VectorXd& theta) const {
  return rows_.mean(candidate.design.columns(theta));
}

double ModelState::log_effective_tests(const Entry& entry, const OrthonormalAtoms& unit) {
  const auto [place, missing] = log_effective_tests_.try_emplace(entry.candidate->id, 0.0);
  if (missing) place->second = inference::log_effective_tests(*entry.candidate, unit, normals_);
  return place->second;
}

double ModelState::log_p(const Candidate& candidate, double gain, Index width, bool refined) const {
  return log_effective_tests(candidate) + (refined ? candidate.refinement.charge : 0) +
         log_tail(gain, static_cast<double>(width)) + (candidate.design.sign ? -std::log(2.0) : 0);
}

double ModelState::evidence(const Candidate& candidate, double gain, Index width, bool refined) const {
  // A whole column without refinement has no strength to be paid for.
  const double strengths = candidate.design.whole && !candidate.refinement.any() ? 0 : static_cast<double>(width);
  return gain / 2 - strengths / 2 * log_rows() - log_effective_tests(candidate) -
         (refined ? candidate.refinement.charge : 0);
}

double ModelState::threshold() const {
  const double alpha = terms.empty() ? options_.first_alpha : options_.further_alpha;
  return std::log(alpha / static_cast<double>(entries_.size()));
}

}  // namespace muster::inference
