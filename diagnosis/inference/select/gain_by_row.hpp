// Which rows carry the gain of a candidate: all of its groups, or a few readings that may be outliers.
#pragma once

#include "diagnosis/inference/score/candidate_scores.hpp"
#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// Gain of columns by row, and the share of it that remains with residuals clipped at four standard errors.
struct GainByRow {
  Eigen::VectorXd won;
  double tame_share;
};

GainByRow gain_by_row(const WhitenedModel& model, const Eigen::MatrixXd& columns);

// Share of the gain from groups other than the strongest one. `won`: the gain of each row.
double share_of_others(const ModelState& state, const Eigen::VectorXd& won);

// True for an outlier fitted by a place. Few readings carry the gain, and clipped residuals leave less than half of
// it, or no more than chance; nor do those that carry less, to which an outlier leaks as their neighbour.
bool of_outlier(const ModelState& state, const ScoredCandidate& lead, const WhitenedModel& model,
                const noise::Covariance& covariance, const GainByRow& gains_by_row);

// Of the rows that won most and of those that the model, which is without its columns, leaves farthest off: rows that
// are not what all others let expect, the farthest first. Fewer than five readings; may be empty.
std::vector<Index> outliers_among(const ModelState& state, const WhitenedModel& model, const GainByRow& gains_by_row);

}  // namespace muster::inference
