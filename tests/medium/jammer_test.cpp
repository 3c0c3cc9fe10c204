// A jammer's schedule, and the part of its power in a receiver's band.
#include "medium/jammer.hpp"

#include <gtest/gtest.h>

namespace muster::medium {
namespace {

// Against a check at each nanosecond, before and after the phase.
TEST(Pulses, AreOnForTheFirstPartOfEachPeriod) {
  for (const Pulses p : {Pulses{7, 3, 0}, Pulses{10, 1, 4}, Pulses{5, 4, -12}, Pulses{6, 6, 2}}) {
    const auto is_on = [&](Time at) { return ((at - p.phase) % p.period + p.period) % p.period < p.on; };
    for (Time from = -40; from < 40; ++from) {
      Time on = 0;
      for (Time until = from; until < 40; ++until) {
        EXPECT_EQ(p.on_between(from, until), on);
        on += is_on(until);
      }
      Time next = from + 1;
      while (p.on < p.period && is_on(next) == is_on(next - 1)) ++next;
      EXPECT_EQ(p.next_switch(from), p.on < p.period ? next : never);
    }
  }
}

TEST(Share, IsTheCommonPartOfTheSpectrum) {
  const Band receiver{100, 110};
  EXPECT_EQ(share_of({100, 110}, receiver), 1);
  EXPECT_EQ(share_of({104, 106}, receiver), 1);
  EXPECT_EQ(share_of({90, 130}, receiver), 0.25);
  EXPECT_EQ(share_of({105, 125}, receiver), 0.25);
  EXPECT_EQ(share_of({110, 120}, receiver), 0);
  EXPECT_EQ(share_of({90, 100}, receiver), 0);
  // A carrier alone lies in one of two neighbours.
  EXPECT_EQ(share_of({110, 110}, receiver), 0);
  EXPECT_EQ(share_of({100, 100}, receiver), 1);
}

}  // namespace
}  // namespace muster::medium
