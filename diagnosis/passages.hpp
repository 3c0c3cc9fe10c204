// Bursts of loss on one link: somebody stands in the way for a while, again and again, at times that nobody knows.
#pragma once

#include "diagnosis/scatter.hpp"

namespace muster::diagnosis {

struct Passages {
  int radio = -1, other = -1;  // numbers of the set `radio`
  LawTest test;
};

// The likeliest link, loss, share and duration. Time is cut into windows of the duration, in each of which somebody may
// stand in the way: the likelihood ratio of that mixture against nobody has mean 1 when nobody does, so that by
// Markov's inequality its inverse bounds the p-value. What the next best link shows is taken off: skewed fading shows
// on all.
Passages passages_of(const search::Bench& bench);

}  // namespace muster::diagnosis
