// Distances and covariances of pairs of rows, in single precision. Internal to row_kernel.cpp.
#pragma once

#include "diagnosis/inference/noise/packs.hpp"
#include "diagnosis/inference/noise/row_kernel.hpp"

namespace muster::noise {
namespace {

using Floats = Pack<float, many>;

MUSTER_INLINE Floats many_of(const float* values, long first) {
  return *reinterpret_cast<const Floats*>(values + first);
}

// Squared distances of a row from those that start at `first`. Readings lie the given numbers of stretches away from
// their middles.
MUSTER_INLINE Floats squares(const Ends& ends, long row, long first, float own_stretches, float stretches) {
  Floats sum{};
  for (int axis = 0; axis < 3; ++axis) {
    const float own = ends.middle[axis][row] + own_stretches * ends.stretch[axis][row];
    const Floats along = many_of(ends.middle[axis], first) + stretches * many_of(ends.stretch[axis], first) - own;
    sum += along * along;
  }
  return sum;
}

MUSTER_INLINE Floats root(Floats squares) {
  for (Floats::Part& part : squares.part) {
    for (int k = 0; k < Floats::each; ++k) part[k] = __builtin_sqrtf(part[k]);
  }
  return squares;
}

MUSTER_INLINE void cut_at_zero(Floats& values) {
  for (Floats::Part& part : values.part) part = part > 0 ? part : Floats::Part{};
}

struct Distances {
  Floats place, both;
};

MUSTER_INLINE Distances between_middles(const Places& p, long row, long first) {
  const Floats place = squares(p.place, row, first, 0, 0);
  const Floats apart = root(place);
  return {apart, p.anchors_move ? root(place + squares(p.anchor, row, first, 0, 0)) : apart};
}

MUSTER_INLINE Distances between_readings(const Places& p, long row, long first) {
  Distances mean{};
  for (int own = -1; own <= 1; ++own) {
    for (int other = -1; other <= 1; ++other) {
      const auto a = static_cast<float>(own), b = static_cast<float>(other);
      const Floats place = squares(p.place, row, first, a, b);
      mean.place += root(place) / 9;
      if (p.anchors_move) mean.both += root(place + squares(p.anchor, row, first, a, b)) / 9;
    }
  }
  return p.anchors_move ? mean : Distances{mean.place, mean.place};
}

MUSTER_INLINE Distances distances_of(const Places& p, long row, long first) {
  const Distances middles = between_middles(p, row, first);
  if (!p.within_place) return middles;
  bool near = false;
  for (int k = 0; k < many; ++k) near |= middles.place[k] < p.far;
  Distances result = near ? between_readings(p, row, first) : middles;
  result.place -= many_of(p.within_place, first) + p.within_place[row];
  result.both -= many_of(p.within_both, first) + p.within_both[row];
  cut_at_zero(result.place);
  cut_at_zero(result.both);
  return result;
}

MUSTER_INLINE void write(const Floats& values, float* out) { *reinterpret_cast<Floats*>(out) = values; }

inline void apart(const Places& p, long row, float* place, float* both) {
  for (long first = 0; first < row; first += many) {
    const Distances of = distances_of(p, row, first);
    write(of.place, place + first);
    write(of.both, both + first);
  }
}

using TwiceAsWide = double __attribute__((vector_size(2 * register_bytes), aligned(alignof(double)), may_alias));
using Ints = int __attribute__((vector_size(register_bytes), aligned(alignof(int)), may_alias));

MUSTER_INLINE Floats correlations(const Pairs& p, Floats apart) {
  for (Floats::Part& part : apart.part) {
    const Ints entries = __builtin_convertvector(part * p.entries_per_metre + 0.5f, Ints);
    for (int k = 0; k < Floats::each; ++k) part[k] = p.correlation[entries[k]];
  }
  return apart;
}

inline void covariances(const Pairs& p, long row, double* out) {
  for (long first = 0; first < row; first += many) {
    const Distances apart = distances_of(p.at, row, first);
    const Floats near = correlations(p, apart.place);
    const Floats joint = p.at.anchors_move ? correlations(p, apart.both) : near;
    for (int k = 0; k < Floats::parts; ++k) {
      const long from = first + k * Floats::each;
      const Ints same = *reinterpret_cast<const Ints*>(p.group + from) == p.group[row];
      const Floats::Part of_group = same ? p.joint * joint.part[k] : Floats::Part{};
      const Floats::Part sum = p.everywhere * near.part[k] + of_group;
      *reinterpret_cast<TwiceAsWide*>(out + from) = __builtin_convertvector(sum, TwiceAsWide);
    }
  }
}

}  // namespace
}  // namespace muster::noise
