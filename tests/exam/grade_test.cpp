// The grader's arithmetic, on reports written by hand.
#include "exam/grading/grade.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace muster::exam {
namespace {

Truth one(const std::string& id, double lambda) {
  return {"case_0001", "one", {{id, {"radio/beacon2"}, {}, {}, {{"offset", 4}}, lambda}}, 10};
}

Verdict said(const std::string& json) { return read_verdict("some text before\n" + json + "\nand after\n"); }

Share share(const Grades& g, const std::string& name) {
  const auto at = g.shares.find(name);
  return at == g.shares.end() ? Share{} : at->second;
}

TEST(Grade, IntervalsAreThoseOfClopperAndPearson) {
  EXPECT_NEAR((Share{0, 10}).upper95(), 0.3085, 1e-4);
  EXPECT_EQ((Share{0, 10}).lower95(), 0);
  EXPECT_NEAR((Share{5, 10}).lower95(), 0.1871, 1e-4);
  EXPECT_NEAR((Share{5, 10}).upper95(), 0.8129, 1e-4);
  EXPECT_NEAR((Share{80, 80}).lower95(), 0.9549, 1e-4);
  EXPECT_NEAR((Share{2, 309}).upper95(), 0.0232, 1e-4);
}

const char* const right_report =
    R"({"verdict":"extended","base":{"heldout_rmse_db":5},"heldout_rmse_db":4,"causes":[)"
    R"({"id":"tx_offset","label":"endpoint/beacon2","status":"named","evidence":20,"parameters":[{"name":"tx_offset/offset","value":4.4,"lower95":3.5,"upper95":5.3}]},)"
    R"({"id":"drift","label":"","status":"suspected","evidence":2,"parameters":[]}],"unexplained":[],"loop":{"rediagnosis":"silent"}})";

TEST(Grade, FewestHitsThatChanceLeaves) {
  EXPECT_EQ(least_hits(3, 0.95), 1);  // none of three: 0.05^3 = 1.25e-4; at most one: 0.00725
  EXPECT_EQ(least_hits(40, 0.99), 37);
  EXPECT_EQ(least_hits(1000, 0.993), 984);
  EXPECT_EQ(least_hits(5, 1), 5);
  EXPECT_EQ(least_hits(0, 0.5), 0);
}

TEST(Grade, AHeadlineOfTwoNamesIsRightByClass) {
  const auto hits = [](const char* row, const char* in_headline) {
    const Verdict verdict =
        said(std::string(R"({"verdict":"extended","causes":[{"id":"effect.step","label":"radio/)") + row +
             R"(","evidence":20,"rivals":[{"id":"effect.drift","in_headline":)" + in_headline + "}]}]}");
    Grades g;
    add(g, one("drift", 60), verdict);
    EXPECT_EQ(share(g, "one / top name right / lambda >= 50").hits, 0);
    return share(g, "one / top name right, by class / lambda >= 50").hits;
  };
  EXPECT_EQ(hits("beacon2", "true"), 1);
  EXPECT_EQ(hits("beacon2", "false"), 0);
  EXPECT_EQ(hits("beacon3", "true"), 0);
}

TEST(Grade, AnAdvisedRunSettlesANameWithoutRivals) {
  const auto with = [](double predicted) {
    return said(R"({"verdict":"extended","causes":[{"id":"effect.drift","evidence":20}],"advice":[)"
                R"({"separates":"effect.drift effect.step","predicted_separability":)" +
                fmt::format("{}", predicted) + R"(,"advised":true},)" +
                R"({"separates":"effect.drift effect.step","predicted_separability":null,"advised":false}]})");
  };
  const auto cause = [](const char* id, const char* rivals) {
    return said(std::string(R"({"verdict":"extended","causes":[{"id":")") + id + R"(","rivals":[)" + rivals + "]}]}")
        .named;
  };
  for (const auto& [predicted, after, settled] :
       {std::tuple(30.0, cause("effect.tx_offset", R"({"id":"~link"})"), 1),
        std::tuple(30.0, cause("effect.tx_offset", R"({"id":"effect.drift"})"), 0),
        std::tuple(20.0, cause("effect.tx_offset", ""), 1), std::tuple(30.0, cause("effect.drift", ""), 0)}) {
    Verdict verdict = with(predicted);
    verdict.named_when_followed = after;
    Grades g;
    add(g, one("tx_offset", 60), verdict);
    EXPECT_EQ(share(g, "advice / top name right before / all").hits, 0);
    EXPECT_EQ(share(g, "advice / settles the name / all").hits, settled);
    EXPECT_EQ(share(g, "advice / settles the name / predicted to").of, predicted >= 25);
  }
}

TEST(Grade, ADeafRadioHasAWeakTransmittersClass) {
  for (const auto& [radio, right] : {std::pair("beacon2", 1), std::pair("beacon3", 0)}) {
    Grades g;
    add(g, one("asymmetry", 60),
        said(R"({"verdict":"extended","causes":[{"id":"effect.rx_offset","label":"radio/)" + std::string(radio) +
             R"(","status":"named","evidence":20}]})"));
    EXPECT_EQ(share(g, "one / top name right / lambda >= 50").hits, 0);
    EXPECT_EQ(share(g, "one / top name right, by class / lambda >= 50").hits, right) << radio;
  }
}

