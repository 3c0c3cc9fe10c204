// A search that is ended early returns what it knows, and says that it was ended.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "diagnosis/pipeline/closed_loop.hpp"
#include "diagnosis/pipeline/diagnose.hpp"
#include "diagnosis/report/regression.hpp"
#include "tests/diagnosis/pipeline/flat.hpp"

namespace muster::diagnosis {
namespace {

class Interrupted : public testing::Test {
 protected:
  // Ends the search once it has said `last`.
  Diagnosis until(const std::string& last) {
    bool stop = false;
    inference::Watch watch;
    watch.told = [&](const std::string& now) {
      said.push_back(now);
      stop = stop || now.find(last) != now.npos;
    };
    watch.stopped = [&] { return stop; };
    return diagnose(given, measured, plugins, std::make_shared<TableCache>(), watch);
  }

  // s2 sends a hundredth of what the world says.
  const std::string fading = "rician_k=\"6\" per_reading=\"true\"";
  const Scratch truth, scratch;
  const std::filesystem::path measured =
      drawn_by(truth, flat(truth, 3, fading, "<effect.tx_offset radio=\"s2\" offset=\"-20\"/>"));
  const std::filesystem::path given = flat(scratch, 3, fading);
  std::vector<std::string> said;
};

TEST_F(Interrupted, NothingIsClaimedBeforeTheSearch) {
  const Diagnosis found = until("fitting the world");
  EXPECT_TRUE(found.interrupted);
  EXPECT_STREQ(found.verdict(), "interrupted");
  EXPECT_TRUE(found.causes.empty());
  ASSERT_FALSE(found.notes.empty());
  EXPECT_NE(found.notes.back().find("interrupted"), std::string::npos);
}

TEST_F(Interrupted, WhatWasFoundIsReported) {
  const Diagnosis found = until("1 found so far");
  EXPECT_TRUE(found.interrupted);
  EXPECT_STREQ(found.verdict(), "extended");
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_EQ(found.causes[0].row, "s2");
  EXPECT_TRUE(found.held_out.has_value());
}

TEST_F(Interrupted, AWholeSearchSaysNothingOfIt) {
  const Diagnosis found = until("never");
  EXPECT_FALSE(found.interrupted);
  EXPECT_EQ(named_causes(found).size(), 1u);
  EXPECT_GT(said.size(), 5u);
}

TEST_F(Interrupted, NoTestIsWrittenOfWhatWasNotLookedAt) {
  EXPECT_TRUE(report::write_regression(until("fitting the world"), given, measured, scratch / "out").empty());
  EXPECT_FALSE(std::filesystem::exists(scratch / "out/regression.json"));
}

TEST_F(Interrupted, ALoopThatIsEndedClaimsNothing) {
  const Diagnosis found = until("never");
  inference::Watch watch;
  watch.stopped = [] { return true; };
  EXPECT_FALSE(closed_loop(found, given, measured, scratch / "extended", plugins, watch));
  EXPECT_TRUE(std::filesystem::exists(scratch / "extended/world.xml"));
}

}  // namespace
}  // namespace muster::diagnosis
