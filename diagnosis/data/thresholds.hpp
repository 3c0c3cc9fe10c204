// Thresholds of measured tables: marks, clocks and units.
//
// Above each constant: unit; meaning; origin; the test that fails if it is badly changed, as in
// diagnosis/inference/thresholds.hpp.
#pragma once

#include <cstddef>

namespace muster::diagnosis::thresholds {

// levels

// dB; between a mark for nothing and every other level, as readings lie closer to one another; chosen;
// DatasetFaults.ALevelAmongOthersIsNoMark
inline constexpr double mark_apart = 10;
// dB; that part outliers from all others, exceeded in one Rayleigh record of a thousand; derived;
// ReceiverChecks.AnIsolatedReadingIsReportedWithItsRow
inline constexpr double outlier_gap = 30;
// readings; that may be outliers together; chosen; ReceiverChecks.AnIsolatedReadingIsReportedWithItsRow
inline constexpr std::size_t most_outliers = 3;
// of the heard readings; of fewer, one far above the others is near a radio; chosen;
// DatasetFaults.FewLevelsFarAboveAllOthersAreTold
inline constexpr double lone_share = 0.01;
// dBm; above which no level is read, a watt at the receiver; chosen; DatasetFaults.LevelsThatNoReceiverGives
inline constexpr double strongest_level = 30;
// dBm; below which no level is read, thermal noise in 1 Hz; derived; DatasetFaults.LevelsThatNoReceiverGives
inline constexpr double weakest_level = -174;

// further columns

// readings; of a sender, from which a column is seen to count them; chosen; none
inline constexpr std::size_t fewest_counted = 20;
// counts; by which a counter rises from reading to reading, lost ones included; chosen; ColumnDoubts.CountersGoWithTime
inline constexpr double largest_count = 20;
// share; of readings that a counter counts, but for what is garbled; chosen; ColumnDoubts.CountersGoWithTime
inline constexpr double counted_share = 0.97;
// squared correlation; with time, from which a column that is called a clock is one; chosen;
// ColumnDoubts.WhatOnlyTendsWithTimeIsNoClock
inline constexpr double steady_rise = 0.9995;

// powers

// powers; that a radio may be set to, beyond which its column is another quantity; chosen; none
inline constexpr std::size_t most_powers = 32;
// dB; between the lowest and the highest: amplifiers are off by less; chosen; SentPower.SmallStepsMayBeErrors
inline constexpr double least_span_of_powers = 6;
// readings; for each power; chosen; none
inline constexpr long readings_a_power = 10;
// share; of the readings that may be lost up to the distance to which levels are compared; chosen;
// SentPower.IsLookedForWhereHardlyAnyReadingIsLost
inline constexpr double lost_of_powers = 0.05;
// share; of the span by which levels may be off the powers, root of the mean square; chosen;
// SentPower.ErrorsOfPowersAreNoPowers
inline constexpr double off_the_power = 0.12;

// clocks

// stamps; fewest of which one may be wild; chosen; none
inline constexpr std::size_t fewest_stamps = 50;
// stamps; of which one may be wild, beyond the first; chosen; Clock.SessionsAreNotWild
inline constexpr std::size_t stamps_of_wild = 1000;
// s; least distance of a wild stamp from all others; chosen; none
inline constexpr double wild_distance = 3600;
// ranges; of the middle nine tenths of stamps, least distance of a wild one; chosen; Clock.SessionsAreNotWild
inline constexpr double wild_ranges = 100;
// s; shortest pause that grids over time skip; chosen; RecordedTime.KeepsEvenStepsAndShortBreaks
inline constexpr double shortest_pause = 600;
// steps; between times, fewest that show a pause; chosen; none
inline constexpr std::size_t fewest_steps = 10;
// steps; of about one length, from snapshot to snapshot, fewest that are no pauses; chosen;
// RecordedTime.AScheduleOfSnapshotsHasNoPauses
inline constexpr std::size_t fewest_snapshots = 10;
// factor; by which steps of a schedule differ at most; chosen; RecordedTime.AScheduleOfSnapshotsHasNoPauses
inline constexpr double regular_steps = 2;
// share; of the recorded time that all pauses take together in grids; chosen; RecordedTime.ShortensAPauseOfAYear
inline constexpr double share_of_pauses = 0.1;

// places

// factor; beyond a radio's usual coordinate from which it may be in millimetres; chosen; DatasetFaults.MixedUnits
inline constexpr double other_unit = 200;
// factor; without coordinates between, so that the radio did not go there; chosen;
// DatasetFaults.FarPlacesOfOneUnitAreTaken
inline constexpr double unit_gap = 50;
// diagonals; of the plan of all walls, beyond which places are of another site; chosen; DataDoubts.AnotherSite
inline constexpr double plans_beside = 10;
// m; beside the plan, beyond which places may be degrees; chosen; DataDoubts.Degrees
inline constexpr double degrees_beside = 5;
// m; extent below which many places may be degrees, 0.1 degrees of which are 11 km; chosen; DataDoubts.Degrees
inline constexpr double degrees_extent = 1;
// places; of one radio, fewest that may be degrees; chosen; DataDoubts.Degrees
inline constexpr std::size_t degrees_places = 10;
// m; above all walls, beyond which a height may be in millimetres; chosen; DataDoubts.Heights
inline constexpr double height_above = 100;
// readings; fewest that may be in Bel; chosen; DataDoubts.Bel
inline constexpr std::size_t bel_readings = 50;
// dBm; within which levels may be Bel; chosen; DataDoubts.Bel
inline constexpr double bel_level = 13;
// factor; between the longest distance and the shortest (from 1 m), above which distance alone makes 12 dB; derived;
// DataDoubts.Bel
inline constexpr double bel_distances = 4;
// m; longest of all distances below which they may be in kilometres; chosen; DatasetFaults.DistancesThatTellNothing
inline constexpr double shortest_range = 0.1;

}  // namespace muster::diagnosis::thresholds
