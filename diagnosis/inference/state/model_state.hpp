// Search state: averaged rows, covariance, candidates and accepted terms.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>

#include "diagnosis/inference/noise/vecchia.hpp"
#include "diagnosis/inference/state/long_range_rows.hpp"

namespace muster::inference {

class OrthonormalAtoms;

// A candidate with the row means of its grid's columns, `width` an atom.
struct Entry {
  std::shared_ptr<const Candidate> candidate;
  std::shared_ptr<const noise::Sheet> atoms;

  Index count() const { return static_cast<Index>(candidate->design.grid.size()); }
  Eigen::MatrixXd atom(Index k) const;
};

// A cause or smooth accepted into the model.
struct Term {
  std::shared_ptr<const Candidate> candidate;
  Eigen::VectorXd theta;
  Eigen::MatrixXd columns;  // row means
  double gain = 0;          // fall of the deviance beside all other terms
  double evidence = 0;      // nats
  double log_p = 0;
  double inflation = 1;    // by which gains of its kind are too high in these data
  bool as_smooth = false;  // named cause withdrawn: it counts as its covariate's smooth
  bool as_stated = false;  // significant with the field as the model states it, but not with a fitted one

  bool smooth() const { return as_smooth || candidate->kind == Kind::smooth; }
  std::string id() const { return smooth() ? "~" + candidate->own() : candidate->id; }
};

// A design whitened at one covariance.
struct WhitenedModel {
  noise::Whitener whitener;
  noise::Whitened at;
  Eigen::MatrixXd design;
  std::vector<bool> alone{};  // of rows whose noise is their own, such as differences of twins; empty: none

  // Fall of the deviance if these columns (row means) are added.
  double gain(const Eigen::MatrixXd& columns) const;
  // The same as a chi-square under the exact covariance (inference/noise/exact_covariance.hpp). Slow.
  double exact_gain(const noise::Field& field, const Eigen::MatrixXd& columns) const;
  // The same with all coefficients at 1.
  double gain_as_it_is(const Eigen::MatrixXd& columns) const;
  // Log ratio, nats, of that fall's density under noise as skewed as the residuals to its density under normal noise.
  // Deep negative residuals that lie together resemble a loss. Rows alone have a skewness of their own.
  double skew_charge(const Eigen::MatrixXd& columns) const;
  Eigen::VectorXd coefficients(Index columns) const;
};

class ModelState {
 public:
  ModelState(const Problem& problem, const Options& options);

  const Problem& problem() const { return problem_; }
  const Options& options() const { return options_; }
  const noise::Rows& rows() const { return rows_; }
  const noise::Field& field() const { return field_; }
  double within() const { return field_.correlated().within(); }  // m: the mean distance of two readings of a row
  // s: of one unit of the decorrelation distance, where errors are correlated over time; 0 where over places.
  double time_unit() const { return time_unit_; }
  // Splits rows where the effect of a candidate there, fitted beside the model, sets in or stops. A mean over its
  // edges would lose up to half of the gain. Returns the number of new rows. Invalidates earlier WhitenedModels and
  // columns.
  Index end_rows_at(const Candidate& candidate, const Eigen::VectorXd& theta);
  // Built on first use: most searches do without.
  const LongRangeRows& far() const;
  // Standard normal residuals, one set a column: the null of everything whitened.
  const noise::Sheet& normals() const { return normals_; }
  // The field that the model states; none where errors are correlated over time: it draws no such errors.
  noise::StatedField stated() const { return time_unit_ > 0 ? noise::StatedField() : problem_.stated; }
  // The fields that the errors may be draws of, by the model itself: the stated one, and that of a fit where it is
  // another.
  std::vector<noise::StatedField> drawable(const noise::Covariance& fitted) const;
  // Errors of the rows in draws of the model itself, with about such a field; no columns if it draws none. Kept, those
  // of a fitted field until it has changed.
  const Eigen::MatrixXd& drawn(const noise::StatedField& field) const;
  double log_rows() const { return std::log(static_cast<double>(rows_.size())); }

  noise::Fit fit;                    // noise beside the design
  std::vector<noise::Fit> families;  // fits of the first pass, the best one first
  // This family, and those close to the best one in the first fit.
  std::vector<noise::Family> likely_families(noise::Family first) const;
  std::vector<Term> terms;

  const Eigen::VectorXd& y() const { return y_; }
  const Eigen::VectorXd& measured() const { return measured_; }  // the readings whose row means y holds
  // Of every reading, by the model with all its terms.
  Eigen::VectorXd mean_of_readings() const;
  // Imputes censored readings anew from the current model: draws of theirs, once the noise is known.
  void impute(int rounds);
  // Draws censored readings part way between the present model and one with these columns (row means) as well. Draws of
  // the present one hide what a lead gains, and draws of the other grant it. A log ratio of likelihoods is the integral
  // of the expected log ratio of densities over all mixtures of both (path sampling: Gelman and Meng 1998), which the
  // middle stands for: of columns that are `whole`, whose strength is known. Those whose strength is fitted to the
  // draws would gain too much: with a share f of their effect in readings that tell nothing, (1 - f + f t)^2 instead of
  // 1 - f where the mean is moved by t. They are equal at t = s / (1 + s), s^2 = 1 - f. A draw's own scatter gains,
  // too: of several draws that is taken whose gain is nearest to the gain of what they have in common.
  void draw_towards(const Eigen::MatrixXd& columns, bool whole = false);
  // The censored readings as they are drawn now, with the noise that is fitted to them.
  struct Draws {
    Eigen::VectorXd measured, errors;
    noise::Fit fit;
  };
  Draws draws() const;
  void put_back(Draws draws);
  // Has rows count as what all others let expect of them. `model`: the present one, without them.
  void set_aside(const std::vector<Index>& rows, const WhitenedModel& model);
  // Has all count as measured again. Returns how many readings had been set aside.
  Index take_back_all();
  // Columns that are 1 at one of these rows each, which leave nothing of it to any other column.
  Eigen::MatrixXd units_of(const std::vector<Index>& rows) const;

