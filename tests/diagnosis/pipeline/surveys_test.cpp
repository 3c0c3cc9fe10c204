// Surveys as people make them, of the exam's generators, in which something was once told wrongly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>

#include "diagnosis/pipeline/diagnose.hpp"
#include "diagnosis/pipeline/setup.hpp"
#include "tests/diagnosis/pipeline/flat.hpp"

namespace muster::diagnosis {
namespace {

Diagnosis diagnosed(const std::string& options, int number) {
  const Scratch scratch;
  const auto world = made_case(scratch, options, number);
  return diagnose(world, world / "measured.csv", plugins);
}

bool names(const Diagnosis& found, const std::string& id) {
  return std::any_of(found.causes.begin(), found.causes.end(), [&](const CauseEstimate& c) { return c.id == id; });
}

// What a receiver compresses scatters less where it is strong: a law of fading of lambda 89 was named.
TEST(Survey, ScatterThatFallsWithTheLevelIsNoLawOfFading) {
  const Diagnosis found = diagnosed("--generator field --seed 11303", 8);
  EXPECT_FALSE(names(found, "effect.fading_law")) << names_in_words(named_causes(found));
  const auto says = [](const std::string& note) { return note.find("where levels are low and by") != note.npos; };
  EXPECT_TRUE(std::any_of(found.notes.begin(), found.notes.end(), says));
}

// A steep field in exact readings: outliers of lambda 316 were named.
TEST(Survey, TailsOfTheFieldAreNoOutliers) {
  const Diagnosis found = diagnosed("--generator run --seed 99503 --mix clean", 5);
  EXPECT_STREQ(found.verdict(), "adequate") << names_in_words(named_causes(found));
}

// The mirrored plan had to be likelier alone than a sender's change that is true beside it.
TEST(Survey, AMirroredPlanIsFoundBesideAnotherCause) {
  const Diagnosis found = diagnosed("--generator field --seed 11301", 4);
  EXPECT_TRUE(names(found, "effect.plan_turned")) << names_in_words(named_causes(found));
  EXPECT_EQ(found.causes.size(), 2u);
}

// Only the data name the masts: the corrected world had another order of them, and its error did not fall.
TEST(Survey, AShiftAmongRadiosOfTheDataIsCorrected) {
  const Diagnosis found = diagnosed("--generator field --seed 11301", 1);
  ASSERT_EQ(found.causes.size(), 1u) << names_in_words(named_causes(found));
  EXPECT_EQ(found.causes[0].id, "effect.labels_shifted");
  ASSERT_TRUE(found.unseen);
  EXPECT_LT(found.unseen->after.mean(), 0.6 * found.unseen->before.mean());
}

// A fifth of the readings is missing and the table tells of none: something depended on the level, without a name, and
// the exponent came out as 0.7 where it is 2.
TEST(Survey, ATableOfWhatWasHeardEndsAtAFloor) {
  const Diagnosis found = diagnosed("--generator field --seed 91318", 8);
  EXPECT_TRUE(found.unexplained.empty());
  ASSERT_EQ(found.causes.size(), 2u) << names_in_words(named_causes(found));
  EXPECT_TRUE(names(found, "effect.unmapped_wall")) << names_in_words(named_causes(found));
  const auto floor = std::find_if(found.causes.begin(), found.causes.end(),
                                  [](const CauseEstimate& c) { return c.id == "effect.rssi_floor"; });
  ASSERT_NE(floor, found.causes.end());
  EXPECT_EQ(floor->values.at(0).value, -70);
  EXPECT_NEAR(found.parameters.at("radio.multiwall/n"), 2, 0.15);
}

// The weakest of its readings is -70 dBm. A receiver of the world that hears less says nothing, and one that hears less
// well is another one than that of the log: two gateways that read 15 dB low were lost in what was made of it.
TEST(Survey, ReadingsEndAtTheWorldsFloorOnlyIfTheyReachIt) {
  const Scratch scratch;
  const auto folder = made_case(scratch, "--generator field --seed 91318", 8);
  const std::string world = contents(folder / "world.xml");
  const std::string any = "sensitivity=\"-200\"";
  const auto end_with = [&](const std::string& sensitivity) {
    std::string other = world;
    other.replace(other.find(any), any.size(), "sensitivity=\"" + sensitivity + '"');
    std::ofstream(folder / "other.xml") << other;
    return DiagnosisSetup(folder / "other.xml", folder / "measured.csv", plugins).end;
  };
  EXPECT_EQ(end_with("-70"), -70);
  EXPECT_EQ(end_with("-75"), std::nullopt);
  EXPECT_EQ(end_with("-60"), std::nullopt);
}

// The field that was fitted without the thing held the thing: in draws of it gains are several times those of chance,
// and a gain of 117 was not beyond them.
TEST(Survey, AThingIsHeldAgainstTheFieldBesideIt) {
  const std::string causes =  // of which this case is drawn
      "tx_offset,rx_offset,asymmetry,feeder_loss,antenna_tx,antenna_rx,sector_antenna,body_shadow,label_swap,"
      "tx_misplaced,power_steps,labels_shifted,plan_turned,column_shifted,wall_material,wall_absent,unmapped_wall,"
      "obstacle,room_clutter,corridor,height,incidence,multiwall_saturation,dual_slope,two_ray,counted_walls,drift,"
      "step,"
      "periodic,tx_drift,tx_step,tx_periodic,noise_floor_rssi,rssi_saturation,rssi_compression,rssi_floor,people,"
      "outliers,channel_mixture,fading_law,shadowing_correlation";
  const Diagnosis found = diagnosed("--generator run --mix two --lambda 150,300 --seed 92012 --effects " + causes, 34);
  ASSERT_EQ(found.causes.size(), 2u) << names_in_words(named_causes(found));
  EXPECT_TRUE(names(found, "effect.plan_turned"));
  const auto thing = std::find_if(found.causes.begin(), found.causes.end(),
                                  [](const CauseEstimate& c) { return c.id == "effect.obstacle"; });
  ASSERT_NE(thing, found.causes.end());
  for (const CauseValue& v : thing->values) {
    const double truth = v.name == "x" ? 10.653 : v.name == "y" ? 6.936 : v.value;
    EXPECT_NEAR(v.value, truth, 0.5) << v.name;
  }
}

// Loses the weakest readings of a table, so many, and moves all levels so that the weakest that is left lies there,
// dBm; not where that is none. The weakest that is left.
double lose_weakest(const std::filesystem::path& file, std::size_t count, std::optional<double> there = {}) {
  std::vector<std::string> rows;
  std::vector<double> levels;
  std::ifstream drawn(file);
  std::string title;
  std::getline(drawn, title);
  for (std::string line; std::getline(drawn, line);) {
    rows.push_back(line.substr(0, line.rfind(',') + 1));
    const std::string level = line.substr(rows.back().size());
    levels.push_back(level.empty() ? std::nan("") : std::stod(level));
  }
  drawn.close();
  std::vector<double> sorted = levels;
  std::erase_if(sorted, [](double level) { return std::isnan(level); });
  std::sort(sorted.begin(), sorted.end());
  const double least = sorted.at(count), moved = there ? *there - least : 0;
  std::ofstream heard(file);
  heard << title << '\n';
  for (std::size_t k = 0; k < rows.size(); ++k)
    heard << rows[k] << (levels[k] >= least ? print_real(levels[k] + moved) : "") << '\n';
  return least + moved;
}

// The six weakest readings are lost. A receiver that hears anything has a floor, then; of one that hears nothing below
// a level not far off they were lost there, in shadows deeper than expected.
TEST(Survey, LossesBelowTheStatedFloorAreNoOtherFloor) {
  const Scratch scratch;
  const auto world = flat(scratch, 3, "shadowing=\"2\" decorrelation=\"2\" rician_k=\"8\" per_reading=\"true\"");
  const auto file = drawn_by(scratch, world);
  const double floor = lose_weakest(file, 6);
  const std::string given = contents(world);
  const std::string any = "sensitivity=\"-200\"";
  const auto floor_named = [&](const std::string& sensitivity) {
    std::string other = given;
    other.replace(other.find(any), any.size(), "sensitivity=\"" + sensitivity + '"');
    std::ofstream(world) << other;
    return names(diagnose(world, file, plugins), "effect.rssi_floor");
  };
  EXPECT_TRUE(floor_named("-200"));
  EXPECT_FALSE(floor_named(print_real(floor - 6)));
}

// The default of a receiver that the world does not write, -95 dBm, was taken for the world's own floor where readings
// are weaker: one of lambda 1,000 was silent. What the world itself would not have heard is no other floor.
TEST(Survey, ADefaultIsNoFloorOfWeakerReadings) {
  const Scratch scratch;
  const auto world = flat(scratch, 3, "shadowing=\"2\" decorrelation=\"2\" rician_k=\"8\" per_reading=\"true\"");
  const auto file = drawn_by(scratch, world);
  std::string without = contents(world);
  const std::string receiver = "<radio.receiver sensitivity=\"-200\"/>";
  std::ofstream(world) << without.erase(without.find(receiver), receiver.size());
  lose_weakest(file, 150, -95.2);
  EXPECT_EQ(names_in_words(named_causes(diagnose(world, file, plugins))), "effect.rssi_floor all");
  lose_weakest(file, 0, -94.9);
  EXPECT_EQ(names_in_words(named_causes(diagnose(world, file, plugins))), "silent");
}

}  // namespace
}  // namespace muster::diagnosis
