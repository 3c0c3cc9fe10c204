// Readings that a world draws itself, diagnosed by the very same world: nothing is wrong with it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "diagnosis/pipeline/diagnose.hpp"
#include "diagnosis/pipeline/unstated_field.hpp"
#include "muster/random.hpp"
#include "tests/diagnosis/pipeline/flat.hpp"

namespace muster::diagnosis {
namespace {

// Logarithm of the ratio of the fitted decorrelation distance to the declared one.
double expect_silence(int seed, const std::string& fading) {
  SCOPED_TRACE(std::to_string(seed) + ": " + fading);
  const Scratch scratch;
  const std::filesystem::path world = flat(scratch, seed, fading);
  const std::filesystem::path measured = drawn_by(scratch, world);
  const Diagnosis found = diagnose(world, measured, plugins);
  EXPECT_EQ(names_in_words(named_causes(found)), "silent");
  EXPECT_EQ(found.noise.family, noise::Family::stated);
  return std::log(found.noise.decorrelation() / 2);
}

TEST(OwnDraws, NothingIsWrongUnderFadingOfEachReading) {
  double off = 0;
  for (const int seed : {1, 2, 3, 4}) off += expect_silence(seed, "rician_k=\"6\" per_reading=\"true\"") / 4;
  EXPECT_LT(std::abs(off), std::log(2.0));
}

TEST(OwnDraws, NothingIsWrongUnderMultipath) {
  double off = 0;
  for (const int seed : {5, 6, 7}) off += expect_silence(seed, "rician_k=\"3\"") / 3;
  EXPECT_LT(std::abs(off), std::log(2.0));
}

// The tour with the readings of the stations too.
std::vector<std::string> both_ways() {
  std::vector<std::string> rows;
  for (const std::string& row : tour()) {
    rows.push_back(row);
    std::vector<std::string> cells;
    std::istringstream from(row);
    for (std::string cell; std::getline(from, cell, ',');) cells.push_back(cell);
    std::string back = cells[0];
    for (const std::size_t k : {2, 1, 6, 7, 8, 3, 4, 5}) back += ',' + cells[k];
    rows.push_back(back);
  }
  return rows;
}

// Both directions share each fade. Counted twice, fades would be structure.
TEST(OwnDraws, NothingIsWrongWhereBothDirectionsAreMeasured) {
  for (const int seed : {8, 9, 10}) {
    SCOPED_TRACE(seed);
    const Scratch scratch;
    const std::filesystem::path world = flat(scratch, seed, "rician_k=\"-40\" per_reading=\"true\"");
    const Diagnosis found = diagnose(world, drawn_by(scratch, world, plugins, both_ways()), plugins);
    EXPECT_EQ(names_in_words(named_causes(found)), "silent");
    EXPECT_NEAR(std::sqrt(found.noise.reading_variance()), 5.57, 0.4);  // of a Rayleigh fade in dB
  }
}

// Nothing blurs the waves of which the field is made.
TEST(OwnDraws, NothingIsWrongWithoutFading) {
  for (const int seed : {11, 12, 13, 14}) {
    SCOPED_TRACE(seed);
    const Scratch scratch;
    const std::filesystem::path world = flat(scratch, seed, "fading=\"false\"");
    EXPECT_EQ(names_in_words(named_causes(diagnose(world, drawn_by(scratch, world), plugins))), "silent");
  }
}

// A world whose receiver loses readings; `power`: dBm; `receiver`: its element, or none.
std::filesystem::path far_off(const Scratch& scratch, int seed, int power, const std::string& receiver) {
  std::filesystem::path world = flat(scratch, seed, "rician_k=\"6\" per_reading=\"true\"");
  std::string text = contents(world);
  const auto replace = [&](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, text.npos) << from;
    text.replace(at, from.size(), to);
  };
  replace("tx_power=\"1\"", fmt::format("tx_power=\"{}\"", power));
  replace("<radio.receiver sensitivity=\"-200\"/>", receiver);
  std::ofstream(world) << text;
  return world;
}

// A receiver that the world writes, and its default where the log ends at that; also where nothing was heard at first,
// for no message had been sent.
TEST(OwnDraws, NothingIsWrongWhereMostReadingsAreLost) {
  for (const int seed : {21, 22, 23, 24, 25, 26}) {
    SCOPED_TRACE(seed);
    const Scratch scratch;
    const std::filesystem::path world =
        far_off(scratch, seed, -42, seed % 2 ? "" : "<radio.receiver sensitivity=\"-95\"/>");
    const std::filesystem::path measured = drawn_by(scratch, world);
    std::string log = contents(measured);
    for (std::size_t k = 0; k < 3; ++k) log.insert(log.find('\n') + 1, "-0.7" + tour()[k].substr(1) + ",\n");
    std::ofstream(measured) << log;
    const Diagnosis found = diagnose(world, measured, plugins);
    EXPECT_EQ(names_in_words(named_causes(found)), "silent");
    EXPECT_STREQ(found.verdict(), "adequate");
    EXPECT_GT(found.readings, 1200u);                                  // those that were lost are bounds
    EXPECT_NEAR(std::sqrt(found.noise.reading_variance()), 3.2, 1.1);  // of the upper part of skewed fades
  }
}

// Packets that collide are lost however strong they are, beside those that are too weak: no bounds, which would be
// gross errors.
TEST(OwnDraws, NothingIsWrongWherePacketsCollideBesides) {
  const Stream random(key_of("collisions"));
  for (const int seed : {27, 28, 29}) {
    SCOPED_TRACE(seed);
    const Scratch scratch;
    const std::filesystem::path world = far_off(scratch, seed, -34, "");
    std::istringstream log(contents(drawn_by(scratch, world)));
    std::ofstream out(scratch / "measured.csv");
    std::string row;
    for (uint64_t i = 0; std::getline(log, row); ++i)
      out << (i > 0 && random.uniform(i) < 0.03 ? row.substr(0, row.rfind(',') + 1) : row) << '\n';
    out.close();
    const Diagnosis found = diagnose(world, scratch / "measured.csv", plugins);
    EXPECT_STREQ(found.verdict(), "adequate");
    EXPECT_NEAR(std::sqrt(found.noise.reading_variance()), 3.2, 0.5);
    EXPECT_NE(std::find_if(found.notes.begin(), found.notes.end(),
                           [](const std::string& note) { return note.find("lost otherwise") != note.npos; }),
              found.notes.end());
  }
}

// A log that keeps only what was heard, of a receiver that the world writes and of one by default.
TEST(OwnDraws, NothingIsWrongWhereTheLogKeepsWhatWasHeard) {
  for (const int seed : {31, 32, 37, 38}) {
    SCOPED_TRACE(seed);
    const Scratch scratch;
    const std::filesystem::path world =
        far_off(scratch, seed, -36, seed % 2 ? "" : "<radio.receiver sensitivity=\"-95\"/>");
    std::istringstream log(contents(drawn_by(scratch, world)));
    std::ofstream out(scratch / "measured.csv");
    for (std::string row; std::getline(log, row);) {
      if (row.back() != ',') out << row << '\n';
    }
    out.close();
    EXPECT_EQ(names_in_words(named_causes(diagnose(world, scratch / "measured.csv", plugins))), "silent");
  }
}

// A receiver that loses the more packets the weaker they are, over some decibels: single readings are asked how they
// scatter where many are strong, and not where few are.
TEST(OwnDraws, NothingIsWrongWhereAFloorSetsInOverSomeDecibels) {
  const Stream random(key_of("packet errors"));
  for (const auto& [seed, power] : {std::pair{41, -36}, std::pair{42, -36}, std::pair{43, -26}, std::pair{44, -26}}) {
    SCOPED_TRACE(seed);
    const Scratch scratch;
    const std::filesystem::path world = far_off(scratch, seed, power, "<radio.receiver sensitivity=\"-110\"/>");
    std::istringstream log(contents(drawn_by(scratch, world)));
    std::ofstream out(scratch / "measured.csv");
    std::string row;
    std::getline(log, row);
    out << row << '\n';
    for (uint64_t i = 0; std::getline(log, row); ++i) {
      const std::size_t last = row.rfind(',') + 1;
      const bool heard =
          last < row.size() && random.uniform(i) < 1 / (1 + std::exp(-(std::stod(row.substr(last)) + 92)));
      out << (heard ? row : row.substr(0, last)) << '\n';
    }
    out.close();
    const std::filesystem::path stated = far_off(scratch, seed, power, "<radio.receiver sensitivity=\"-92\"/>");
    const Diagnosis found = diagnose(stated, scratch / "measured.csv", plugins);
    EXPECT_EQ(names_in_words(named_causes(found)), "silent");
    const bool is_tested = std::none_of(found.not_tested.begin(), found.not_tested.end(),
                                        [](const std::string& why) { return why.starts_with("effect.fading_law"); });
    EXPECT_EQ(is_tested, power == -26);
  }
}

// All scatter together, which is seen where the laws of single readings cannot be tested.
TEST(OwnDraws, ScatterAsTheWorldSays) {
  const Scratch scratch;
  const auto scatter_in = [&](const std::string& said, const std::string& done) {
    const std::filesystem::path measured = drawn_by(scratch, flat(scratch, 16, done));
    const DiagnosisSetup at(flat(scratch, 16, said), measured, plugins);
    return other_scatter(at, inference::ModelState(at.problem, at.options));
  };
  const std::string field = "shadowing=\"1\" decorrelation=\"2\" per_reading=\"true\" ";
  const std::string wild = field + "rician_k=\"-40\"", calm = field + "rician_k=\"12\"";
  EXPECT_FALSE(scatter_in(wild, wild));
  EXPECT_FALSE(scatter_in(calm, calm));
  EXPECT_FALSE(scatter_in("shadowing=\"0\" fading=\"false\"", calm));  // says nothing
  const auto less = scatter_in(wild, calm), more = scatter_in(calm, wild);
  ASSERT_TRUE(less && more);
  EXPECT_LT(less->measured, less->least);
  EXPECT_GT(more->measured, more->most);
}

// A fifth more or less of all scatter is within the range of draws; that of single readings is not.
TEST(OwnDraws, SingleReadingsScatterAsTheWorldSays) {
  const auto scatter_in = [&](const std::string& said, const std::string& done) {
    const Scratch scratch;
    const std::filesystem::path measured = drawn_by(scratch, flat(scratch, 16, done));
    const DiagnosisSetup at(flat(scratch, 16, said), measured, plugins);
    return other_scatter(at, inference::ModelState(at.problem, at.options));
  };
  const std::string calm = "rician_k=\"12\" per_reading=\"true\"", wilder = "rician_k=\"9\" per_reading=\"true\"";
  EXPECT_FALSE(scatter_in(calm, calm));
  EXPECT_FALSE(scatter_in(wilder, wilder));
  const auto more = scatter_in(calm, wilder), less = scatter_in(wilder, calm);
  ASSERT_TRUE(more && less);
  EXPECT_TRUE(more->of_single && less->of_single);
  EXPECT_GT(more->measured, more->most);
  EXPECT_LT(less->measured, less->least);
}

// A direction that is 0.3 dB weaker is seen beneath fades of 5.6 dB that both share.
TEST(OwnDraws, ASmallOffsetOfOneDirectionIsFound) {
  const Scratch scratch;
  const std::filesystem::path world = flat(scratch, 15, "rician_k=\"-40\" per_reading=\"true\"");
  const std::filesystem::path other =
      flat(scratch, 15, "rician_k=\"-40\" per_reading=\"true\"", "<effect.tx_offset radio=\"s2\" offset=\"-0.3\"/>");
  const std::filesystem::path measured = drawn_by(scratch, other, plugins, both_ways());
  const Diagnosis found = diagnose(flat(scratch, 15, "rician_k=\"-40\" per_reading=\"true\""), measured, plugins);
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_EQ(found.causes[0].row, "s2");
  EXPECT_NEAR(std::abs(found.causes[0].values.at(0).value), 0.3, 0.03);
}

}  // namespace
}  // namespace muster::diagnosis
