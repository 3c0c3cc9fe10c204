// Causes in a world with which others are judged again, by their declaration.
#include "diagnosis/pipeline/first_cause.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

namespace muster::diagnosis {
namespace {

TEST(FirstCause, IsDeclaredByAFlag) {
  muster_cause cause{};
  cause.size = sizeof cause;
  cause.kind = MUSTER_WORLD_EDIT;
  EXPECT_FALSE(goes_first(cause));
  cause.kind = MUSTER_TERM;
  cause.flags = MUSTER_FIRST;
  EXPECT_TRUE(goes_first(cause));
}

// A plugin that was built before causes had flags.
TEST(FirstCause, IsDeclaredByItsKindInAShorterStruct) {
  muster_cause cause{};
  cause.size = offsetof(muster_cause, flags);
  cause.flags = MUSTER_FIRST;  // what lies behind it in memory
  cause.kind = MUSTER_TERM;
  EXPECT_FALSE(goes_first(cause));
  for (const uint32_t kind : {MUSTER_WORLD_EDIT, MUSTER_INSTRUMENT}) {
    cause.kind = kind;
    EXPECT_TRUE(goes_first(cause));
  }
}

// Bursts imitate a change in time: they go first only beside one.
TEST(FirstCause, ABlockageGoesFirstOnlyBesideAChangeInTime) {
  muster_cause meaning{};
  meaning.size = sizeof meaning;
  meaning.kind = MUSTER_LAW;
  meaning.flags = MUSTER_FIRST;
  const muster_burst burst{sizeof(muster_burst), "one", "other", "loss", "share", "duration"};
  muster_plugin plugin{};
  plugin.cause = &meaning;
  plugin.burst = &burst;
  const std::vector<Cause> causes{{"cause.crowd", nullptr, &plugin}};
  Diagnosis found;
  found.causes.resize(2);
  found.causes[0].id = "cause.crowd";
  found.causes[1].id = "cause.other";
  found.causes[1].covariates = {"map"};
  EXPECT_EQ(first_in_company(found, causes).found, nullptr);
  found.causes[1].covariates = {"time"};
  EXPECT_EQ(first_in_company(found, causes).found, &found.causes[0]);
  EXPECT_TRUE(first_in_company(found, causes).blockage);
}

// Exchanged names hid an antenna: lambda 23 beside them, 346 in the world with the names put right.
TEST(FirstCause, AloneItGoesFirstWhereSomethingElseComesNear) {
  muster_cause meaning{};
  meaning.size = sizeof meaning;
  meaning.flags = MUSTER_FIRST;
  muster_plugin plugin{};
  plugin.cause = &meaning;
  const std::vector<Cause> causes{{"cause.names", nullptr, &plugin}};
  Diagnosis found;
  found.causes.resize(1);
  found.causes[0].id = "cause.names";
  found.checks = {{"cause.antenna", "all", inference::Kind::named, 23, std::log(0.01)}};
  EXPECT_EQ(first_in_company(found, causes).found, nullptr);
  found.checks[0].log_p = std::log(1e-5);
  EXPECT_EQ(first_in_company(found, causes).found, &found.causes[0]);
}

TEST(FirstCause, IsInDoubtBesideWhatItCanBeMistakenFor) {
  muster_cause meaning{};
  meaning.size = sizeof meaning;
  meaning.flags = MUSTER_FIRST;
  meaning.imitators = "cause.offset cause.antenna";
  muster_plugin plugin{};
  plugin.cause = &meaning;
  const std::vector<Cause> causes{{"cause.swap", nullptr, &plugin}};
  CauseEstimate swap;
  swap.id = "cause.swap";
  inference::Check antenna;
  antenna.id = "cause.antenna";
  antenna.log_p = std::log(2e-4);
  EXPECT_EQ(doubt_by_imitator(swap, {antenna}, causes),
            "antenna comes near beside it (p = 0.0002): more than one may do the same");
  antenna.log_p = std::log(0.01);
  EXPECT_EQ(doubt_by_imitator(swap, {antenna}, causes), "");
  antenna.log_p = std::log(2e-4);
  antenna.id = "cause.wall";
  EXPECT_EQ(doubt_by_imitator(swap, {antenna}, causes), "");
}

}  // namespace
}  // namespace muster::diagnosis
