// Thresholds and tuning constants of radio: links, laws, causes, calibration and pipeline. Grid sizes, iteration counts
// and rounding floors stay where they are used.
//
// Above each constant: unit; meaning; origin; the test that fails if it is badly changed. Origins: derived from theory,
// measured on worlds of known truth, or chosen. docs/reference/thresholds.md is made of this by scripts/thresholds.
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace muster::diagnosis::thresholds {

// standard errors; half of a 95 % interval of a normal variable; derived;
// CauseEstimate.IntervalOfAParameterSoughtByItsLogarithmIsAFactor
inline constexpr double normal95 = 1.96;

// links: rows

// s; time after which a row ends; chosen; none
inline constexpr double row_time = 1.2;
// rad; turn of a radio at which a row ends, 35 degrees; chosen; LinkRows.EndWhereEitherRadioTurns
inline constexpr double row_turn = 0.6109;
// m; way of either end at which a row ends; chosen; none
inline constexpr double row_way = 1.0;
// ln dB^2; variance of the most exact readings, and of the least field in them, 0.08 dB; chosen;
// SimulatedDraws.ExactReadingsAreNotTakenForNoise
inline constexpr double log_exact_variance = -5;
// dB; change of the expected level at which a row ends; chosen; LinkRows.EndWhereAWallChangesTheLevel
inline constexpr double row_level = 1.5;
// share; of readings that are lost for no floor that is known, and more where less is expected, from which no cause is
// sure; chosen; none
inline constexpr double biased_share = 0.2;
// m; by which a radio must climb for what follows heights to be seen; chosen; none
inline constexpr double least_climb = 0.3;
// m; within which a transmitter is heard at one place; chosen; none
inline constexpr double one_receiver_place = 0.1;
// readings; most of a usual row where none has a time; chosen; LinkRowLimits.KeepReadingsWithoutATimeApart
inline constexpr double untimed_row = 8;
// rows; up to which rows are shorter than usual; chosen; LinkRowLimits.AreAsShortAsTheNumberOfRowsAllows
inline constexpr Eigen::Index short_rows = 4000;
// rows; beyond which rows are longer than usual; chosen; LinkRowLimits.AreAsShortAsTheNumberOfRowsAllows
inline constexpr Eigen::Index usual_rows = 10000;

// s; between two readings that are twins, at most; chosen; none
inline constexpr double twins_apart = 0.02;
// steps; of twins, from which their scatter may be seen to be shared; chosen; TwinReadings.NeedMoreThanAFew
inline constexpr double fewest_twins = 30;
// factor; variance of half the difference of twins over that of their mean, up to which they share their scatter;
// chosen; TwinReadings.AreNoneWhereTheyScatterApart
inline constexpr double twins_differ = 0.25;
// dB; least standard deviation of half the difference of twins; chosen; none
inline constexpr double least_difference = 0.05;

// links: receiver

// readings; of a pile at the last code; chosen; ReceiverChecks.ASmallPileIsComparedWithAllLevelsNearIt
inline constexpr std::size_t fewest_piled = 15;
// factor; readings of a pile, relative to the code beside it; chosen; none
inline constexpr std::size_t piled_times = 2;
// probability; of a pile by chance; chosen; ReceiverChecks.ASmallPileIsComparedWithAllLevelsNearIt
inline constexpr double pile_alpha = 1e-6;
// codes; fewest that show a step; chosen; none
inline constexpr std::size_t fewest_codes = 3;
// readings; of each code, on average, that show a step; chosen; ReceiverChecks.NoStepFromTooFewReadings
inline constexpr std::size_t readings_of_code = 4;

// draws; of the world, none of which may pile up as strongly as readings do (p = 1/40); derived; none
inline constexpr uint64_t pile_draws = 39;
// dB; of a field whose extremes gather readings at one level; chosen; none
inline constexpr double field_of_extremes = 1;
// links; that see one extreme of the field at one level no more; chosen; ReceiverChecks.APileInATroughIsOfOnePlace
inline constexpr std::size_t links_beyond_an_extreme = 4;

// links: geometry

// m; extent of a radio's places from which it moves; chosen; none
inline constexpr double moving_extent = 0.5;
// places; of a radio that stands nevertheless; chosen;
// MeasurementGeometry.TakesARadioThatIsSetUpAFewTimesForOneThatStands
inline constexpr std::size_t most_set_ups = 4;
// share; of the links, that may be too few for a law of all readings; chosen;
// Survey.OutliersOfAFewLinksAreInDoubt
inline constexpr double few_links = 0.25;
// share; of the readings that need a law, that those links have then; chosen; none
inline constexpr double most_of_few_links = 0.5;
// factor; of the median step between readings of one link at one place, beyond which a step ends a stay; chosen;
// Stays.EndAtAPause
inline constexpr double pause_between_stays = 30;
// parts; of the readings, in order of time, that cross-validation of names in time leaves out; chosen; none
inline constexpr std::size_t parts_of_time = 10;
// links; from which a pile of readings of one of them is no end of a receiver's range; chosen;
// ReceiverChecks.APileOfOneLinkIsNoEnd
inline constexpr std::size_t many_links = 6;
// m; extent of the places of one link's readings at a level, below which they are one place's and no end of a
// receiver's range; chosen; ReceiverChecks.APileAtOnePlaceIsNoEnd
inline constexpr double one_place = 1;
// nats; by which an unstated field must be likelier than none; chosen; Fault25.ADiagnosisNamesNothingThatItCannotTell
inline constexpr double seen_field_nats = 6;
// dB; of a field that the world does not state, above which it is not adequate; chosen; none
inline constexpr double unstated_shadowing = 1;
// runs; of the world, whose readings are asked for such a field; chosen; none
inline constexpr int runs_for_a_field = 3;
// share; of the field found that these may have for it to be the world's own; chosen;
// SimulatedDraws.MultipathOfTheWorldIsNoUnstatedField
inline constexpr double drawn_field_share = 0.6;
// runs; of the world, whose scatter is compared with that of readings, until one is like it; chosen; none
inline constexpr int runs_of_scatter = 60;
// factor; beyond the range of these runs, from which readings scatter otherwise; chosen;
// OwnDraws.ScatterAsTheWorldSays
inline constexpr double other_scatter = 1.2;
// standard errors; of one more draw, by which single readings must scatter otherwise (p < 1e-4 of 11 degrees of
// freedom); derived; OwnDraws.SingleReadingsScatterAsTheWorldSays
inline constexpr double other_single_t = 6;
// dB; of the world's own draws, from which it says how readings scatter; chosen; none
inline constexpr double least_stated_scatter = 0.5;
// gaps; the longest ones that are pauses of a run, not its sampling; chosen;
// MeasurementGeometry.KnowsAScheduleOfSnapshots
inline constexpr std::size_t longest_pauses = 3;
// rad; range of headings from which a radio turns; chosen; none
inline constexpr double turning_range = 0.2;
// m; between two places of a radio that count; chosen; none
inline constexpr double least_step = 0.2;
// rad; between two headings of a radio that count; chosen; none
inline constexpr double least_turn = 0.2;
// share; of a radio's readings, of those that it sends and of those that it receives, from which it does both; chosen;
// CauseRows.SendingIsToldFromReceivingWhereARadioDoesBoth
inline constexpr double both_ends_share = 0.05;
// m; mean extent of an area, from which what stands in it is sought larger in proportion; chosen;
// Outdoors.AWallIsFoundThatIsTenTimesAsLong
inline constexpr double extent_of_a_building = 60;
// ln m; prior standard deviation of the decorrelation distance outdoors, where it is 2 m among trees and 500 m between
// suburbs (Gudmundson 1991); chosen; Outdoors.ALongFieldIsNoCause
inline constexpr double outdoor_decorrelation_spread = 1.4;
// share; of the area's mean extent, the longest decorrelation distance outdoors; chosen; Outdoors.ALongFieldIsNoCause
inline constexpr double longest_decorrelation_share = 0.1;
// m; smallest radius of a hill or a wood, which can be driven through; chosen;
// Outdoors.AWoodIsFoundThatWasDrivenThrough
inline constexpr double smallest_wood = 2;
// share; of that radius, within which no radio stands; chosen; none
inline constexpr double well_inside = 0.9;
// m; beyond which a step is no way that was driven; chosen; none
inline constexpr double longest_step = 2;
// m; range of heights from which these vary; chosen; none
inline constexpr double least_heights = 0.3;
// places; of moving radios, one of which lies in a room that was visited; chosen; none
inline constexpr std::size_t places_of_visit = 50;
// m; least width of a hall, of which things may fill a corner, beside that of other rooms; chosen;
// Hall.ACornerOfItMayBeCluttered
inline constexpr double widest_room = 10;
// m; widest gap between two walls in one line that may be a doorway, whose door the plan leaves out; chosen;
// RoomDetection.AGapInALineOfWallsIsADoorway
inline constexpr double widest_doorway = 3;
// cosine; of the angle by which two walls in one line may differ, 6 degrees; chosen; none
inline constexpr double in_one_line = 0.995;
// m; narrowest strip between two walls; chosen; none
inline constexpr double narrowest_strip = 1;
// m; widest strip between two walls; chosen; none
inline constexpr double widest_strip = 5;
// m; shortest strip between two walls; chosen; none
inline constexpr double shortest_strip = 5;

// calibration

// probability; of a false alarm over all structure tests; chosen; FalseAlarms.NothingShared
inline constexpr double scan_alpha = 0.05;
// names; of a factor or walls, at most, that a structure test takes; chosen; none
inline constexpr std::size_t most_names = 24;
// readings; that cross a tested wall, and that do not; chosen; none
inline constexpr double fewest_crossings = 30;
// share; of readings by which more are missing at the weakest levels; chosen;
// MissingData.ALossThatRisesGentlyIsNoFloorAndNotChance
inline constexpr double rising_share = 0.15;
// standard errors; of that rise; chosen; none
inline constexpr double rising_errors = 5;
// share; more that is lost at a level than at the highest, where single readings are not tested for their law; chosen;
// OwnDraws.NothingIsWrongWhereAFloorSetsInOverSomeDecibels
inline constexpr double biased_bin = 0.05;
// standard deviations; by which a shadow that the model does not know may be deeper than one it knows; chosen;
// Survey.LossesBelowTheStatedFloorAreNoOtherFloor
inline constexpr double deep_shadow = 4;
// m; way of both ends, within which readings of a link tell why one beside them was lost; chosen;
// LostAmidHeard.IsNoBound
inline constexpr double beside_a_loss = 2;
// readings; nearest to it, all of which but one must be heard; chosen; LostAmidHeard.IsNoBound
inline constexpr std::size_t neighbours_of_a_loss = 6;
// standard deviations; above a floor, where nothing is lost for its level; chosen; LostAmidHeard.NearTheFloorIsABound
inline constexpr double far_above_floor = 3;
// readings; of a silence of all links that would be heard, to take it for no matter of levels; chosen;
// LostAmidHeard.SilencesOfAllLinksAreNoBounds
inline constexpr std::size_t fewest_of_a_silence = 3;
// log share; of readings that a receiver reads below its floor, as outliers; chosen;
// MissingData.NoFloorIsAboveAReadingThatWasReceived
inline constexpr double log_share_below_a_floor = -7;
// deviance; of a floor, p < 0.002, to take losses for censored; chosen; MissingData.AFloorInTheTailTakesFew
inline constexpr double censored_evidence = 10;
// share; of losses that the floor explains, to take them for censored; chosen;
// MissingData.AFloorBesideMuchRandomLossCutsLevelsOff
inline constexpr double censored_share = 0.5;
// cells; with readings near a floor, as many as tell how these scatter; chosen; none
inline constexpr std::size_t independent_near = 10;
// dB; above a floor, where readings must be as many as expected; chosen; none
inline constexpr double above_floor = 3;
// dB; of the weakest reading above the world's own floor, to take the readings for those that it leaves; chosen;
// StatedFloor.ADefaultHoldsWhereReadingsAreLostBelowIt
inline constexpr double reaches_a_floor = 1;
// share; of the readings that a floor gathers closely above it, which there must be; chosen;
// Truncation.OfMeansThatAreTooLowIsNotAbrupt
inline constexpr double near_a_floor = 0.7;
// deviance; of a floor that cuts levels off; derived; MissingData.AFloorInTheTailTakesFew
inline constexpr double cut_off_evidence = 4;
// probability; of no reading below a floor that cuts levels off; chosen; none
inline constexpr double cut_off_alpha = 2e-5;
// readings; weight of the mean variance in that of a cluster; chosen; none
inline constexpr double white_prior = 20;
// m; prior median of the decorrelation distance of a fit's errors; chosen; none
inline constexpr double error_decorrelation = 1.8;
// ln m; prior standard deviation of that distance; chosen; none
inline constexpr double error_decorrelation_spread = 0.7;
// probability; below which an error model is left out; chosen; none
inline constexpr double least_belief = 1e-3;
// clusters; of readings, whose covariance is inverted some hundred times; chosen; none
inline constexpr std::size_t most_clusters = 140;

// causes

// places; of both ends, below which no carrier is sought, but that of the world held; chosen;
// Survey.OutliersInANetworkThatStands
inline constexpr std::size_t fewest_carrier_places = 50;
// m; within which two of these are one; chosen; none
inline constexpr double carrier_place = 0.1;
// factor; by which residuals exceed the simulated scatter for the map's own parameters to be used; chosen;
// SealedSwap.IsNamedThoughItBendsAllParameters
inline constexpr double much_more = 1.5;
// readings; of a row, from which columns are sketched; chosen; none
inline constexpr Eigen::Index worth_sketching = 2;
// readings; from which columns near a place are computed apart; chosen; none
inline constexpr Eigen::Index worth_localising = 4000;
// m; beyond the map within which a radio is sought, times the plan's scale; chosen; none
inline constexpr double beyond_map = 10;
// m; standard deviation of a radio's place about the map's, times the plan's scale;
// chosen; none
inline constexpr double misplaced_spread = 3;
// share; of misplaced radios, of those that stand anywhere in the area and not near the map's place; chosen;
// Candidates.ARadioMayStandFarFromItsMappedPlace
inline constexpr double blunder_share = 0.1;
// places; far from the map's, of all radios together, from which a search begins; chosen;
// Candidates.ARadioMayStandFarFromItsMappedPlace
inline constexpr double far_places = 400;
// m; within which a radio stands where the map has it; chosen;
// Candidates.MisplacementsBelowATenthOfAMetreAreExcluded
inline constexpr double same_place = 0.1;
// nats; charge of refinement of a wall; measured; none
inline constexpr double wall_charge = 8.3;
// nats; charge of refinement of a thing; measured; none
inline constexpr double thing_charge = 7.0;
// nats; more of a thing outdoors, whose radius is sought over ten times the range; chosen;
// RadioField.IsAsOtherEvidenceSaysAndClaimsNothingThatHeldOutDataRefute
inline constexpr double outdoor_charge = 2;
// nats; charge of refinement of a room or strip of the plan; measured; none
inline constexpr double given_place_charge = 0.5;
// nats; charge of refinement of any other place; measured; none
inline constexpr double place_charge = 4;
// nats; charge of refinement without a place; measured; none
inline constexpr double shape_charge = 1;
// share; of its gain that a thing keeps where a radio was driven through it; chosen; none
inline constexpr double driven_through_share = 0.3;
// share; of its gain that a wall keeps for each time that it was driven across; chosen; none
inline constexpr double driven_across_share = 0.8;
// rad; standard deviation of a wall's direction about those of the plan; chosen; none
inline constexpr double wall_slant = 0.2;
// share; of the best gain from which the scan of a segment's gap starts anew; chosen; none
inline constexpr double segment_worth = 0.5;
// share; of the best gain from which the scan looks about a disk; chosen; none
inline constexpr double disk_worth = 0.5;

// laws: all

// nats; from which a reading needs a law that adds draws; chosen; none
inline constexpr double needs_law = 1;
// probability; of as many pairs of successive readings that need it by chance; chosen;
// Survey.ReadingsThatAreOffInRunsAreNoOutliers
inline constexpr double pairs_alpha = 1e-4;
// factor; of pairs by chance, beyond which readings that need a law come in runs; chosen;
// Survey.ReadingsThatAreOffInRunsAreNoOutliers
inline constexpr double pairs_of_runs = 4;
// share; of the largest lambda that is left unexplained, below which a law of single readings is not named beside it;
// chosen; LawDoubts.WhatIsNotExplainedScattersReadings
inline constexpr double law_beside_unexplained = 0.25;
// share; of the readings that need a law, beyond which pairs of them must be more than chance has; chosen;
// Survey.ReadingsThatAreOffInRunsAreNoOutliers
inline constexpr double pairs_of_need = 0.1;
// share; of readings of a link that need a law and are called alike; chosen; none
inline constexpr double alike_share = 0.25;
// factor; of that share, beyond which pairs of successive readings are what lasts; chosen;
// Survey.ReadingsThatAreOffInRunsAreNoOutliers
inline constexpr double lasting = 3;
// m; within which two readings of a link are of one place; chosen; none
inline constexpr double repeats_within = 1e-3;
// readings; of one link and place, whose median tells the level there; chosen; none
inline constexpr std::size_t repeats_that_tell = 5;
// share; of readings that repeat a place where a network stands; chosen; Survey.OutliersInANetworkThatStands
inline constexpr double repeated_share = 0.9;
// probability; of a false fading law or blockage in a clean world; chosen; CleanCase.IsSilent
inline constexpr double law_alpha = 0.0005;
// readings; beside a pair, whose mean tells the field there; chosen; ScatterByLevel.IsToldByTheLevelThatTheFieldMakes
inline constexpr double readings_beside_a_pair = 3;
// probability; of a dependence of scatter on level where there is none; chosen;
// ScatterByLevel.IsToldWhereAReceiverCompresses
inline constexpr double scatter_alpha = 1e-4;
// probability; of such a dependence, below which a law of fading is in doubt; chosen; none
inline constexpr double doubtful_scatter_alpha = 0.01;
// probability; of a false field in a clean world; chosen; SealedField.OfASmoothFamilyIsNotTakenForTheStatedOne
inline constexpr double field_alpha = 0.002;
// nats; log p required of blockage beside other misfits; chosen; none
inline constexpr double blockage_in_company = -9;
// lambda; of blockage that keeps its name beside a cause of more evidence; chosen;
// RadioField.IsAsOtherEvidenceSaysAndClaimsNothingThatHeldOutDataRefute
inline constexpr double sure_blockage = 30;
// dB; within which readings end at the floor that the world states; chosen; none
inline constexpr double near_stated_floor = 3;
// times; the scatter of what was heard, by which readings may scatter if all losses lie below that floor; chosen;
// RealData.RowsOfShelvesAreFoundAsWalls
inline constexpr double wider_beside_floor = 2;
// dB; within which a stage of the world already clips there; chosen; none
inline constexpr double same_clip = 0.5;
// share; of the evidence of losses that counts unless they are censored; chosen; none
inline constexpr double joint_loss = 0.5;
// standard deviations; about a clip whose readings are not tested; chosen; SealedPeople.AreSoughtApartFromWhatIsClipped
inline constexpr double near_clip = 2;
// readings; no bounds, for tests of single readings; chosen; none
inline constexpr Eigen::Index fewest_law_readings = 300;
// nats; by which another law may be behind and is an alternative; chosen; none
inline constexpr double open_law_nats = 3;
// draws; of a world without a law of readings, which are asked for a law that was found; chosen;
// SimulatedDraws.ExactReadingsHaveNoOutliersOfTheirOwn
inline constexpr uint64_t law_draws = 19;
// factor; by which the evidence of a law, or of a floor that a log ends at, must exceed that in each draw; chosen;
// SimulatedDraws.AFieldThatEndsIsNoFloor
inline constexpr double beyond_drawn = 1.5;
// times; the deviation of all readings about the fitted world, beyond which a field is none that they show; chosen;
// none
inline constexpr double widest_field = 2;
// draws; of the world, over which a fitted field scatters; chosen; none
inline constexpr int field_draws = 12;
// share; of the ground that a link covers, over which a field that is told is not alike; chosen;
// LawDoubts.AFieldAsLongAsTheGroundIsNone
inline constexpr double field_of_the_ground = 1.0 / 3;
// factor; of the stated distance, up to which a field may be as long as the ground; chosen;
// LawDoubts.AFieldAsLongAsTheGroundIsNone
inline constexpr double much_longer_field = 2;
// probability; of the fitted field among those of the world's draws, below which it is another; chosen; none
inline constexpr double alike_field = 0.01;
// share; of the readings, which the world's receiver must hear of a draw for its field to be compared; chosen; none
inline constexpr double heard_of_a_draw = 0.9;
// lambda; of a law in readings of one direction, for them to tell its numbers; derived; none
inline constexpr double numbers_of_one_direction = 7.7;
// lambda; from which the weaker of a fading law and a field is beyond doubt; chosen; none
inline constexpr double second_law_lambda = 30;
// probability; of a cause or a dependence that is not found, beside which another field is in doubt; chosen;
// LawDoubts.AnotherFieldIsInDoubtBesideWhatItMayHaveAbsorbed
inline constexpr double absorbed_alpha = 1e-3;
// probability; of a cause or a dependence that is not found, beside which a law of single readings is in doubt; chosen;
// LawDoubts.ALawOfScatterIsInDoubtBesideWhatIsPlainlyLeft
inline constexpr double scattered_alpha = 1e-6;
// nats; evidence of another field, below which it is none; chosen; HiddenEffect.IsFoundAtLambda60
inline constexpr double least_field = 4;
// nats; evidence from which another field is plain, whatever the law of distance; chosen;
// LawDoubts.AFieldOfLittleEvidenceMayHaveAnotherLawOfDistance
inline constexpr double plain_field = 20;
// m; from a wall's end within which a reading grazes it, since surveys write centimetres; chosen;
// GrazingLinks.AreNoOutliers
inline constexpr double grazing = 0.005;
// dB; change aside from which a grazing reading is left out, half a unit of RSSI; chosen; GrazingLinks.AreNoOutliers
inline constexpr double grazing_change = 0.5;
// m; by which walls or places may be off: where that decides which walls are crossed, a law that adds draws must gain
// no more than elsewhere; chosen; none
inline constexpr double places_off[] = {0.1, 0.3, 1};
// share; of the readings, of which that is not so, on which it can be seen; chosen; none
inline constexpr double least_clear = 0.3;
// share; of the gain in proportion that it keeps there; chosen; none
inline constexpr double in_proportion = 0.25;

// laws: fading

// m; decorrelation distance below which a field is one of fades, not of what is in the way; chosen; none
inline constexpr double longest_fade = 0.5;
// dB; of such a field, from which its deep places look like readings that are off; chosen; none
inline constexpr double least_fade = 2;
// factor; by which the field must outreach a fade of the world's for single readings to tell of fades; chosen; none
inline constexpr double fades_in_field = 2;
// nats; behind the best shape of the field beyond which a shape is dropped; chosen; none
inline constexpr double unlikely_shape_nats = 6;
// factor; by which gains of a fading law are wider than chi-square; measured; none
inline constexpr double fading_dispersion = 3;
// factor; by which gains of outliers and of hopping are wider than chi-square; measured; none
inline constexpr double other_law_dispersion = 2;
// probability; below which a law may be named and is tested without winsorising; chosen;
// FadingTests.NoFalseAlarmForClippedDeepFades
inline constexpr double may_be_named = 0.01;
// deviance; from which field and law are fitted in turn; chosen; none
inline constexpr double closer_look_gain = 3;
// numbers; of averaged fades that a law is chosen from, as a price; derived; none
inline constexpr double averaged_choices = 5;
// nats; by which adjacent readings may contradict a law; chosen;
// FadingTests.CloseReadingsPreventAnotherLaw
inline constexpr double contradiction_nats = 1.5;
// nats; of a count of such pairs, beyond which it contradicts heavy tails: none where three are expected; chosen;
// FadingTests.OutliersAreFoundUnderRayleighFading
inline constexpr double far_contradiction_nats = 3;
// dB; up to which the distance is sought at which heavy tails show best in adjacent readings; chosen; none
inline constexpr double far_most = 60;
// share; of the standard deviation of what heavy tails draw, by which such pairs differ at least; chosen;
// Survey.TailsOfTheFieldAreNoOutliers
inline constexpr double far_in_tails = 0.7;
// nats; fall of the log-likelihood at the ends of a 95 % interval; derived; FadingTests.MeasuresAnotherFading
inline constexpr double interval_nats = 1.92;
// nats; behind the best shape beyond which a shape of the sample is not fitted to all readings, nor one of the first
// size of the noise to other sizes; chosen;
// FadingTests.ShapesOfASubsetAreRankedByAllReadings
inline constexpr double hopeless_shape_nats = 60;
// readings; from which shapes are fitted to a sample first; chosen; none
inline constexpr Eigen::Index sampled_from = 30000;
// readings; of that sample; chosen; none
inline constexpr Eigen::Index sample_size = 10000;
// readings; for a rough value of the log-likelihood; chosen; none
inline constexpr Eigen::Index rough_readings = 3000;
// m; of both ends jointly, within which readings are side by side; chosen;
// FadingTests.CloseReadingsGiveTheVarianceOfOne
inline constexpr double side_by_side = 0.3;
// pairs; of readings side by side that tell their variance; chosen;
// FadingTests.CloseReadingsGiveTheVarianceOfOne
inline constexpr Eigen::Index fewest_pairs = 100;
// nats; advantage of a parabola over a line in their variogram; chosen;
// FadingTests.CloseReadingsGiveTheVarianceInASmoothField
inline constexpr double parabola_nats = 2;

// laws: shadowing

// factor; by which gains of a field are wider than chi-square, since its family is unknown; chosen;
// ShadowingTest.NoFalseAlarmForTheStatedField
inline constexpr double field_dispersion = 1.5;
// factor; of size and distance within which a field is the stated one; chosen; none
inline constexpr double stated_tolerance = 1.08;

// laws: blockage

// rows; of a link that is tested; chosen; none
inline constexpr std::size_t fewest_link_rows = 40;
// s; prior mean time between blockages; chosen; BlockageTest.DetectsAndMeasuresBursts
inline constexpr double between_blockages = 25;
// standard errors; at which the error of a row is winsorised; chosen;
// BlockageTest.NoFalseAlarmForDeepFadesOfSingleReadings
inline constexpr double winsorised_errors = 2.5;
// scales; prior mean of a misfit's lead, several times that of the flipped scan in clean worlds; measured; none
inline constexpr double usual_misfit = 2;
// factor; by which blockage exceeds the sign-flipped statistic; measured;
// BlockageTest.NoFalseAlarmForNearlySymmetricBursts
inline constexpr double flipped_times = 3;
// passages; of people on a link, fewer of which may be dips of the field; chosen;
// SimulatedDraws.ADipOfTheFieldIsNobodyWhoPasses
inline constexpr std::size_t fewest_passages = 3;
// nats; ratio of the likeliest link below which nobody is told to pass where nothing else was found; chosen;
// SimulatedDraws.ADipOfTheFieldIsNobodyWhoPasses
inline constexpr double blockage_alone = 7;
// nats; ratio below which no shuffled null can be significant; chosen; none
inline constexpr double promising_blockage = 3;
// links; of each of its radios, beside a link that is tested for people who walk about; chosen;
// WalkersTest.WhatARadioSharesIsNoWalker
inline constexpr std::size_t fewest_other_links = 3;
// s; to either side, within which readings are of one moment; chosen; WalkersTest.WhatARadioSharesIsNoWalker
inline constexpr double same_moment = 1;
// s; apart at most, two readings of a link that one crossing may concern; chosen; none
inline constexpr double crossing_reach = 3;
// s; apart at least, two readings that share slow changes alone, and longest crossing; chosen;
// WalkersTest.SlowChangesAreNoWalker
inline constexpr double slow_change = 10;
// standard deviations; at which a reading is cut for the moments of crossings; chosen; none
inline constexpr double farthest_blocked = 8;
// dB; least loss of people who walk about: levels of a network with nobody about swing by less; chosen; none
inline constexpr double least_walker_loss = 2;
// durations of a crossing; to either side, over which a running median is taken; chosen;
// LikelyBlocked.ALastingChangeOfLevelIsNoCrossing
inline constexpr double median_reach = 8;
// standard deviations; half of a normal variable lies within; derived; LikelyBlocked.FindsTheReadingsThatWereBlocked
inline constexpr double normal_quartile = 0.6745;
// dB; least scatter of readings about their median; chosen; none
inline constexpr double least_scatter = 0.3;
// probability; from which a reading of a link that people cross is left out; chosen;
// LikelyBlocked.FindsTheReadingsThatWereBlocked
inline constexpr double probably_blocked = 0.3;

// pipeline

// share; of a parameter's range within which it is at its bound, 0.01 of an exponent; chosen; none
inline constexpr double at_bound = 1e-3;
// cosine squared; from which a strength is the one without effect; chosen; none
inline constexpr double no_effect_alike = 0.9;
// values; of a number that is a setting; chosen; none
inline constexpr std::size_t most_settings = 8;
// share; of readings that a hidden cause of the self-test concerns; chosen; none
inline constexpr double hidden_concern = 0.02;
// probability; by which a declared density may miss an integral of one; chosen; none
inline constexpr double law_mass_error = 1e-3;
// dB; between the mean of a density and the declared one; chosen; none
inline constexpr double law_mean_error = 0.01;
// dB; between what a law, a clip or a burst declares and what the simulator executes; chosen; none
inline constexpr double law_execution_error = 1e-6;
// standard errors; between draws and their declared law, beyond chance even if two readings share a draw; chosen; none
inline constexpr double law_draw_errors = 3;

// dB^2; of single readings by the world's laws, below which it states that they do not scatter; chosen;
// FadingTests.NormalNoiseOfAWorldThatStatesNoneIsNoLaw
inline constexpr double steady_variance = 0.02;
// readings; which may be on the other side of a wall and must not carry a law alone; chosen;
// FadingTests.AFewReadingsMakeNoLawBesideWalls
inline constexpr Eigen::Index law_few = 2;
// share; of a law's gain that these few carry, above which it is not named; chosen; none
inline constexpr double law_few_share = 0.75;

// planning: a second station

// share; of the largest effect, from which it reaches a row; chosen; none
inline constexpr double reached = 0.2;
// m; between places of a radio that stands; chosen; WalkersTest.LinksOfAWalkTakeNoPart
inline constexpr double stands_within = 0.2;
// ratio; of the farthest distance to the nearest one, below which it is known; chosen;
// SecondStation.NothingIsOpenIfTheDistanceIsKnown
inline constexpr double distance_known = 1.5;
// m; from a place to the station that is advised, at least; chosen; SecondStation.ARangeAndAPlaceToTheSideAreTold
inline constexpr double second_station_apart = 2;

// pipeline: worlds of their own

// radios; that stand, by which a plan shows how it is turned: two points do; derived;
// OwnWorld.APlanOfTwoStationsIsTurned
inline constexpr std::size_t fewest_standing = 2;
// m; how far a plan is moved where that is first tried, outdoors as many times as far as its scale; chosen;
// OwnWorldLoop.IsNamedAndTheExtendedWorldIsSilent
inline constexpr double own_world_near_move = 2;
// m; the same, further off; chosen; Outdoors.APlanIsFoundThatIsShiftedByAHundredMetres
inline constexpr double own_world_far_move = 7;
// readings; by which worlds are judged, one at random of each stretch; chosen; none
inline constexpr std::size_t own_world_readings = 2000;
// readings; the same, where those leave open what is likelier; chosen;
// OwnWorld.MoreReadingsAreAskedWhereFewLeaveItOpen
inline constexpr std::size_t own_world_more_readings = 8000;
// readings; fewest by which worlds are judged; chosen; none
inline constexpr std::size_t own_world_fewest = 60;
// dB; largest change of an expected level by a hypothesis that changes nothing; chosen; none
inline constexpr double own_world_change = 1e-6;
// factor; sum of squares, over that of the world as it is, from which a hypothesis is not fitted; chosen; none
inline constexpr double own_world_hopeless = 1.15;
// radios; up to which each may have a level of its own besides; chosen;
// OwnWorld.AFaultOfTheMapIsFoundBesideAWeakStation
inline constexpr std::size_t own_world_levels = 12;
// worlds; fitted by least squares, the best by their declared parameters; chosen; none
inline constexpr std::size_t own_worlds_built = 8;
// share; of the sum of squares of the world as it is, below which noise is fitted; chosen; none
inline constexpr double own_world_share = 0.998;
// worlds; whose noise is fitted, the best by least squares; chosen; none
inline constexpr std::size_t own_worlds_fitted = 4;
// m; by which the point about which a plan is turned, or a move, lies off its start at most, times the scale; chosen;
// none
inline constexpr double own_world_reach = 20;
// nats; between hypotheses of which the simplest is named; chosen; none
inline constexpr double own_world_even = 2;
// share; of the lead over the given world, for the same; chosen; none
inline constexpr double own_world_even_share = 0.03;
// nats; by which another family of the noise may favour a hypothesis over the world as it is; chosen; none
inline constexpr double own_world_other_noise = 20;
// nats; by which a hypothesis must be likelier than what was found in the world as it is; chosen; none
inline constexpr double own_world_beyond_found = 3;
// nats; by which a hypothesis that is not named must lead for more readings to be asked; chosen;
// OwnWorld.MoreReadingsAreAskedWhereFewLeaveItOpen
inline constexpr double own_world_leads = 1;
// nats; by which a hypothesis must be likelier than the world as it is; chosen; OwnWorld.CleanReadingsAreSilent
inline constexpr double own_world_nats = 8;
// factor; error at left-out places, over that beside all that was found in the world as it is, from which a hypothesis
// is not named if that is beyond chance; chosen; none
inline constexpr double own_world_worse = 1.02;
// factor; the same, from which it is not named; chosen; none
inline constexpr double own_world_far_worse = 1.2;
// nats; within which another hypothesis is an alternative; chosen; none
inline constexpr double own_world_open = 3;
// factor; variance of a radio's readings about their level with two identities exchanged, over that beside all that was
// found, up to which the exchange is tried; chosen;
// ExchangedIdentity.StandsForARadioThatIsWhereAnotherShouldBe
inline constexpr double exchange_alike = 1.1;

}  // namespace muster::diagnosis::thresholds
