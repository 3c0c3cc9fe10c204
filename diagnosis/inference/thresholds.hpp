// Thresholds and tuning constants of the inference. Grid sizes, iteration counts and rounding floors stay where they
// are used.
//
// Above each constant: unit; meaning; origin; the test that fails if it is badly changed. Origins: derived from theory,
// measured on worlds of known truth, or chosen. docs/reference/thresholds.md is made of this by scripts/thresholds.
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace muster::inference::thresholds {

// noise

// ln m; prior mean of the decorrelation distance, that of 1.8 m; chosen; none
inline constexpr double prior_log_decorrelation = 0.5878;
// ln m; prior standard deviation of the decorrelation distance, a factor of two; chosen; none
inline constexpr double prior_decorrelation_spread = 0.7;
// logit; prior mean of the share of the field that groups have in common; chosen; none
inline constexpr double prior_logit_shared = -1.5;
// logit; prior standard deviation of that share; chosen; none
inline constexpr double prior_shared_spread = 1.5;
// ln variance; of the field or of one reading, unless readings are known to be as exact; chosen; none
inline constexpr double log_least_variance = -3;
// 1; least curvature in any direction, which bounds the standard deviation of theta by about two; chosen; none
inline constexpr double least_curvature = 0.3;
// 1; a fit is given up whose value stays too high even if it falls by that many times the expected gain; chosen;
// FixedShare.IsTheBestOfItsNeighboursFittedInFull
inline constexpr double trusted_multiple = 5;
// nats; advantage needed to leave the exponential family; chosen; Fit.DistinguishesASmoothFieldFromAnExponentialOne
inline constexpr double leave_exponential_nats = 2;

// state

// probability; of a first false name over all candidates; chosen; CleanWorlds.NoFalseNames
inline constexpr double first_alpha = 0.003;
// probability; of a further false name over all candidates; chosen; Planted.AtLambda60IsNamed
inline constexpr double further_alpha = 0.0015;
// draws; for the effective number of tests; chosen; none
inline constexpr int nulls = 200;
// draws; of the covariance, for the marginal p-value; chosen; none
inline constexpr int covariance_draws = 32;
// nats; charge of a place that one group alone supports; chosen; none
inline constexpr double one_group_charge = 6;
// share; of a smooth's gain that a cause explains to replace it; chosen;
// BackwardElimination.ReplacesASmoothByTheCauseThatExplainsIt
inline constexpr double replacing_share = 0.9;
// share; of the gain of several pieces that one object explains to replace them; chosen;
// MergeDuplicates.TwoSeparateWallsRemainTwo
inline constexpr double merge_share = 0.93;
// share; of the gain of all terms of one name on one row, at which the one that explains it keeps the name; chosen;
// BackwardElimination.OfTwoOfOneNameTheOneThatLeadsKeepsIt
inline constexpr double leading_share = 0.7;
// terms; of one model; chosen; none
inline constexpr int most_terms = 6;
// nats; by which a family may be behind the best one; chosen; none
inline constexpr double likely_nats = 3;
// nats; beyond those, at which a family is excluded from the least gain; chosen; none
inline constexpr double hopeless_nats = 12;
// factor; by which gains of global effects are wider than chi-square; measured;
// LongRangeRows.SmoothsNeedMoreThanTheChiSquareTail
inline constexpr double overdispersion = 1.2;
// share; of an effect's maximum at which rows are split; chosen;
// ModelState.RowsThatEndAtAnObstaclesEdgesKeepMoreOfItsInformation
inline constexpr double edge_share = 1.0 / 3;

// score

// nats; by which a family with the columns inside may be worse in the marginal p-value; chosen; none
inline constexpr double excluded_nats = 3;
// nats; by which a family without the columns may be worse in the marginal p-value; chosen; none
inline constexpr double hopeless_start_nats = 6;
// rounds; in which censored readings are drawn and the noise is fitted to them; chosen;
// CensoredDraws.LeaveTheNoiseAsWideAsItIs
inline constexpr int rounds_of_censored = 5;
// sweeps; of the Gibbs sampler in each; chosen; CensoredDraws.LeaveTheNoiseAsWideAsItIs
inline constexpr uint64_t sweeps_of_censored = 6;
// draws; of censored readings nearer to a lead, of which a typical one is taken; chosen;
// CensoredDraws.NearerToALeadGrantItItsGain
inline constexpr std::size_t draws_of_a_lead = 5;
// standard deviations; distance from a clip at which a reading is clear of it; chosen;
// Search.NoFalseExponentOrDualSlopeForAFloor
inline constexpr double clear_of_clip = 1.5;
// rows; clear of a clip, for a test on them; chosen; none
inline constexpr std::size_t fewest_clear_rows = 60;
// probability; of a gain on rows clear of a clip; chosen; Search.NoFalseExponentOrDualSlopeForAFloor
inline constexpr double clear_alpha = 1e-3;
// draws; effective sample size below which weights are tempered; chosen;
// ImportanceWeights.TemperingWidensWhereFewDrawsHaveAllTheWeight
inline constexpr double fewest_effective = 40;
// steps; between two starts of a refinement; chosen; none
inline constexpr double start_distance = 4;
// share; of the field's variance kept for the first heat of a place; chosen; none
inline constexpr double soft_field_share = 0.05;
// share; of the field's variance kept for the second heat of a place; chosen; none
inline constexpr double half_field_share = 0.4;

// select: forward selection

// sites; of a standing network beyond the numbers of its model, from which the fitted noise knows how levels differ;
// chosen; StandingSites.FewLevelsAreHeldToAnFTest
inline constexpr std::ptrdiff_t few_levels = 20;
// standard errors; from what all others let expect, beyond which a row that misleads a place is set aside; chosen;
// Outdoors.AHillIsFoundBesideStrayReadings
inline constexpr double outlying_errors = 5;
// times; that rows are set aside in one search; chosen; none
inline constexpr int most_set_aside = 6;

// readings; that carry half of a gain, fewer than which may be outliers; chosen; Search.NoFalseWallForAnOutlier
inline constexpr double few_readings = 5;
// rows; that win most, without which a cause must still win: an outlier is in its neighbours' whitened rows, too;
// chosen; Search.NoFalseWallForAnOutlier
inline constexpr std::size_t rows_of_an_outlier = 10;
// standard errors; at which residuals are clipped for the test of outliers; chosen; Search.NoFalseWallForAnOutlier
inline constexpr double usual_errors = 4;
// share; of a gain left by clipped residuals, below which it is that of outliers; chosen; none
inline constexpr double tame_share = 0.5;
// columns; beyond which an effect is large, and the noise is fitted beside it in more steps; chosen; none
inline constexpr Eigen::Index large_width = 2;
// deviance; beyond which an effect is large, and the noise is fitted beside it in more steps; chosen; none
inline constexpr double large_gain = 60;
// deviance; beyond which the noise is fitted from scratch as well; chosen; none
inline constexpr double afresh_gain = 200;
// share; of information kept in longer rows, above which these are tested too; chosen; none
inline constexpr double kept_information = 0.6;
// nats; log p below which the uncertainty of the noise changes no decision; chosen; none
inline constexpr double log_p_beyond_noise = -40;
// nats; log p below which the error of Vecchia's approximation changes no decision; chosen; none
inline constexpr double log_p_beyond_approximation = -100;
// nats; log p below which rows are not split at a place's edges before it enters; chosen; none
inline constexpr double log_p_beyond_edges = -40;
// share; of a gain from other groups than the strongest, below which one group alone supports a place; chosen; none
inline constexpr double share_of_others = 0.08;
// deviance; gained by a further refinement, below which it ends; chosen; none
inline constexpr double refine_again_gain = 2;
// nats; advantage needed to leave the present family once an effect is in the model; chosen; none
inline constexpr double leave_family_nats = 2;
// deviance; of a term, beyond which the family is selected again; chosen; none
inline constexpr double family_again_gain = 30;
// nats; by which a place may miss the threshold and is tested again with split rows; chosen; Wall.IsFoundAtItsEdges
inline constexpr double near_miss_nats = 7;

// select: comparison of leads

// nats; by which a smooth of an observed column must be ahead of a cause in time, which has a name; chosen;
// SimulatedDraws.WhatDependsOnTimeIsNoBattery
inline constexpr double unnamed_nats = 3;
// nats; of evidence for twice as many functions of a smooth; chosen; none
inline constexpr double grow_nats = 3;
// cosine squared; from which two causes have the same effect; chosen;
// Compared.SimplerOfTwoEqualEffectsComesFirst
inline constexpr double same_effect = 0.99;
// smooths; compared in one round; chosen; none
inline constexpr std::size_t most_smooths = 3;
// causes; compared in one round; chosen; none
inline constexpr int most_named = 4;
// nats; by which a cause may be behind the best smooth and is still refined; chosen; none
inline constexpr double hopeless_name_nats = 400;
// share; of the gain of the terms on a covariate from which a replacing cause is refined; chosen; none
inline constexpr double replacement_share = 0.15;
// nats; evidence of a cause that replaces a smooth; chosen; none
inline constexpr double replacement_nats = 3;
// nats; advantage needed to relocate a place; chosen; none
inline constexpr double relocation_nats = 1;

// select: noise refitted or as stated

// probability; below which a lead is a near miss, worth a refit of the noise; chosen; none
inline constexpr double near_miss_p = 0.5;
// near misses; refitted in one round; chosen; none
inline constexpr std::size_t most_near_misses = 3;
// slow leads; refitted in one round; chosen; none
inline constexpr std::size_t most_slow_leads = 4;
// factor; most by which a gain grows by relocation; measured; none
inline constexpr double relocation_factor = 3;
// factor; most by which relocation multiplies what the refit of the noise recovered; measured; none
inline constexpr double relocation_times = 10;
// deviance; that relocation may gain in any case; chosen; none
inline constexpr double relocation_at_least = 4;
// deviance; that a refit of the noise may gain in any case; chosen; none
inline constexpr double refit_at_least = 4;
// factor; most by which a gain grows by a refit of the noise, at most 1.7 as far as observed; measured; none
inline constexpr double refit_factor = 3;
// nats; advantage of the fit from a shorter and weaker field; chosen; none
inline constexpr double second_start_nats = 0.3;
// deviance; that a rung of the ladder may lose; chosen; none
inline constexpr double ladder_loss = 60;
// deviance; that a lead of the ladder must gain; chosen; none
inline constexpr double ladder_gain = 4;
// nats; half the 99 % quantile of chi-square with two degrees of freedom; derived;
// Search.AStatedFieldRevealsAnOffsetThatAFittedOneAbsorbs
inline constexpr double stated_field_nats = 4.6;
// leads; tested beside the stated field in one round; chosen; none
inline constexpr std::size_t most_stated_leads = 3;

// select: alternatives

// D; below which causes are inseparable; chosen; Alternatives.AreLeftOpenUnlessTheLikelihoodFavoursTheFinding
inline constexpr double inseparable = 12;
// D; from which causes are decided; chosen; none
inline constexpr double decided = 25;
// nats; by which an alternative may be behind; derived; Alternatives.AreLeftOpenUnlessTheLikelihoodFavoursTheFinding
inline constexpr double open_nats = 3;
// nats; by which an alternative may be behind and is refined; chosen; none
inline constexpr double worth_refining_nats = 15;
// rows of the world; of the same cause, as alternatives; chosen; none
inline constexpr std::size_t most_other_rows = 3;

// select: backward elimination

// nats; of evidence beside the others, below which a term is dropped; chosen; Search.TwoCausesAreBothNamed
inline constexpr double keep_term_nats = 1;
// nats; by which an alternative is clearly better; chosen; BackwardElimination.ReplacesACauseByABetterAlternative
inline constexpr double clearly_nats = 1;
// nats; by which an alternative may be behind and is tried; chosen;
// BackwardElimination.ReplacesACauseByASimplerInseparableOne
inline constexpr double nearly_nats = 5;
// D; below which two causes have the same effect; chosen;
// BackwardElimination.KeepsTheSimplerCauseAgainstATwinWithASmallerGrid
inline constexpr double same_effect_separability = 0.5;
// share; of the gain of a stronger term on the covariate, below which a term is its artefact; chosen; none
inline constexpr double artefact_share_of_kin = 0.05;
// share; the same of a place; chosen; none
inline constexpr double artefact_place_share_of_kin = 0.25;
// deviance; from which a place is no artefact of a term on its covariate; chosen; none
inline constexpr double artefact_place_gain = 30;
// share; of the smooths' joint gain, below which a cause is their artefact; chosen; none
inline constexpr double artefact_share_of_smooths = 0.08;
// share; of the strongest gain, below which a cause is an artefact; chosen; none
inline constexpr double artefact_share_of_strongest = 0.01;
// deviance; from which a cause is no artefact of the strongest; chosen; none
inline constexpr double artefact_gain = 50;
// deviance; below which a place or a smooth beside a clip is its artefact; chosen;
// BackwardElimination.RequiresMoreGainOfAWallThanOfADriftBesideClipping
inline constexpr double artefact_gain_beside_clip = 60;
// draws; of the model's own errors, on which gains are calibrated; chosen; none
inline constexpr Eigen::Index model_draws = 16;
// log; of a field's size or distance, within which its draws are kept; chosen; none
inline constexpr double same_field = 0.2;
// count; atoms of one candidate that are enough to know its highest gain in draws; chosen; none
inline constexpr std::size_t drawn_atoms = 1000;
// draws; of the model, whose distance from what it states is compared with the data's; chosen; none
inline constexpr Eigen::Index compared_draws = 6;
// squared units; of one reading, below which nothing but rounding blurs a field; chosen;
// ResemblesDraws.DataThatNothingBlursDo
inline constexpr double unblurred_variance = 0.1;
// count; atoms of one candidate that are enough to know the bulk; chosen; none
inline constexpr std::size_t bulk_atoms = 200;
// atoms; fewest that are a bulk; chosen; none
inline constexpr Eigen::Index fewest_bulk_atoms = 20;
// atoms; fewest of them that are independent of each other: those of four groups are 1 to 4; measured;
// BulkInflation.IsNotOfAFewThatHaveEffects
inline constexpr double fewest_independent_atoms = 6;
// draws; of white noise, all of whose medians an inflated one exceeds; chosen; BulkInflation.IsOneInWhiteNoise
inline constexpr Eigen::Index bulk_nulls = 40;
// share; of a name's rows that a smooth of its covariate concerns, above which it is withdrawn; chosen;
// BackwardElimination.ANameThatIsWithdrawnDoesNotWithdrawTheNext
inline constexpr double same_rows_share = 0.5;
// factor; by which a cause of the same effect and as many parameters needs less strength to be preferred; chosen; none
inline constexpr double weaker_strength = 1.5;
// probability; of structure left along a name's covariate, below which the name is withdrawn; chosen; none
inline constexpr double left_alpha = 0.01;
// share; of a name's gain left along its covariate, above which the name is withdrawn; chosen; none
inline constexpr double left_share = 0.5;

// noise

// m, or the unit of places; within which two rows are of one site, a sixth of a wavelength at 2.4 GHz; chosen;
// FixedShare.IsOfOneSite
inline constexpr double same_site = 0.02;
// steps; of a fit, from which its fixed share is fitted too; chosen; none
inline constexpr int steps_over_shares = 6;
// nats; behind the best family from which one with a fixed share is not fitted again; chosen; none
inline constexpr double hopeless_family_nats = 50;
// share; of rows whose site has others, above which a share fixed at sites is fitted; chosen; none
inline constexpr double recurring_share = 0.1;
// moments; of a series, from which errors may be correlated over time; chosen; none
inline constexpr double fewest_moments = 8;
// nats; by which errors over time must be likelier than those over places; chosen;
// OverTime.IsChosenWhereEachSiteWanders
inline constexpr double over_time_nats = 5;

// assess

// readings; fewest of a search; chosen; none
inline constexpr Eigen::Index fewest_readings = 50;
// decorrelation distances; side of a block; chosen;
// Folds.BlocksAreThreeDecorrelationDistancesWideAndCoverAllReadings
inline constexpr double block_side = 3;
// blocks; fewest over which an interval may refute a term; chosen; none
inline constexpr int fewest_refuting_blocks = 5;
// share; of rows that recur at a site, from which a network stands; chosen;
// StandingSites.ACauseOfMoreNumbersThanTheyLeaveIsNotNamed
inline constexpr double standing_share = 0.9;
// share; of a term's squares in one left-out part, from which the others say nothing of it; chosen;
// Refutation.SparesWhatOneBlockAloneKnows
inline constexpr double most_in_one_part = 0.9;
// share; growth of the squared error at left-out places by which a term is refuted, whatever its interval; chosen; none
inline constexpr double refuting_growth = 0.25;
// share; the same for a term of this gain, which few blocks refute only where its predictions are wild; chosen;
// Refutation.RefutesWhatOneGroupLeftOutMakesWild
inline constexpr double refuting_growth_of_sure = 3;
// lambda; from which a term is that sure; chosen; none
inline constexpr double sure_of_growth = 200;
// share; of its gain that a term keeps on rows left out, given their neighbours, where it is not refuted by the plain
// error there; chosen; Refutation.SparesASmallOffsetThatNeighboursShow
inline constexpr double borne_out_share = 0.5;
// readings; a stay on average, from which what happens in time is held against how stays differ; chosen;
// Stays.DecideWhatHappensBetweenThem
inline constexpr double readings_a_stay = 5;
// share; of the readings that lie in stays, below which how stays differ decides nothing; chosen;
// Stays.AreNotOnTheWay
inline constexpr double share_in_stays = 0.9;
// share; of the variance of columns in time within stays, up to which they differ between stays alone; chosen; none
inline constexpr double within_stays = 0.3;
// cells; effective number below which the sandwich variance is not used; chosen; none
inline constexpr double fewest_cells = 10;
// deviance; behind the best within which the middle of a posterior may lie; derived;
// ParameterUncertainty.MiddleExplainsAsMuchAsTheBestFit
inline constexpr double middle_deviance = 4;
// factor; highest temperature of a walk over a posterior; chosen; none
inline constexpr double max_temperature = 3;
// nats; spared by the temperature beyond the price of the search; chosen; none
inline constexpr double spared_nats = 4;
// draws; effective sample size at which sampling ends; chosen; none
inline constexpr double enough_effective = 100;

}  // namespace muster::inference::thresholds