TEST(Grade, AnotherNameOfTheSameIsRightAtItsRow) {
  for (const auto& [radio, right] : {std::pair("beacon2", 1), std::pair("beacon3", 0)}) {
    Grades g;
    Truth truth = one("asymmetry", 60);
    truth.effects[0].also = {"rx_offset"};
    add(g, truth,
        said(R"({"verdict":"extended","causes":[{"id":"effect.rx_offset","label":"radio/)" + std::string(radio) +
             R"(","status":"named","evidence":20}]})"));
    EXPECT_EQ(share(g, "one / top name right / lambda >= 50").hits, right) << radio;
    EXPECT_EQ(share(g, "one / found / lambda >= 50").hits, right) << radio;
  }
}

TEST(Grade, CountsWhatIsRight) {
  Grades g;
  add(g, one("tx_offset", 60), said(right_report));
  for (const char* measure : {"found", "top name right", "right row, where found"}) {
    EXPECT_EQ(share(g, std::string("one / ") + measure + " / lambda >= 50").hits, 1) << measure;
    EXPECT_EQ(share(g, std::string("one / ") + measure + " / all").of, 1) << measure;
  }
  EXPECT_EQ(share(g, "one / wrong extra name / all").hits, 0);  // a suspected cause is not named
  EXPECT_DOUBLE_EQ(g.gain.at("lambda >= 50"), 9);
  EXPECT_DOUBLE_EQ(g.oracle.at("lambda >= 50"), 10);
  EXPECT_EQ(g.covered.hits, 1);
  ASSERT_EQ(g.relative_errors.size(), 1u);
  EXPECT_NEAR(g.relative_errors[0], 0.1, 1e-12);
  EXPECT_EQ(share(g, "loop / rediagnosis silent / all").hits, 1);
}

TEST(Grade, OtherReadingsAreHeldAgainstWhatWasToldWhole) {
  Verdict verdict = said(right_report);
  verdict.second_silent = false;
  Grades g;
  add(g, one("tx_offset", 60), verdict);
  add(g, one("step", 60), verdict);  // which was not reported
  EXPECT_EQ(share(g, "loop / second data silent / all").of, 2);
  EXPECT_EQ(share(g, "loop / second data silent / where all was told").of, 1);
  EXPECT_EQ(share(g, "loop / second data silent / where all was told").hits, 0);
}

TEST(Grade, CountsWhatIsWrong) {
  Grades g;
  const char* const wrong =
      R"({"verdict":"extended","causes":[{"id":"antenna_tx","label":"endpoint/beacon2","status":"named","evidence":5}],"unexplained":[]})";
  const char* const extra =
      R"({"verdict":"extended","causes":[{"id":"tx_offset","label":"endpoint/beacon1","status":"named","evidence":5},{"id":"step","label":"","status":"named","evidence":9}],"unexplained":[]})";
  add(g, one("tx_offset", 15), said(wrong));
  add(g, one("tx_offset", 15), said(extra));
  add(g, one("tx_offset", 15), said(R"({"verdict":"adequate","causes":[],"unexplained":[]})"));
  EXPECT_EQ(share(g, "one / found / lambda 10-20").hits, 1);
  EXPECT_EQ(share(g, "one / found / lambda 10-20").of, 3);
  EXPECT_EQ(share(g, "one / top name right / all").hits, 0);
  EXPECT_EQ(share(g, "one / wrong extra name / all").hits, 1);
  EXPECT_EQ(share(g, "one / only wrong names / all").hits, 1);
  EXPECT_EQ(share(g, "one / silent / all").hits, 1);
  EXPECT_EQ(share(g, "one / right row, where found / all").hits, 0);
}

