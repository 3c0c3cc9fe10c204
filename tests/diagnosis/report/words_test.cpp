// Words, digits and gates, on synthetic results.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "diagnosis/report/advice.hpp"
#include "diagnosis/report/json.hpp"
#include "diagnosis/report/page.hpp"
#include "diagnosis/report/text.hpp"

namespace muster::report {
namespace {

CauseEstimate wall(inference::Status status, std::optional<inference::HeldOutGain> held_out) {
  CauseEstimate c;
  c.id = "effect.unmapped_wall";
  c.label = "(1.00, 2.00) to (3.00, 2.00)";
  c.title = "a wall that is not on the map costs {loss}";
  c.tell_apart = "cross the place from both sides";
  c.status = status;
  c.values = {{"loss", "dB", 8.5632, 0.16, 8.254, 8.871, 0, 40}};
  c.evidence = 20;
  c.lambda = 51;
  c.held_out = held_out;
  return c;
}

Diagnosis with(const CauseEstimate& cause) {
  Diagnosis d;
  d.readings = 1000;
  d.rows = 200;
  d.causes = {cause};
  d.held_out = cause.held_out;
  return d;
}

bool says(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

TEST(Digits, FollowTheInterval) {
  EXPECT_EQ(rounded(8.5632, 0.31), "8.6");
  EXPECT_EQ(rounded(8.5632, 0.13), "8.56");
  EXPECT_EQ(rounded(1234.5, 60), "1234");
  EXPECT_EQ(rounded(-0.001, 0.3), "0.0");
  EXPECT_EQ(quantity(M_PI / 2, 0.1, "rad"), "90 deg");
  EXPECT_EQ(interval({"loss", "dB", 8.5, 0.1, 8.254, 8.871, 0, 40}), "8.3 to 8.9 dB");
  EXPECT_EQ(interval({"x", "m", 1, 0, 1, 1, -9, 9}), "no interval");
}

TEST(Sentence, SaysTheSizeAndOneOfTwoWordsByTheSign) {
  CauseEstimate c;
  c.title = "the radio {radio} reads {offset|too high|too low}";
  c.row = "ap2";
  c.values = {{"offset", "dB", -11.27, 0.5, -12.3, -10.1, -60, 60}};
  EXPECT_EQ(sentence(c), "the radio ap2 reads 11.3 dB too low");
  c.values[0].value = 4;
  EXPECT_EQ(sentence(c), "the radio ap2 reads 4.0 dB too high");
  c.title = "jumps by {offset}";
  EXPECT_EQ(sentence(c), "jumps by 4.0 dB");
}

TEST(Gate, ALawInDoubtIsSuspectedAndItsRivalsAreNotSaidToBeExcluded) {
  CauseEstimate field = wall(inference::Status::named, {});
  field.id = "effect.shadowing_correlation";
  field.covariates = {"reading"};
  const auto text = [&] { return text_of(with(field), {"hall", "a.csv"}); };
  EXPECT_TRUE(says(text(), "(1) it is effect.shadowing_correlation"));
  EXPECT_FALSE(says(text(), "exclude all other causes"));
  field.doubt = "a law of distance would do as well";
  EXPECT_TRUE(says(text(), "hall seems wrong: one cause is named, but it is in doubt."));
  EXPECT_TRUE(says(text(), "suspected: effect.shadowing_correlation"));
  Diagnosis two = with(field);
  two.causes.push_back(field);
  EXPECT_TRUE(says(text_of(two, {"hall", "a.csv"}), "two causes are named, but they are in doubt."));
}

TEST(Gate, IsIsSaidOnlyWhereHeldOutDataShowIt) {
  const CauseEstimate sure = wall(inference::Status::named, inference::HeldOutGain{3.5, 2.5, 6, 2.4, 11, 21});
  EXPECT_EQ(confidence_of(sure), Confidence::confirmed);
  EXPECT_TRUE(says(text_of(with(sure), {"hall", "a.csv"}), "(1) it is effect.unmapped_wall"));
  const CauseEstimate touching = wall(inference::Status::named, inference::HeldOutGain{3.5, 3.4, 0.7, -0.1, 1.5, 21});
  EXPECT_EQ(confidence_of(touching), Confidence::unconfirmed);
  const CauseEstimate refuted = wall(inference::Status::named, inference::HeldOutGain{3.5, 3.8, -2, -3, -1, 21});
  EXPECT_EQ(confidence_of(refuted), Confidence::unconfirmed);
  for (const char* words :
       {"gain        none: the error at what was held out is larger", "Not confirmed on held-out data: the error"})
    EXPECT_TRUE(says(text_of(with(refuted), {"hall", "a.csv"}), words)) << words;
  const CauseEstimate of_few = wall(inference::Status::named, inference::HeldOutGain{3.5, 2.5, 6, 5.1, 7, 4});
  EXPECT_EQ(confidence_of(of_few), Confidence::unconfirmed);
  EXPECT_EQ(why_unconfirmed(of_few), "the gain in 4 blocks of space may be chance");
  const CauseEstimate aside = wall(inference::Status::suspected, {});
  EXPECT_EQ(confidence_of(aside), Confidence::set_aside);
  const CauseEstimate unmeasured = wall(inference::Status::named, {});
  EXPECT_EQ(confidence_of(unmeasured), Confidence::unconfirmed);
  for (const CauseEstimate& c : {touching, of_few, aside, unmeasured}) {
    const std::string text = text_of(with(c), {"hall", "a.csv"});
    EXPECT_TRUE(says(text, "suspected: effect.unmapped_wall")) << text;
    EXPECT_FALSE(says(text, "it is")) << text;
    EXPECT_FALSE(says(text, "is wrong")) << text;
  }
}

TEST(Text, SaysLambdaGainAndBlocks) {
  const auto cause = wall(inference::Status::named, inference::HeldOutGain{3.5, 2.5, 6, 2.4, 11, 21});
  const std::string text = text_of(with(cause), {"hall", "a.csv"});
  for (const char* what :
       {"lambda 51", "evidence    20.0 nats", "95 %: 2.40 to", "11.00, 21 blocks", "8.6 dB", "95 %: 8.3 to 8.9 dB"})
    EXPECT_TRUE(says(text, what)) << what << "\n" << text;
}

TEST(Text, OneBlockIsSaidNotHidden) {
  const std::string text = text_of(with(wall(inference::Status::named, {})), {"hall", "a.csv"});
  EXPECT_TRUE(says(text, "lie in one block")) << text;
  EXPECT_TRUE(says(text, "not measured: too few blocks")) << text;
}

TEST(Text, UndecidedAlternativesAreQuestions) {
  CauseEstimate c = wall(inference::Status::named, inference::HeldOutGain{3.5, 2.5, 6, 2.4, 11, 21});
  c.alternatives.push_back({"effect.obstacle", "(2.00, 2.00)", {}, 1.5, 6});
  Diagnosis d = with(c);
  d.advice.push_back({"turn on the spot", c.id, "effect.obstacle", 6, 15.0});
  d.advice.push_back({"move base", c.id, "effect.obstacle", 6, 74.0});
  d.advised = diagnosis::PlannedReadings{"move base", {}};
  const std::string text = text_of(d, {"hall", "a.csv"});
  EXPECT_TRUE(says(text, "unmapped wall or obstacle: D 6, not distinguishable")) << text;
  EXPECT_EQ(names_of(c), "effect.unmapped_wall or effect.obstacle (the readings do not tell which)");
  c.alternatives[0].evidence_gap = 3.1;  // 95 % sure
  EXPECT_EQ(names_of(c), "effect.unmapped_wall");
  const auto best = text.find("move base: predicted D 74, decides; advised.csv lists its readings");
  EXPECT_LT(best, text.find("turn on the spot: predicted D 15\n")) << text;
}

TEST(Text, AlternativesOfTheSameNameAreToldByTheirRows) {
  CauseEstimate c = wall(inference::Status::named, inference::HeldOutGain{3.5, 2.5, 6, 2.4, 11, 21});
  c.label = "wall/w1";
  c.alternatives.push_back({c.id, "wall/w2", {}, -0.01, 0});
  const std::string text = text_of(with(c), {"hall", "a.csv"});
  EXPECT_TRUE(says(text, "unmapped wall of wall/w1 or of wall/w2: D 0, not distinguishable")) << text;
  EXPECT_TRUE(says(text, "unmapped wall wall/w2, as likely")) << text;
}

std::size_t times_said(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; ++at) ++count;
  return count;
}

TEST(Text, SaysOnceWhatHoldsOfSeveralAlternativesOrGains) {
  const inference::HeldOutGain none{3.5, 3.6, -0.7, -1.5, 0.1, 21};
  CauseEstimate c = wall(inference::Status::named, none);
  c.elsewhere = {{"radios", none}};
  c.alternatives = {{"effect.obstacle", "all", {}, 1, 6}, {"effect.drift", "all", {}, -2.8, 7}};
  const std::string text = text_of(with(c), {"hall", "a.csv"});
  EXPECT_EQ(times_said(text, "cross the place from both sides"), 1u) << text;
  EXPECT_EQ(times_said(text, "none to be seen"), 1u) << text;
  EXPECT_TRUE(says(text, "(21 blocks, 21")) << text;
}

TEST(Text, AGainBelowZeroIsARiseAndAGapBelowZeroALead) {
  CauseEstimate c = wall(inference::Status::named, inference::HeldOutGain{3.5, 3.6, -0.7, -1.5, 0.1, 21});
  c.alternatives = {{"effect.drift", "all", {}, -2.8, 7}};
  const std::string text = text_of(with(c), {"hall", "a.csv"});
  EXPECT_TRUE(says(text, "rises by 0.70 dB2")) << text;
  EXPECT_TRUE(says(text, "drift, 16 times likelier (2.8 nats), D 7")) << text;
  EXPECT_FALSE(says(text, "falls by -")) << text;
}

// Variances as logarithms: 9 dB^2 of the field, 4 dB^2 of a reading.
TEST(Text, NoiseIsToldAsShadowing) {
  Diagnosis d = with(wall(inference::Status::named, {}));
  d.noise = {noise::Family::stated, {std::log(9), std::log(2.5), std::log(4), 0}};
  EXPECT_TRUE(says(page_of(d, {"hall", "a.csv"}, {}),
                   "Noise: shadowing of 3.00 dB that decorrelates over 2.50 m (the correlation that the world states), "
                   "and 2.00 dB a reading."));
  EXPECT_TRUE(says(text_of(d, {"hall", "a.csv"}), "Noise: shadowing of 3.00 dB that decorrelates"));
  d.noise.family = noise::with_fixed(noise::Family::exponential, 2, 1);
  EXPECT_TRUE(says(page_of(d, {"hall", "a.csv"}, {}),
                   "(exponential correlation, 30 % of its variance kept at a place, each way of a link by itself), and "
                   "2.00 dB a reading."));
}

TEST(Text, WhatIsUnexplainedNamesTheCausesThatExplainItNearlyAsWell) {
  Diagnosis d = with(wall(inference::Status::named, {}));
  d.causes.clear();
  d.unexplained = {{"battery", 20.3, 52, {}, {}}};
  EXPECT_TRUE(says(text_of(d, {"hall", "a.csv"}), "no known cause explains: something depends on the column battery"));
  EXPECT_TRUE(says(page_of(d, {"hall", "a.csv"}, {}), "no cause on the plugin path explains it: evidence 20.3 nats"));
  d.unexplained[0].alternatives = {{"effect.drift", "radio/base", {}, 1.2, 3}, {"effect.step", "all", {}, 2.6, 15}};
  const std::string text = text_of(d, {"hall", "a.csv"}), page = page_of(d, {"hall", "a.csv"}, {});
  EXPECT_TRUE(says(text, "no known cause explains as well: something")) << text;
  EXPECT_FALSE(says(text, "on the plugin path")) << text;
  EXPECT_TRUE(says(text, "column battery or drift: D 3, not distinguishable")) << text;
  EXPECT_TRUE(says(text, "measure with the column battery changed and all else as it was")) << text;
  const char* const alternatives =
      "drift radio/base, 3.3 times less likely (1.2 nats), D 3: not distinguishable; step, 13 times less likely (2.6 "
      "nats), D 15";
  EXPECT_TRUE(says(page, alternatives)) << page;
  EXPECT_EQ(rivals_in_words({{"effect.step", "all", {}, 4.8, 0, 0.1}}),
            "step, 122 times less likely (4.8 nats), D 0: not distinguishable by the readings, but less likely before "
            "them");
  const auto json = nlohmann::json::parse(json_of(d).dump());
  EXPECT_EQ(json["unexplained"][0]["rivals"][0]["id"], "effect.drift");
  EXPECT_EQ(json["advice"][0]["separates"], "~battery effect.drift");
}

TEST(Text, WhatWasCheckedIsFineDoubtfulOrAskedByATestOfItsOwn) {
  Diagnosis d = with(wall(inference::Status::named, {}));
  const auto check = [](const char* id, inference::Kind kind, double p) {
    inference::Check c;
    c.id = id;
    c.kind = kind;
    c.log_p = std::log(p);
    return c;
  };
  d.checks = {check("~logd", inference::Kind::smooth, 0.4), check("effect.drift", inference::Kind::named, 0.002),
              check("effect.step", inference::Kind::named, 1e-8)};
  d.checks.back().refused = "rests on fewer than five readings";
  d.searched = {"effect.drift", "effect.outliers", "effect.people", "effect.step", d.causes[0].id};
  for (const std::string& report : {text_of(d, {"hall", "a.csv"}), page_of(d, {"hall", "a.csv"}, {})}) {
    const auto doubtful = report.find("oubtful");
    EXPECT_LT(report.find("drift"), doubtful) << report;
    EXPECT_GT(report.rfind("step"), doubtful) << report;
    EXPECT_TRUE(says(report, "p = 1e-08, rests on fewer than five readings")) << report;
    EXPECT_TRUE(says(report, "Also tested: outliers, people.")) << report;
  }
}

TEST(Text, ALawHasNoGainToMeasure) {
  Diagnosis d = with(wall(inference::Status::named, {}));
  d.causes[0].covariates = {"reading"};
  EXPECT_TRUE(says(text_of(d, {"hall", "a.csv"}), "judged by how readings are distributed"));
  EXPECT_TRUE(says(page_of(d, {"hall", "a.csv"}, {}), "judged by how readings are distributed"));
}

TEST(Text, WhatTheReadingsDoNotIdentifyHasNoInterval) {
  Diagnosis d = with(wall(inference::Status::named, {}));
  d.world_values = {{.path = "radio.multiwall/l0", .unit = "dB", .value = 2, .stderror = 0.3, .identifiable = false}};
  for (const std::string& report : {text_of(d, {"hall", "a.csv"}), page_of(d, {"hall", "a.csv"}, {})})
    EXPECT_TRUE(says(report, "not identifiable")) << report;
  const auto json = nlohmann::json::parse(json_of(d).dump());
  EXPECT_TRUE(json["world_parameters"][0]["stderr"].is_null());
  EXPECT_EQ(json["world_parameters"][0]["identifiable"], false);
}

TEST(Text, GainsWithRadiosAndRunsNotSeenStandBesideThoseOfPlaces) {
  const inference::HeldOutGain places{3.5, 2.5, 6, 2.4, 11, 21}, radios{4.5, 3.25, 9.69, 5, 12, 4},
      runs{3.75, 3, 5.06, 1, 7, 2};
  Diagnosis d = with(wall(inference::Status::named, places));
  d.elsewhere = {{"radios", radios}, {"runs", runs}};
  d.causes[0].elsewhere = d.elsewhere;
  d.unexplained = {{"battery", 30, 60, {}, d.elsewhere}};
  const std::string text = text_of(d, {"hall", "a.csv"}), page = page_of(d, {"hall", "a.csv"}, {});
  for (const std::string& report : {text, page}) {
    for (const char* words : {"4.50 dB, 3.25 dB with the causes below", "4 radios)", "2 runs)"})
      EXPECT_TRUE(says(report, words)) << words << '\n' << report;
  }
  const auto json = nlohmann::json::parse(json_of(d).dump());
  EXPECT_EQ(json["causes"][0]["elsewhere"][1]["left_out"], "runs");
  EXPECT_EQ(json["elsewhere"][0]["gain_upper95"], 12);
  EXPECT_EQ(json["unexplained"][0]["elsewhere"][0]["blocks"], 4);
}

// Each accepted term, named or not, in the order in which it was added; under the name that it has in the end.
TEST(Steps, AreNamedAfterWhatWasAdded) {
  Diagnosis d = with(wall(inference::Status::named, {}));
  d.causes[0].sought_as = d.causes[0].id;
  CauseEstimate swapped = d.causes[0];
  swapped.id = "effect.label_swap";
  swapped.sought_as = "effect.tx_misplaced";
  swapped.lambda = 10;
  d.causes.push_back(swapped);
  d.unexplained = {{"battery", 30, 60, {}}, {"x", 90, 180, {}}};  // the second stands beside, and is no step
  d.of_people = {{"time", 20, 40, {}}};
  d.stairs = {{4, 3, 5, ""},           {3.8, 3, 5, "effect.drift"}, {3.5, 3, 5, "effect.tx_misplaced"},
              {3.4, 3, 5, "~battery"}, {3.3, 3, 5, d.causes[0].id}, {3.2, 3, 5, "~time"}};
  const char* expected[] = {"the world, fitted", "+ drift",        "+ label swap", "+ the column battery (unexplained)",
                            "+ unmapped wall",   "+ time (people)"};
  for (std::size_t k = 0; k < d.stairs.size(); ++k) EXPECT_EQ(name_of_step(d, k), expected[k]) << k;
}

// What is set aside as a residue of stronger findings is held out of nothing, however many blocks there are.
TEST(Text, SaysWhyWhatIsUnexplainedHasNoGain) {
  Diagnosis d;
  d.unexplained = {{"battery", 30, 60, {}}};
  EXPECT_TRUE(says(text_of(d, {"hall", "a.csv"}), "not measured: too few blocks"));
  d.held_out = inference::HeldOutGain{2.5, 2.5, 0, 0, 0, 12};
  EXPECT_TRUE(says(text_of(d, {"hall", "a.csv"}), "not measured: stronger findings"));
  EXPECT_FALSE(says(page_of(d, {"hall", "a.csv"}, {}), "too few blocks"));
}

TEST(Text, NothingFoundIsAdequate) {
  Diagnosis d;
  d.held_out = inference::HeldOutGain{2.5, 2.5, 0, 0, 0, 12};
  d.stairs = {{2.5, 2.2, 2.8, ""}};
  const std::string text = text_of(d, {"hall", "a.csv"});
  EXPECT_TRUE(says(text, "hall is adequate: nothing was found beyond chance")) << text;
  EXPECT_FALSE(says(text, "Cause"));
  inference::Check near;
  near.id = "effect.room_clutter";
  near.log_p = std::log(2e-6);
  d.checks = {near};
  EXPECT_TRUE(
      says(text_of(d, {"hall", "a.csv"}), "nothing was found beyond doubt; room clutter came near (p = 2e-06)"));
  d.other_scatter = {3.5, 4.5, 5.5};
  EXPECT_STREQ(d.verdict(), "unexplained");
  EXPECT_TRUE(
      says(text_of(d, {"hall", "a.csv"}), "is not adequate: readings scatter by 3.5 dB, where the world says 4.5"));
}

// With the channel's law at its physical bound no cause is certain, whatever its gain.
TEST(Gate, NothingIsSureBesideALawAtItsBound) {
  CauseEstimate c = wall(inference::Status::named, inference::HeldOutGain{3.5, 2.5, 6, 2.4, 11, 21});
  c.doubt = "at its bound: radio.multiwall/n";
  Diagnosis d = with(c);
  d.world_values = {{"radio.multiwall/n", "", 0, 0.05, true}, {"radio.multiwall/l0", "dB", 12, 1, false}};
  EXPECT_EQ(confidence_of(c), Confidence::unconfirmed);
  const std::string text = text_of(d, {"hall", "a.csv"});
  EXPECT_TRUE(says(text, "seems wrong: one cause is named, but the fit ends at a bound")) << text;
  EXPECT_TRUE(says(text, "suspected: effect.unmapped_wall")) << text;
  EXPECT_TRUE(says(text, "doubt       at its bound: radio.multiwall/n")) << text;
  EXPECT_TRUE(says(text, "0.00 +- 0.10  (at its bound)")) << text;
  EXPECT_FALSE(says(text, "includes 0")) << text;
  const auto json = nlohmann::json::parse(json_of(d).dump());
  EXPECT_EQ(json["causes"][0]["confirmed"], false);
  EXPECT_EQ(json["causes"][0]["doubt"], c.doubt);
  EXPECT_EQ(json["world_parameters"][0]["at_bound"], true);
  EXPECT_EQ(json["world_parameters"][1]["at_bound"], false);
  EXPECT_TRUE(says(page_of(d, {"hall", "a.csv", {}}, {}), "Doubt: at its bound: radio.multiwall/n."));
}

TEST(Text, SaysWhatItCountsIn) {
  const Diagnosis d = with(wall(inference::Status::named, inference::HeldOutGain{3.5, 2.5, 6, 2.4, 11, 21}));
  for (const std::string& text : {text_of(d, {"hall", "a.csv"}), page_of(d, {"hall", "a.csv", {}}, {})})
    for (const char* word : {"95 % and +-:", "Nats:", "Lambda:", "D:", "docs/how-to/read_a_report.md"})
      EXPECT_TRUE(says(text, word)) << word << "\n" << text;
}

TEST(Page, IsValidWhereTablesHaveNoHeadAndPicturesAreInside) {
  Diagnosis d = with(wall(inference::Status::named, inference::HeldOutGain{3.5, 2.5, 6, 2.4, 11, 21}));
  const Picture picture{"residual_map", {}};
  const std::string page = page_of(d, {"hall", "a.csv", {}}, {picture});
  EXPECT_TRUE(says(page, "<figure>\n<svg")) << page;
  EXPECT_FALSE(says(page, "<?xml")) << page;
  EXPECT_FALSE(says(page, "<th></th>")) << page;
}

// A name is not capitalised, a sentence is.
TEST(Page, DoesNotRenameARadio) {
  CauseEstimate c = wall(inference::Status::named, {});
  const auto title = [&] { return page_of(with(c), {"hall", "a.csv", {}}, {}); };
  EXPECT_TRUE(says(title(), "</span>A wall that is not on the map"));
  c.title = "{radio} has a notch";
  c.row = "rover";
  EXPECT_TRUE(says(title(), "</span>rover has a notch"));
}

TEST(Text, WrapsAtAHundredLetters) {
  const std::string long_one(60, 'a'), text = wrapped(long_one + " " + long_one + " b", 2, 4);
  EXPECT_EQ(text, "  " + long_one + "\n    " + long_one + " b\n");
}

TEST(Text, ReasonsAreGathered) {
  Diagnosis d;
  d.not_tested = {"effect.step: no t", "effect.height: one height", "effect.drift: no t"};
  EXPECT_EQ(reasons_not_tested(d), (std::vector<std::string>{"step, drift: no t", "height: one height"}));
}

TEST(Interruption, IsToldInTheHeadline) {
  Diagnosis empty;
  empty.interrupted = true;
  empty.unstated_field = {3, 2, 1};  // what was not found yet may be the field's cause
  EXPECT_STREQ(empty.verdict(), "interrupted");
  EXPECT_TRUE(says(verdict_in_words(empty), "is not judged"));
  Diagnosis found = with(wall(inference::Status::named, inference::HeldOutGain{3.5, 2.5, 6, 2.4, 11, 21}));
  EXPECT_FALSE(says(verdict_in_words(found), "interrupted"));
  found.interrupted = true;
  EXPECT_STREQ(found.verdict(), "extended");
  EXPECT_TRUE(says(verdict_in_words(found), "the search was interrupted"));
  EXPECT_EQ(nlohmann::json::parse(json_of(found).dump()).at("interrupted"), true);
}

TEST(OneStation, RangeAndSecondPlaceAreInAllThreeReports) {
  CauseEstimate cause = wall(inference::Status::named, inference::HeldOutGain{3.5, 2.5, 6, 2.4, 11, 21});
  const auto written = [](const Diagnosis& d) { return nlohmann::json::parse(json_of(d).dump()).at("causes").at(0); };
  EXPECT_TRUE(written(with(cause)).at("one_station").is_null());
  cause.one_station = diagnosis::OneStation{"base", 2.14, 7.38, Eigen::Vector2d(4, 6.5)};
  const Diagnosis d = with(cause);
  const std::string range = "2.1 to 7.4 m from base";
  EXPECT_TRUE(says(one_station_in_words(*cause.one_station), range));
  EXPECT_TRUE(says(one_station_in_words(*cause.one_station), "a second station at (4.0, 6.5)"));
  EXPECT_TRUE(says(text_of(d, {"hall", "a.csv"}), "only base sees it"));
  EXPECT_TRUE(says(page_of(d, {"hall", "a.csv"}, {}), range));
  EXPECT_EQ(written(d).at("one_station").at("farthest_m"), 7.38);
}

}  // namespace
}  // namespace muster::report
