// A robot passes each place once: what is found there may as well have happened then.
#include "diagnosis/pipeline/time_or_place.hpp"

#include <gtest/gtest.h>

namespace muster::diagnosis {
namespace {

CauseCandidate candidate(const char* id, bool in_time, const char* pieces) {
  CauseCandidate result;
  result.candidate.id = id;
  result.candidate.role.time_like = in_time;
  result.candidate.role.pieces = pieces;
  return result;
}

// Of its alternatives only a place that imitates it counts: another time does not, nor a place that readings tell
// apart.
TEST(TimeOrPlace, ATimeIsInDoubtBesideAPlaceThatDoesAsWell) {
  const CauseCandidate step = candidate("effect.step", true, ""), drift = candidate("effect.drift", true, ""),
                       wall = candidate("effect.unmapped_wall", false, "wall"),
                       thing = candidate("effect.obstacle", false, "thing");
  const std::vector<CauseCandidate> all{step, drift, wall, thing};
  const inference::Alternative of_drift{"effect.drift", "radio/a", {}, 1, 2, 1},
      of_wall{"effect.unmapped_wall", "(3.8, 25.8) to (4.5, 31)", {}, 11, 4, 1},
      of_thing{"effect.obstacle", "(4.8, 30.1)", {}, 2, 18, 1};
  EXPECT_EQ(doubt_by_place(step, {of_drift, of_thing}, all), "");
  EXPECT_EQ(doubt_by_place(step, {of_drift, of_wall, of_thing}, all),
            "time is one with place in these readings, and by them alone unmapped_wall (3.8, 25.8) to (4.5, 31) would "
            "do as well");
  EXPECT_EQ(doubt_by_place(thing, {of_wall}, all), "");
}

}  // namespace
}  // namespace muster::diagnosis