TEST(Grade, SeveralEffectsStandInTheBinOfTheWeakest) {
  Truth truth = one("tx_offset", 820);
  truth.kind = "two";
  truth.effects.push_back({"drift", {}, {}, {}, {}, 12});
  Grades g;
  add(g, truth, said(right_report));
  EXPECT_EQ(share(g, "two / found / lambda 10-20").hits, 0);
  EXPECT_EQ(share(g, "two / at least one found / lambda 10-20").hits, 1);
  EXPECT_EQ(share(g, "two / found / lambda >= 50").of, 0);
  EXPECT_EQ(g.by_effect.at("tx_offset / lambda >= 50").hits, 1);
  EXPECT_EQ(g.by_effect.at("drift / lambda 10-20").hits, 0);

  truth.kind = "three";
  truth.effects[1].lambda = 70;
  truth.effects.push_back({"step", {}, {}, {}, {}, 60});
  add(g, truth, said(right_report));
  EXPECT_EQ(share(g, "three / found / lambda >= 50").hits, 0);
  EXPECT_EQ(share(g, "three / found / lambda >= 50").of, 1);
  EXPECT_NE(as_table(g).find("| three effects all, each lambda >= 50 | 0/1 = 0 %"), std::string::npos) << as_table(g);
}

// One offset is right for an offset of that radio, and for an asymmetry of it: not for both at once.
TEST(Grade, OneNameStandsForOneEffect) {
  Truth truth = one("tx_offset", 80);
  truth.kind = "two";
  truth.effects.push_back({"asymmetry", {"radio/beacon2"}, {}, {}, {}, 90});
  truth.effects[1].also = {"tx_offset"};
  Grades g;
  add(g, truth, said(right_report));
  EXPECT_EQ(share(g, "two / found / lambda >= 50").hits, 0);
  EXPECT_EQ(share(g, "two / found, by class / lambda >= 50").hits, 0);
  EXPECT_EQ(share(g, "two / at least one found / lambda >= 50").hits, 1);
  add(g, truth,
      said(R"({"verdict":"extended","causes":[{"id":"tx_offset","label":"radio/beacon2","status":"named"},)"
           R"({"id":"asymmetry","label":"radio/beacon2","status":"named"}]})"));
  EXPECT_EQ(share(g, "two / found / lambda >= 50").hits, 1);
}

TEST(Grade, CleanWorldsAndTheOutside) {
  Grades g;
  const Truth clean{"c", "clean", {}, 0}, outside{"c", "outside", {{"x", {}, {"speed*logd", "speed"}, {}, {}, 70}}, 0};
  const Verdict smooth =
      said(R"({"verdict":"unexplained","causes":[],"unexplained":[{"covariate":"~LogD*speed[m/s]","evidence":9}]})");
  add(g, clean, said(R"({"verdict":"adequate","causes":[],"unexplained":[]})"));
  add(g, clean, said(right_report));
  add(g, clean, smooth);
  add(g, outside, smooth);
  add(g, outside, said(right_report));
  EXPECT_EQ(share(g, "clean / false name / all").hits, 1);
  EXPECT_EQ(share(g, "clean / false unexplained / all").hits, 1);
  EXPECT_EQ(share(g, "clean / verdict adequate / all").hits, 1);
  EXPECT_EQ(share(g, "outside / right covariate / lambda >= 50").hits, 1);
  EXPECT_EQ(share(g, "outside / right covariate / lambda >= 50").of, 2);
  EXPECT_EQ(share(g, "outside / false name / all").hits, 1);
  Truth mirrored = outside;
  mirrored.effects[0].also = {"tx_offset"};
  add(g, mirrored, said(right_report));
  EXPECT_EQ(share(g, "outside / right covariate / lambda >= 50").hits, 2) << "by a name that is as right";
}

