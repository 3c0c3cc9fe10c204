// Built once for each instruction set, as MUSTER_KERNEL. Everything here but the kernel itself is internal.
//
// Dependent sums stall the pipeline. So each computed value is subtracted at once from all that need it, and four
// derivatives are computed side by side.
#include "diagnosis/inference/noise/row_kernel.hpp"

#include "diagnosis/inference/noise/packs.hpp"
#include "diagnosis/inference/noise/pairs_kernel.hpp"

#define MUSTER_ALWAYS __attribute__((always_inline))
#define MUSTER_TEXT_OF(name) #name
#define MUSTER_TEXT(name) MUSTER_TEXT_OF(name)

namespace muster::noise {
namespace {

using Lanes = Pack<double, lanes>;
static_assert(sizeof(Lanes) == alignment);

using FourFloats = float __attribute__((vector_size(4 * sizeof(float)), aligned(alignof(float)), may_alias));
using TwoDoubles = double __attribute__((vector_size(2 * sizeof(double)), aligned(alignof(double)), may_alias));

MUSTER_INLINE Lanes* lanes_of(double* values) { return reinterpret_cast<Lanes*>(values); }
MUSTER_INLINE const Lanes* lanes_of(const double* values) { return reinterpret_cast<const Lanes*>(values); }

MUSTER_INLINE Lanes inverse_root(const Lanes& variance) {
  Lanes result;
  for (int lane = 0; lane < lanes; ++lane) result.set(lane, 1 / __builtin_sqrt(variance[lane]));
  return result;
}

// x, but no more than the root of `square`. A stated correlation is not exactly that of a field, and its error may
// exceed what is left of a row's variance; what others cannot predict, its nugget and the floor, is left in any case.
MUSTER_INLINE Lanes at_most_root(Lanes x, const Lanes& square) {
  for (int lane = 0; lane < lanes; ++lane) {
    if (x[lane] * x[lane] <= square[lane]) continue;
    const double most = square[lane] > 0 ? __builtin_sqrt(square[lane]) : 0;
    x.set(lane, __builtin_copysign(__builtin_fmin(__builtin_fabs(x[lane]), most), x[lane]));
  }
  return x;
}

MUSTER_INLINE Lanes looked_up(const double* table, const std::uint16_t* entries) {
  Lanes result;
  for (int lane = 0; lane < lanes; ++lane) result.set(lane, table[entries[lane]]);
  return result;
}

// Table values of a pair of slots: by place, and by place and anchor jointly.
struct Looked {
  Lanes near, joint;
};

MUSTER_INLINE Looked looked_up(const Neighbourhoods& n, const double* table, long pair) {
  const Lanes near = looked_up(table, n.near + pair * lanes);
  if (n.kinds[pair] == Joint::same) return {near, near};
  if (n.kinds[pair] == Joint::uncorrelated) return {near, Lanes{}};
  return {near, looked_up(table, n.joint + pair * lanes)};
}

MUSTER_INLINE Lanes covariance(const Neighbourhoods& n, long pair) {
  const Looked c = looked_up(n, n.correlation, pair);
  return n.near_variance * c.near + n.joint_variance * c.joint;
}

// A row of the factor: solves for its first `count` entries, whose own rows are in `root`. `left`: what they leave of
// the row's variance, of which they never explain the `least`.
MUSTER_INLINE void solve_bounded(Lanes* row, long count, const Lanes* root, long slots, Lanes& left,
                                 const Lanes& least) {
  for (long k = 0; k < count; ++k) {
    const Lanes x = at_most_root(row[k] * root[k * slots + k], left - least);
    row[k] = x;
    left -= x * x;
    for (long b = k + 1; b < count; ++b) row[b] -= x * root[b * slots + k];
  }
}

// The same without the bound, two entries at once; false if it would have been needed somewhere.
MUSTER_INLINE bool solve(Lanes* row, long count, const Lanes* root, long slots, Lanes& left, const Lanes& least) {
  Lanes::Within within = Lanes::everywhere();
  const auto solved = [&](long k) MUSTER_ALWAYS {
    const Lanes x = row[k] * root[k * slots + k], square = x * x;
    within &= at_most(square, left - least);
    left -= square;
    row[k] = x;
    return x;
  };
  long k = 0;
  for (; k + 1 < count; k += 2) {
    const Lanes* below = root + (k + 1) * slots + k;
    const Lanes x = solved(k);
    row[k + 1] -= x * below[0];
    const Lanes y = solved(k + 1);
    for (long b = k + 2; b < count; ++b) {
      below += slots;
      row[b] = row[b] - x * below[0] - y * below[1];
    }
  }
  if (k < count) solved(k);
  return within.all();
}

// Covariances of a slot, or with all slots of the row itself, with the `count` slots before it.
MUSTER_INLINE void look_up_row(const Neighbourhoods& n, long slot, Lanes* row) {
  const long pairs = slot * (slot + 1) / 2;
  for (long b = 0; b < slot; ++b) row[b] = covariance(n, pairs + b);
}
MUSTER_INLINE void look_up_own(const Neighbourhoods& n, Lanes* row) {
  for (long a = 0; a < n.slots; ++a) row[a] = covariance(n, a * (a + 1) / 2 + a);
}

void factorise(const Neighbourhoods& n) {
  const long slots = n.slots;
  Lanes *const root = lanes_of(n.root), *const cross = lanes_of(n.cross), *const combination = lanes_of(n.combination);
  const Lanes *const nugget = lanes_of(n.nugget), *const present = lanes_of(n.present);
  const Lanes* const field = lanes_of(n.field);
  for (long a = 0; a < slots; ++a) {
    Lanes* const row = root + a * slots;
    const Lanes own = present[a] * (field[a] + n.floor_variance - 1) + 1 + nugget[a];
    const Lanes least = nugget[a] + n.floor_variance;
    Lanes left = own;
    look_up_row(n, a, row);
    if (!solve(row, a, root, slots, left, least)) {
      left = own;
      look_up_row(n, a, row);
      solve_bounded(row, a, root, slots, left, least);
    }
    row[a] = inverse_root(left);
  }
  const Lanes least = nugget[slots] + n.floor_variance, own = nugget[slots] + (field[slots] + n.floor_variance);
  Lanes variance = own;
  look_up_own(n, cross);
  if (!solve(cross, slots, root, slots, variance, least)) {
    variance = own;
    look_up_own(n, cross);
    solve_bounded(cross, slots, root, slots, variance, least);
  }
  const Lanes inverse_sd = inverse_root(variance);
  combination[slots] = inverse_sd;
  for (long a = 0; a < slots; ++a) combination[a] = -cross[a] * inverse_sd;
  long a = slots - 1;
  for (; a >= 1; a -= 2) {  // two rows at once
    const Lanes *const row = root + a * slots, *const next = row - slots;
    const Lanes x = combination[a] * row[a];
    combination[a] = x;
    const Lanes y = (combination[a - 1] - row[a - 1] * x) * next[a - 1];
    combination[a - 1] = y;
    for (long b = 0; b < a - 1; ++b) combination[b] = combination[b] - row[b] * x - next[b] * y;
  }
  if (a == 0) combination[0] *= root[0];
}

struct Four {
  Lanes of[parameters];
};

MUSTER_INLINE Four loaded(double* const* from, long a) {
  return {{lanes_of(from[0])[a], lanes_of(from[1])[a], lanes_of(from[2])[a], lanes_of(from[3])[a]}};
}
MUSTER_INLINE void store(const Four& values, double* const* to, long a) {
  for (int p = 0; p < parameters; ++p) lanes_of(to[p])[a] = values.of[p];
}
MUSTER_INLINE void take(Four& from, Lanes weight, double* const* values, long a) {
  for (int p = 0; p < parameters; ++p) from.of[p] -= weight * lanes_of(values[p])[a];
}

// Products of dC with the combination, for the derivatives by distance (1) and share (3). The latter is zero on the
// diagonal.
void turn(const Neighbourhoods& n) {
  const long slots = n.slots;
  const Lanes* const combination = lanes_of(n.combination);
  Lanes *const by_distance = lanes_of(n.turned[1]), *const by_share = lanes_of(n.turned[3]);
  for (long a = 0; a <= slots; ++a) {
    by_distance[a] = lanes_of(n.field_slope)[a] * combination[a];
    by_share[a] = Lanes{};
  }
  for (long a = 0; a < slots; ++a) {
    Lanes distance = by_distance[a], share = by_share[a];
    const Lanes own = combination[a];
    for (long b = 0; b <= a; ++b) {
      const long other = b < a ? b : slots, pair = a * (a + 1) / 2 + b;
      const Looked slope = looked_up(n, n.by_distance, pair), value = looked_up(n, n.correlation, pair);
      const Lanes d = n.near_slope * slope.near + n.joint_slope * slope.joint;
      const Lanes s = n.share_slope * (value.near - value.joint);
      distance += d * combination[other];
      share += s * combination[other];
      by_distance[other] += d * own;
      by_share[other] += s * own;
    }
    by_distance[a] = distance;
    by_share[a] = share;
  }
}

void differentiate(const Neighbourhoods& n) {
  const long slots = n.slots;
  const Lanes *const root = lanes_of(n.root), *const cross = lanes_of(n.cross), *const nugget = lanes_of(n.nugget);
  const Lanes* const combination = lanes_of(n.combination);
  const Lanes inverse_sd = combination[slots];
  turn(n);
  // C = field + nugget + floor, and L^-1 C L^-T e = e: the field's part (0) is e less the others.
  for (long a = 0; a <= slots; ++a) {
    lanes_of(n.turned[0])[a] = -n.floor_variance * combination[a];
    lanes_of(n.turned[2])[a] = nugget[a] * combination[a];
  }
  Four last = loaded(n.turned, slots);
  for (long a = 0; a < slots; ++a) {
    Four x = loaded(n.turned, a);
    for (long k = 0; k < a; ++k) take(x, root[a * slots + k], n.turned, k);
    for (int p = 0; p < parameters; ++p) {
      x.of[p] *= root[a * slots + a];
      last.of[p] -= cross[a] * x.of[p];
    }
    store(x, n.turned, a);
  }
  for (Lanes& x : last.of) x *= inverse_sd;
  last.of[0] += 1;
  store(last, n.turned, slots);
  for (long a = 0; a <= slots; ++a) lanes_of(n.turned[0])[a] -= lanes_of(n.turned[2])[a];
  // The combination's derivative: minus L^-T times that, with its last entry halved.
  last = loaded(n.turned, slots);
  for (Lanes& x : last.of) x = -0.5 * x * inverse_sd;
  store(last, n.slope, slots);
  for (long a = slots - 1; a >= 0; --a) {
    Four x = loaded(n.turned, a);
    for (int p = 0; p < parameters; ++p) x.of[p] = -x.of[p] - cross[a] * last.of[p];
    for (long k = a + 1; k < slots; ++k) take(x, root[k * slots + a], n.slope, k);
    for (Lanes& of_one : x.of) of_one *= root[a * slots + a];
    store(x, n.slope, a);
  }
  for (int p = 0; p < parameters; ++p) {
    for (int q = 0; q <= p; ++q) {
      const Lanes *const one = lanes_of(n.turned[p]), *const other = lanes_of(n.turned[q]);
      Lanes sum = 0.5 * one[slots] * other[slots];
      for (long a = 0; a < slots; ++a) sum += one[a] * other[a];
      lanes_of(n.information)[p * parameters + q] = sum;
    }
  }
}

template <class Vector, int parts>
struct Tile {};

// Combines one row, at columns that fill `parts` vectors.
template <class Vector, int parts, class Scalar>
MUSTER_INLINE void combine_tile(Tile<Vector, parts>, const Combinations& c, long i, const Scalar* x, long columns,
                                Scalar* out) {
  constexpr long width = sizeof(Vector) / sizeof(Scalar);
  Vector sum[parts];
  const auto own = static_cast<Scalar>(c.own[i]);
  for (int k = 0; k < parts; ++k) sum[k] = own * *reinterpret_cast<const Vector*>(x + i * columns + k * width);
  for (long a = i * c.slots; a < (i + 1) * c.slots; ++a) {
    if (c.neighbours[a] < 0) continue;
    const auto weight = static_cast<Scalar>(c.beside[a]);
    const Scalar* const other = x + c.neighbours[a] * columns;
    for (int k = 0; k < parts; ++k) sum[k] += weight * *reinterpret_cast<const Vector*>(other + k * width);
  }
  for (int k = 0; k < parts; ++k) *reinterpret_cast<Vector*>(out + i * columns + k * width) = sum[k];
}

// Calls use(vector's type, their number, column) for vectors that fill `columns`, wide ones first.
template <class Wide, class Narrow, class Scalar, class Use>
MUSTER_INLINE void in_tiles(long columns, const Use& use) {
  constexpr long wide = sizeof(Wide) / sizeof(Scalar), narrow = sizeof(Narrow) / sizeof(Scalar);
  long k = 0;
  for (; k + 2 * wide <= columns; k += 2 * wide) use(Tile<Wide, 2>{}, k);
  for (; k + wide <= columns; k += wide) use(Tile<Wide, 1>{}, k);
  for (; k + narrow <= columns; k += narrow) use(Tile<Narrow, 1>{}, k);
  for (; k < columns; ++k) use(Tile<Scalar, 1>{}, k);
}

// Works in blocks of columns whose rows fit in the cache together.
template <class Wide, class Narrow, class Scalar>
MUSTER_INLINE void combine_all(const Combinations& c, const Scalar* x, long columns, Scalar* out) {
  constexpr long block = 512 / sizeof(Scalar);
  for (long first = 0; first < columns; first += block) {
    const long width = columns - first < block ? columns - first : block;
    for (long i = 0; i < c.rows; ++i) {
      in_tiles<Wide, Narrow, Scalar>(width, [&](auto tile, long k) MUSTER_ALWAYS {
        combine_tile(tile, c, i, x + first + k, columns, out + first + k);
      });
    }
  }
}

void combine(const Combinations& c, const double* x, long columns, double* out) {
  combine_all<Lanes, TwoDoubles>(c, x, columns, out);
}

void combine_floats(const Combinations& c, const float* x, long columns, float* out) {
  combine_all<Floats, FourFloats>(c, x, columns, out);
}

// Vectors of the products x_j with_i, summed over the columns.
MUSTER_INLINE Lanes products(const double* x, const double* with, long columns) {
  const auto *const one = reinterpret_cast<const Lanes*>(x), *const other = reinterpret_cast<const Lanes*>(with);
  Lanes sum = one[0] * other[0];
  for (long k = 1; k < columns / lanes; ++k) sum += one[k] * other[k];
  return sum;
}

void contract(const Combinations* four, const double* x, const double* with, long columns, double* sums) {
  const Combinations& c = four[0];
  Lanes sum[parameters] = {};
  for (long i = 0; i < c.rows; ++i) {
    const Lanes own = products(x + i * columns, with + i * columns, columns);
    for (int p = 0; p < parameters; ++p) sum[p] += four[p].own[i] * own;
    for (long a = i * c.slots; a < (i + 1) * c.slots; ++a) {
      if (c.neighbours[a] < 0) continue;
      const Lanes beside = products(x + c.neighbours[a] * columns, with + i * columns, columns);
      for (int p = 0; p < parameters; ++p) sum[p] += four[p].beside[a] * beside;
    }
  }
  for (int p = 0; p < parameters; ++p) {
    sums[p] = 0;
    for (int lane = 0; lane < lanes; ++lane) sums[p] += sum[p][lane];
  }
}

template <class Vector, int parts>
MUSTER_INLINE void take_out_of(Tile<Vector, parts>, const float* q, long rows, long width, float* x, long columns,
                               float* scratch) {
  auto* const explained = reinterpret_cast<Vector*>(scratch);
  for (long k = 0; k < width * parts; ++k) explained[k] = Vector{};
  for (long i = 0; i < rows; ++i) {
    const auto* const from = reinterpret_cast<const Vector*>(x + i * columns);
    for (long d = 0; d < width; ++d) {
      for (int k = 0; k < parts; ++k) explained[d * parts + k] += q[i * width + d] * from[k];
    }
  }
  for (long i = 0; i < rows; ++i) {
    auto* const to = reinterpret_cast<Vector*>(x + i * columns);
    Vector left[parts];
    for (int k = 0; k < parts; ++k) left[k] = to[k];
    for (long d = 0; d < width; ++d) {
      for (int k = 0; k < parts; ++k) left[k] -= q[i * width + d] * explained[d * parts + k];
    }
    for (int k = 0; k < parts; ++k) to[k] = left[k];
  }
}

void take_out(const float* q, long rows, long width, float* x, long columns, float* scratch) {
  in_tiles<Floats, FourFloats, float>(
      columns, [&](auto tile, long k) MUSTER_ALWAYS { take_out_of(tile, q, rows, width, x + k, columns, scratch); });
}

}  // namespace

extern const RowKernel MUSTER_KERNEL;
const RowKernel MUSTER_KERNEL{MUSTER_TEXT(MUSTER_KERNEL),
                              factorise,
                              differentiate,
                              combine,
                              combine_floats,
                              contract,
                              apart,
                              covariances,
                              take_out};

}  // namespace muster::noise
