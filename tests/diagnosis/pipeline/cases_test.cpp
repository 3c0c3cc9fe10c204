// One sealed case for each cause, at lambda 150, from muster_exam, whose formulas are independent of the plugins'.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <utility>

#include "diagnosis/pipeline/closed_loop.hpp"
#include "diagnosis/pipeline/diagnose.hpp"
#include "diagnosis/report/advice.hpp"
#include "muster/random.hpp"
#include "tests/diagnosis/pipeline/sealed_case.hpp"
#include "text/text_table.hpp"
#include "text/text_table_writer.hpp"

namespace muster::diagnosis {
namespace {

std::string told(const Diagnosis& d) {
  std::string text;
  for (const CauseEstimate& c : d.causes)
    text += c.id + ' ' + c.label + (c.status == inference::Status::named ? "\n" : " (suspected)\n");
  for (const Unexplained& u : d.unexplained) text += '~' + u.covariate + '\n';
  return text;
}

void expect_only(const char* id, const Diagnosis& found) {
  ASSERT_EQ(found.causes.size(), 1u) << told(found);
  EXPECT_EQ(found.causes[0].id, id);
}

struct Hidden {
  const char* effect;
  int number;
};

class SealedCase : public testing::TestWithParam<Hidden> {};

TEST_P(SealedCase, IsNamedAndTheExtendedWorldIsSilent) {
  const Scratch scratch;
  const auto& [effect, number] = GetParam();
  const auto world = sealed_case(scratch, std::string("--mix one --lambda 150 --effects ") + effect, number);
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  ASSERT_TRUE(found.named()) << told(found);
  EXPECT_EQ(found.causes[0].id, std::string("effect.") + effect);
  EXPECT_STREQ(found.verdict(), "extended") << told(found);
  int named = 0;
  for (const CauseEstimate& c : found.causes) named += c.status == inference::Status::named;
  EXPECT_EQ(named, 1) << told(found);
  const Loop loop = closed_loop(found, world, world / "measured.csv", scratch / "extended", plugins).value();
  EXPECT_LT(loop.mean_difference, 0.1);
  EXPECT_EQ(names_in_words(loop.rediagnosis), "silent");
}

INSTANTIATE_TEST_SUITE_P(Effects, SealedCase,
                         testing::Values(Hidden{"antenna_rx", 1}, Hidden{"step", 2}, Hidden{"dual_slope", 3},
                                         Hidden{"drift", 6}, Hidden{"label_swap", 15}, Hidden{"rssi_saturation", 13},
                                         Hidden{"outliers", 14}, Hidden{"wall_absent", 16}),
                         [](const auto& hidden) { return std::string(hidden.param.effect); });

// The world's law of readings is taken out: fading is in the data and nobody states it.
std::filesystem::path without_law(const std::filesystem::path& world) {
  std::ifstream in(world / "world.xml");
  std::string kept;
  for (std::string line; std::getline(in, line);) {
    if (line.find("<radio.fading") == line.npos) kept += line + '\n';
  }
  in.close();
  std::ofstream(world / "world.xml") << kept;
  return world;
}

TEST(WorldWithoutALaw, OutliersAreNamedAndFadingIsNone) {
  const Scratch scratch;
  const auto off = without_law(sealed_case(scratch, "--mix one --lambda 400 --effects outliers", 1));
  expect_only("effect.outliers", diagnose(off, off / "measured.csv", plugins));
  const auto clean = without_law(made_case(scratch, "--seed 32 --rows 3000 4000 --mix clean", 1));
  const Diagnosis found = diagnose(clean, clean / "measured.csv", plugins);
  EXPECT_TRUE(found.causes.empty()) << told(found);
}

// Two of 14 outliers gave 98 % of the gain of a wall of 17 dB, half of it within four standard errors.
TEST(SealedPair, OutliersAreNoWallBesideAWallOfAnotherMaterial) {
  const Scratch scratch;
  const auto world = made_case(scratch, "--seed 91 --rows 2000 20000", 183);
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  ASSERT_EQ(found.causes.size(), 2u) << told(found);
  EXPECT_EQ(found.causes[0].id, "effect.wall_material");
  EXPECT_EQ(found.causes[1].id, "effect.outliers");
}

// The readings themselves decide against the antenna (D 10, and 11 nats); against an obstacle only the price of its
// place.
TEST(SealedOffset, HasTheAlternativesThatTheReadingsLeaveOpen) {
  const Scratch scratch;
  const auto world = made_case(scratch, "--seed 91 --rows 2000 20000", 13);
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  expect_only("effect.tx_offset", found);
  std::set<std::string> alternatives;
  for (const inference::Alternative& r : found.causes.at(0).alternatives) alternatives.insert(r.id);
  EXPECT_EQ(alternatives.count("effect.antenna_tx"), 0u);
  EXPECT_EQ(alternatives.count("effect.obstacle"), 1u);
}

// A misplaced radio beside another cause: the fit is repeated with the radio in its place. The reported error is
// still that of the world as given: 8.98 dB at held-out places by the generator, 43.0 dB^2 more than with both.
TEST(SealedPair, IsMeasuredFromTheWorldAsGiven) {
  const Scratch scratch;
  const auto world = made_case(
      scratch, "--seed 31 --rows 3000 4000 --mix two --lambda 300 --effects tx_misplaced,antenna_tx,drift,dual_slope",
      3);
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  ASSERT_EQ(found.causes.size(), 2u) << told(found);
  const CauseEstimate& moved = found.causes[0];
  EXPECT_EQ(moved.id, "effect.tx_misplaced");
  EXPECT_EQ(found.causes[1].id, "effect.dual_slope");
  EXPECT_NEAR(found.held_out->rmse_before, 8.98, 0.5);
  EXPECT_NEAR(found.held_out->gain, 43.0, 5);
  EXPECT_GT(moved.held_out->lower95, 0);
  EXPECT_TRUE(found.elsewhere.empty());
  EXPECT_TRUE(moved.elsewhere.empty());
  ASSERT_EQ(found.causes[1].elsewhere.size(), 1u);
  EXPECT_EQ(found.causes[1].elsewhere[0].left_out, "radios");
  ASSERT_EQ(found.stairs.size(), 3u);
  EXPECT_EQ(found.stairs[0].rmse, found.held_out->rmse_before);
  EXPECT_EQ(report::name_of_step(found, 1), "+ tx misplaced");
  const auto rms = [](const Eigen::VectorXd& v) { return std::sqrt(v.array().square().mean()); };
  EXPECT_GT(rms(found.seen.before), 1.4 * rms(found.seen.after));
  EXPECT_GT(rms(moved.effect), 1);
}

// Two runs, separated by the column alone.
TEST(ColumnRun, IsWhatIsLeftOut) {
  const Scratch scratch;
  std::ifstream in(std::filesystem::path(MUSTER_SOURCE_DIR) / "worlds" / "hall" / "measured_plain.csv");
  std::string table, line;
  std::getline(in, line);
  table = line + ",run\n";
  for (int k = 0; k < 2000 && std::getline(in, line); ++k) table += line + (k < 1200 ? ",7\n" : ",9\n");
  const Diagnosis found =
      diagnose(std::filesystem::path(MUSTER_SOURCE_DIR) / "worlds" / "hall", scratch.write("runs.csv", table), plugins);
  ASSERT_EQ(found.elsewhere.size(), 1u);
  EXPECT_EQ(found.elsewhere[0].left_out, "runs");
  EXPECT_EQ(found.elsewhere[0].held_out.blocks, 2);
}

// Parameters fitted to readings of swapped radios do not determine the effect of the swap.
TEST(SealedSwap, IsNamedThoughItBendsAllParameters) {
  const Scratch scratch;
  const auto world = sealed_case(scratch, "--mix one --lambda 800 --effects label_swap", 3);
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  expect_only("effect.label_swap", found);
  EXPECT_NEAR(found.held_out->gain, 186, 15);  // the generator's value
}

// Vecchia's approximation gives 1.25 dB and 0.148 here. Over 255 such worlds 94.5 % of the intervals of both hold the
// truth; by that approximation 90 % would.
TEST(SealedClean, LevelAndExponentAreKnownNoBetterThanTheFieldAllows) {
  const Scratch scratch;
  const auto world = made_case(scratch, "--seed 76 --rows 2000 20000 --mix clean", 79);
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  EXPECT_TRUE(found.causes.empty()) << told(found);
  std::map<std::string, double> known;
  for (const WorldValue& v : found.world_values) known[v.path] = v.stderror;
  EXPECT_NEAR(known["radio.multiwall/l0"], 1.84, 0.2);
  EXPECT_NEAR(known["radio.multiwall/n"], 0.199, 0.02);
}

// At this strength a short wall and an obstacle in its place are often inseparable; only the place is tested here.
TEST(SealedWall, IsFoundInItsPlace) {
  const Scratch scratch;
  const auto world = sealed_case(scratch, "--mix one --lambda 150 --effects unmapped_wall", 9);
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  ASSERT_TRUE(found.named()) << told(found);
  const CauseEstimate& first = found.causes[0];
  ASSERT_TRUE(first.id == "effect.unmapped_wall" || first.id == "effect.obstacle") << told(found);
  std::map<std::string, double> at;
  for (const CauseValue& v : first.values) at[v.name] = v.value;
  const bool wall = first.id == "effect.unmapped_wall";
  // The hidden wall runs from (0.51, 21.13) to (-1.63, 20.48).
  EXPECT_NEAR(wall ? (at["x0"] + at["x1"]) / 2 : at["x"], -0.56, 0.8);
  EXPECT_NEAR(wall ? (at["y0"] + at["y1"]) / 2 : at["y"], 20.80, 0.8);
}

// Walls that saturate look weak in the base fit: the cause's strength depends on the other losses.
TEST(SealedSaturation, IsNamedThoughTheWallsOfTheFitAreTooWeak) {
  const Scratch scratch;
  const auto world = sealed_case(scratch, "--mix one --lambda 60 --effects multiwall_saturation", 4);
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  ASSERT_TRUE(found.named()) << told(found);
  EXPECT_EQ(found.causes[0].id, "effect.multiwall_saturation") << told(found);
}

// Bursts at unknown times resemble an oscillation or a step of the link's radio, in these readings or in others.
TEST(SealedPeople, AreNotTakenForWhatChangesInTime) {
  const Scratch scratch;
  const auto world = sealed_case(scratch, "--mix one --lambda 200 --effects people", 5);
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  expect_only("effect.people", found);
  const auto extended = scratch / "extended";
  EXPECT_EQ(names_in_words(closed_loop(found, world, world / "measured.csv", extended, plugins).value().rediagnosis),
            "silent");
  EXPECT_EQ(names_in_words(second_look(world, extended, world / "second.csv", plugins).value().rediagnosis), "silent");
}

// A drift of 4 dB and powers 1.7 dB off mask the reason of 530 missing readings among 4,720.
TEST(SealedFloor, IsFoundBesideWhatHidIt) {
  const Scratch scratch;
  const auto world = made_case(scratch, "--seed 95 --rows 2000 20000 --mix three --lambda 50,400", 5);
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  std::set<std::string> ids;
  for (const CauseEstimate& c : found.causes) {
    ids.insert(c.id);
    if (c.id != "effect.power_steps") continue;  // the third of its four is correct
    EXPECT_EQ(c.title, "powers are not as set: by {error1}, {error2}, {error4} from the lowest up");
  }
  EXPECT_EQ(ids, (std::set<std::string>{"effect.drift", "effect.power_steps", "effect.rssi_floor"})) << told(found);
}

// Near a receiver's saturation readings are truncated from above, which resembles bursts.
TEST(SealedPeople, AreSoughtApartFromWhatIsClipped) {
  const Scratch scratch;
  const auto clipped = made_case(scratch, "--seed 84 --rows 2000 20000", 479);
  expect_only("effect.rssi_saturation", diagnose(clipped, clipped / "measured.csv", plugins));
  const auto both = made_case(scratch, "--seed 95 --rows 2000 20000 --mix three --lambda 50,400", 1);
  const Diagnosis found = diagnose(both, both / "measured.csv", plugins);
  ASSERT_GE(found.causes.size(), 2u) << told(found);
  EXPECT_EQ(found.causes[0].id, "effect.rssi_saturation");
  EXPECT_EQ(found.causes[1].id, "effect.people");
  EXPECT_EQ(found.causes[1].label, "radio/beacon2 radio/robot1");
}

// Readings well below the receiver's saturation determine the field.
TEST(SealedField, IsSeenBesideAReceiverThatSaturates) {
  const Scratch scratch;
  const auto world = made_case(scratch, "--seed 88 --rows 2000 20000", 178);
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  ASSERT_EQ(found.causes.size(), 2u) << told(found);
  EXPECT_EQ(found.causes[0].id, "effect.rssi_saturation");
  EXPECT_EQ(found.causes[1].id, "effect.shadowing_correlation");
}

// Whitened dips have rims: sign-flipped they resemble dips, and must not count as a misfit of the field.
TEST(SealedPeople, AreSeenThoughTheirDipsHaveRims) {
  const Scratch scratch;
  const auto world = sealed_case(scratch, "--mix one --lambda 60 --effects people", 6);
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  expect_only("effect.people", found);
}

// Fading of Rician K 7.7 dB with 3.74 dB stated. Beside the stated law the field looks too smooth: field and law are
// fitted in turn.
TEST(SealedFading, IsAsStrongAsItIs) {
  const Scratch scratch;
  const auto world = made_case(scratch, "--seed 77 --rows 2000 20000", 8);
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  ASSERT_EQ(found.causes.size(), 2u) << told(found);
  EXPECT_EQ(found.causes[1].id, "effect.fading_law");  // behind what lowers the error at left-out places
  EXPECT_NEAR(found.causes[1].values.at(0).value, 7.66, 0.4);
  EXPECT_EQ(names_in_words(
                closed_loop(found, world, world / "measured.csv", scratch / "extended", plugins).value().rediagnosis),
            "silent");
}

// A Gaussian correlation over 3.27 m with 2.38 m stated: no family of the stated distance fits as well.
TEST(SealedField, OfASmoothFamilyIsNotTakenForTheStatedOne) {
  const Scratch scratch;
  const auto world =
      made_case(scratch, "--seed 92 --rows 2000 20000 --mix one --lambda 60 --effects shadowing_correlation", 14);
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  expect_only("effect.shadowing_correlation", found);
}

class CleanCase : public testing::TestWithParam<int> {};

TEST_P(CleanCase, IsSilent) {
  const Scratch scratch;
  const auto world = sealed_case(scratch, "--mix clean", GetParam());
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  EXPECT_STREQ(found.verdict(), "adequate") << told(found);
}

INSTANTIATE_TEST_SUITE_P(Seeds, CleanCase, testing::Values(7, 8));

// Three of its 12,720 readings pass a wall's end within 0.1 mm, and on its other side on a simulation's lattice.
TEST(GrazingLinks, AreNoOutliers) {
  const Scratch scratch;
  const auto world = made_case(scratch, "--seed 74 --rows 2000 20000 --mix clean", 841);
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  EXPECT_STREQ(found.verdict(), "adequate") << told(found);
  const auto says = [&](const std::string& note) { return note.find("would cross other walls") != note.npos; };
  EXPECT_TRUE(std::any_of(found.notes.begin(), found.notes.end(), says));
}

// The same table with receivers' places off by 5 cm, as a surveyor's are.
std::filesystem::path with_places_off(const Scratch& scratch, const std::filesystem::path& table) {
  const TextTable read = TextTable::read(table);
  const std::vector<TextColumn>& columns = read.columns();
  std::vector<std::vector<double>> values(columns.size());
  const Stream random(key_of("surveyor"));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (!read.is_numeric(k)) continue;
    values[k] = read.reals(k, {.empty = true});
    const bool off = columns[k].name == "rx_x" || columns[k].name == "rx_y";
    for (std::size_t row = 0; off && row < values[k].size(); ++row) values[k][row] += 0.05 * random.normal(row, k);
  }
  TextTableWriter out(scratch / "off.csv", columns);
  for (std::size_t row = 0; row < read.rows(); ++row) {
    for (std::size_t k = 0; k < columns.size(); ++k)
      values[k].empty() ? out.text(read.text(row, k)) : out.real(values[k][row]);
    out.end_row();
  }
  out.close();
  return scratch / "off.csv";
}

TEST(GrazingLinks, PlacesThatAreOffMakeNoOutliers) {
  const Scratch scratch;
  const auto world = made_case(scratch, "--generator run --seed 74 --mix clean", 3);
  const Diagnosis found = diagnose(world, with_places_off(scratch, world / "measured.csv"), plugins);
  EXPECT_STREQ(found.verdict(), "adequate") << told(found);
}

// Long rows hide half of these walls' effect (a regression). The first two were not named. The third's loss ranged
// from 0 to 28 dB, and its place from one end of the plan to the other.
class Wall : public testing::TestWithParam<int> {};

TEST_P(Wall, IsFoundAtItsEdges) {
  const Scratch scratch;
  const auto world =
      made_case(scratch, "--seed 503 --rows 2000 20000 --mix one --effects unmapped_wall --lambda 100", GetParam());
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  expect_only("effect.unmapped_wall", found);
  int edges = 0;
  for (const CauseValue& value : found.causes.at(0).values) {
    if (value.unit == "m") {
      EXPECT_LT(value.upper95 - value.lower95, 10) << value.name;
      ++edges;
    }
  }
  EXPECT_GE(edges, 4);  // of two ends
}

INSTANTIATE_TEST_SUITE_P(Cases, Wall, testing::Values(15, 16, 8));

// Narrow optima: the scan's best line, 5 cm aside, had half of the gain, and successive halving from there ended
// elsewhere.
TEST(WallAmongNarrowTops, IsFoundToTheDecimetre) {
  const Scratch scratch;
  const auto world = made_case(scratch, "--seed 84 --rows 2000 20000", 549);
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  expect_only("effect.unmapped_wall", found);
  const std::map<std::string, double> there{{"x0", -28.43}, {"y0", -15.44}, {"x1", -26.56}, {"y1", -12.72}};
  int ends = 0;
  for (const CauseValue& value : found.causes.at(0).values) {
    const auto truth = there.find(value.name);
    if (truth == there.end()) continue;
    EXPECT_NEAR(value.value, truth->second, 0.1) << value.name;
    ++ends;
  }
  EXPECT_EQ(ends, 4);
}

// A floor that hides a handful of readings, alone and beside random loss.
class Silence : public testing::TestWithParam<std::pair<int, int>> {};  // seed, case

TEST_P(Silence, OfAHandfulIsTold) {
  const auto [seed, number] = GetParam();
  const Scratch scratch;
  const auto world = made_case(scratch, "--seed " + std::to_string(seed) + " --rows 2000 20000", number);
  expect_only("effect.rssi_floor", diagnose(world, world / "measured.csv", plugins));
}

INSTANTIATE_TEST_SUITE_P(Cases, Silence, testing::Values(std::pair(84, 784), std::pair(86, 145)));

// Seen from two or three sides, and narrow: its edges lie within centimetres, with many optima between them. Two that
// were taken for walls.
class Thing : public testing::TestWithParam<int> {};

TEST_P(Thing, IsNoWall) {
  const Scratch scratch;
  const auto world =
      made_case(scratch, "--seed 501 --rows 2000 20000 --mix one --effects obstacle --lambda 150", GetParam());
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  expect_only("effect.obstacle", found);
}

INSTANTIATE_TEST_SUITE_P(Cases, Thing, testing::Values(11, 19));

// A shadow straight behind, across the wrap of angles. It was reported at -180 degrees, give or take 1.4, at the
// bound of the search.
TEST(Directions, GoOnBeyondHalfATurn) {
  const Scratch scratch;
  const auto world = made_case(scratch, "--seed 84 --rows 2000 20000", 104);
  const Diagnosis found = diagnose(world, world / "measured.csv", plugins);
  for (const CauseEstimate& cause : found.causes) {
    if (cause.id != "effect.body_shadow") continue;
    const auto direction = std::find_if(cause.values.begin(), cause.values.end(),
                                        [](const CauseValue& v) { return v.name == "direction"; });
    ASSERT_NE(direction, cause.values.end());
    constexpr double hidden = 3.041;  // rad
    const double off = std::remainder(hidden - direction->value, 2 * M_PI);
    EXPECT_GT(off, direction->lower95 - direction->value);
    EXPECT_LT(off, direction->upper95 - direction->value);
    EXPECT_LT(direction->upper95 - direction->lower95, 0.3);
    EXPECT_LE(std::abs(direction->value), 3.15);
    return;
  }
  FAIL() << "no shadow is told";
}

}  // namespace
}  // namespace muster::diagnosis