TEST(Grade, WallsAreComparedAsSegments) {
  EXPECT_NEAR(segment_distance({0, 0, 4, 0}, {4, 0, 0, 0}), 0, 1e-9);  // ends have no order
  EXPECT_NEAR(segment_distance({0, 0, 4, 0}, {0, 0.3, 4, 0.3}), 0.3, 1e-9);
  EXPECT_NEAR(segment_distance({0, 0, 4, 0}, {0, 0, 2, 0}), 0.25,
              0.01);  // 2 m of 4 m are 1 m off on average: 0.5 one way, 0 back
  Truth truth{
      "c", "one", {{"unmapped_wall", {}, {}, {}, {{"x0", 0}, {"y0", 0}, {"x1", 4}, {"y1", 0}, {"loss", 8}}, 90}}, 0};
  Grades g;
  add(g, truth,
      said(
          R"({"verdict":"extended","causes":[{"id":"unmapped_wall","label":"","status":"named","evidence":30,"parameters":[{"name":"x0","value":4},{"name":"y0","value":0.2},{"name":"x1","value":0},{"name":"y1","value":0.2},{"name":"loss","value":9.5}]}]})"));
  ASSERT_EQ(g.places.wall.size(), 1u);
  EXPECT_NEAR(g.places.wall[0], 0.2, 1e-9);
  EXPECT_NEAR(g.places.wall_loss.at(0), 1.5, 1e-9);
}

TEST(Grade, DirectionsWrap) {
  Truth truth{"c", "one", {{"antenna_rx", {}, {}, {}, {{"direction", 3.1}}, 90}}, 0};
  Grades g;
  add(g, truth,
      said(
          R"({"verdict":"extended","causes":[{"id":"effect.antenna_rx","status":"named","parameters":[{"name":"direction","value":-3.1,"lower95":-3.3,"upper95":-2.9}]}]})"));
  EXPECT_EQ(g.covered.hits, 1);
  EXPECT_LT(g.relative_errors.at(0), 0.03);
}

// A phase repeats after a turn, the heading of a rectangle after half of one.
TEST(Grade, PhasesAndHeadingsWrap) {
  const auto relative_error = [](const std::string& id, const std::string& name, double truth, double value) {
    Grades g;
    add(g, Truth{"c", "one", {{id, {}, {}, {}, {{name, truth}}, 90}}, 0},
        said(R"({"verdict":"extended","causes":[{"id":"effect.)" + id +
             R"(","status":"named","parameters":[{"name":")" + name + R"(","value":)" + std::to_string(value) +
             "}]}]}"));
    return g.relative_errors.at(0);
  };
  EXPECT_LT(relative_error("periodic", "phase", 3.1, -3.1), 0.03);
  EXPECT_LT(relative_error("room_clutter", "heading", 1.5, -1.6), 0.03);
  EXPECT_GT(relative_error("periodic", "phase", 1.5, -1.6), 1);
}

TEST(Grade, AWallMayBeAnsweredWithoutItsLoss) {
  Grades g;
  add(g, Truth{"c", "one", {{"unmapped_wall", {}, {}, {}, {{"x0", 0}, {"y0", 0}, {"x1", 4}, {"y1", 0}}, 90}}, 0},
      said(
          R"({"verdict":"extended","causes":[{"id":"effect.unmapped_wall","label":"","status":"named","parameters":[{"name":"x0","value":4},{"name":"y0","value":0.2},{"name":"x1","value":0},{"name":"y1","value":0.2},{"name":"loss","value":9.5}]}]})"));
  EXPECT_EQ(g.places.wall.size(), 1u);
  EXPECT_TRUE(g.places.wall_loss.empty());
}

TEST(Grade, ValuesOfAnotherRowAreNotCompared) {
  for (const auto& [radio, compared] : {std::pair("robot1", 1u), std::pair("robot2", 0u)}) {
    Truth truth{"c", "one", {{"rx_offset", {"radio/robot1"}, {}, {}, {{"offset", 1.4}}, 90}}, 0};
    Grades g;
    add(g, truth,
        said(R"({"verdict":"extended","causes":[{"id":"effect.rx_offset","label":"radio/)" + std::string(radio) +
             R"(","status":"named",)" +
             R"("parameters":[{"name":"offset","value":1.5,"lower95":1.2,"upper95":1.8}]}]})"));
    EXPECT_EQ(g.covered.of, compared) << radio;
    EXPECT_EQ(g.relative_errors.size(), compared) << radio;
  }
}

TEST(Grade, TextWithoutAReportIsRefused) { EXPECT_THROW(read_verdict("Segmentation fault"), std::runtime_error); }

}  // namespace
}  // namespace muster::exam