  // Base columns and terms, without the terms selected by `left_out`.
  Eigen::MatrixXd design(const std::function<bool(const Term&)>& left_out = {}) const;
  Eigen::MatrixXd design_without(const Term& term) const;
  Index sensitivities() const { return base_.cols(); }
  const Eigen::MatrixXd& base() const { return base_; }

  WhitenedModel whitened_model(const Eigen::MatrixXd& design) const { return whitened_model(design, fit.covariance); }
  WhitenedModel whitened_model(const Eigen::MatrixXd& design, const noise::Covariance& covariance) const;
  // Residual of the rows after a fit of the design.
  Eigen::VectorXd left_by(const Eigen::MatrixXd& design, const WhitenedModel& model) const {
    return y_ - design * model.coefficients(design.cols());
  }
  Eigen::VectorXd left_by(const Eigen::MatrixXd& design) const { return left_by(design, whitened_model(design)); }
  noise::Fit fitted(const Eigen::MatrixXd& design, const noise::Covariance& start, int steps) const;
  void refit(int steps = 6) { fit = fitted(design(), fit.covariance, steps); }

  // All candidates: the given ones, smooths, and those that depend on the current model.
  const std::vector<Entry>& entries() const { return entries_; }
  void renew_depending(const Eigen::VectorXd& coefficients);
  const Entry& entry_of(const Candidate& candidate) const;
  Eigen::MatrixXd columns_of(const Candidate& candidate, const Eigen::VectorXd& theta) const;
  Eigen::MatrixXd sketch_of(const Candidate& candidate, const Eigen::VectorXd& theta) const;
  // Start thetas that a candidate proposes, from a tally over these rows.
  std::vector<Eigen::VectorXd> proposals(const Candidate& candidate, Tally& tally) const;

  // Log of the effective number of tests, from nulls; computed once a candidate.
  double log_effective_tests(const Entry& entry, const OrthonormalAtoms& unit);
  double log_effective_tests(const Candidate& candidate) const { return log_effective_tests_.at(candidate.id); }
  double log_p(const Candidate& candidate, double gain, Index width, bool refined) const;
  double evidence(const Candidate& candidate, double gain, Index width, bool refined) const;
  // log p below which a term is accepted.
  double threshold() const;

 private:
  Entry entry(Candidate candidate) const;
  Eigen::MatrixXd design_of_readings() const;
  noise::Field field_of(const noise::Rows& rows) const;
  noise::Sites sites_of(const noise::Rows& rows) const;
  void draw_censored();
  // Sweeps about this mean (one a reading), to which the errors of the last draws are moved along.
  void draw_about(const std::function<Eigen::VectorXd()>& mean_given_draws, uint64_t sweeps);
  std::function<Eigen::VectorXd()> mean_with(const Eigen::MatrixXd& columns) const;  // fitted to the draws each time
  // Of several draws about this mean, the one in which the columns gain what all have in common.
  void take_typical_draw(const Eigen::VectorXd& mean, const Eigen::MatrixXd& columns);
  void fit_to_draws();  // alternates draws of the censored readings and the noise
  void correlate_over_time();
  Eigen::MatrixXd likeliest_in_time() const;
  void climb(const Candidate& candidate, const WhitenedModel& model, Eigen::VectorXd& theta) const;
  bool wanders(const noise::Field& over_time, const noise::Fit& best) const;
  const noise::WhitenerSlopes& factorised_at(const noise::Covariance& start) const;
  const noise::Whitener& whitener_at(const noise::Covariance& covariance) const;

  const Problem& problem_;
  Options options_;
  noise::Rows rows_;
  std::vector<Index> origin_;  // of each row, the problem's row that it is part of; empty: they are the same
  double time_unit_ = 0;
  noise::Field field_;
  mutable std::unique_ptr<const LongRangeRows> far_;
  mutable std::deque<noise::WhitenerSlopes> starts_;  // of the last fits: beside each candidate they start alike
  mutable std::deque<noise::Whitener> whiteners_;     // of the last models: most are whitened at one covariance
  Eigen::MatrixXd base_;
  Eigen::VectorXd measured_, y_;
  Eigen::VectorXd aside_;            // by which readings that were set aside are off; empty: none was
  Eigen::VectorXd errors_of_draws_;  // of the readings beside the mean with which the censored ones were drawn last
  uint64_t sweeps_ = 0;              // of the Gibbs sampler so far: each has numbers of its own
  std::vector<Entry> entries_;
  std::size_t fixed_ = 0;  // entries before those that depend on the model
  noise::Sheet normals_;
  struct Drawn {
    noise::StatedField field;
    Eigen::MatrixXd readings, rows;  // one column a draw
  };
  mutable Drawn of_stated_, of_fitted_;
  std::map<std::string, double> log_effective_tests_;
};

}  // namespace muster::inference
