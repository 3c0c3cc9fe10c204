// Built once for each instruction set, as MUSTER_KERNEL. Everything here but the kernel itself is internal.
#include "block_kernel.hpp"

#include "lane_arithmetic.hpp"

#define MUSTER_INLINE [[gnu::always_inline]] inline
#define MUSTER_TEXT_OF(name) #name
#define MUSTER_TEXT(name) MUSTER_TEXT_OF(name)

namespace muster::simbody {
namespace {

typedef double Eight __attribute__((vector_size(64)));
typedef double Four __attribute__((vector_size(32)));
typedef double Two __attribute__((vector_size(16)));

#ifdef __AVX512F__
constexpr bool has_eights = true;
#else
constexpr bool has_eights = false;
#endif

// A column of N numbers, N even, in as few vectors as the machine needs.
template <int N>
struct Column {
  static constexpr int eights = has_eights && N % 8 == 0 ? N / 8 : 0, fours = (N - 8 * eights) / 4;
  static constexpr bool has_two = N % 4 == 2;

  MUSTER_INLINE static Column of(const double* p) {
    Column c;
    for (int i = 0; i < eights; ++i) __builtin_memcpy(&c.eight[i], p + 8 * i, sizeof(Eight));
    for (int i = 0; i < fours; ++i) __builtin_memcpy(&c.four[i], p + 8 * eights + 4 * i, sizeof(Four));
    if (has_two) __builtin_memcpy(&c.two, p + N - 2, sizeof(Two));
    return c;
  }
  MUSTER_INLINE void store(double* p) const {
    for (int i = 0; i < eights; ++i) __builtin_memcpy(p + 8 * i, &eight[i], sizeof(Eight));
    for (int i = 0; i < fours; ++i) __builtin_memcpy(p + 8 * eights + 4 * i, &four[i], sizeof(Four));
    if (has_two) __builtin_memcpy(p + N - 2, &two, sizeof(Two));
  }
  MUSTER_INLINE double at(int i) const {
    if (i < 8 * eights) return eight[i / 8][i % 8];
    i -= 8 * eights;
    return i < 4 * fours ? four[i / 4][i % 4] : two[i % 2];
  }
  MUSTER_INLINE void scale(double k) {
    for (int i = 0; i < eights; ++i) eight[i] *= k;
    for (int i = 0; i < fours; ++i) four[i] *= k;
    if (has_two) two *= k;
  }
  MUSTER_INLINE void add(const Column& b, double k) {
    for (int i = 0; i < eights; ++i) eight[i] += b.eight[i] * k;
    for (int i = 0; i < fours; ++i) four[i] += b.four[i] * k;
    if (has_two) two += b.two * k;
  }
  MUSTER_INLINE void subtract(const Column& b, double k) {
    for (int i = 0; i < eights; ++i) eight[i] -= b.eight[i] * k;
    for (int i = 0; i < fours; ++i) four[i] -= b.four[i] * k;
    if (has_two) two -= b.two * k;
  }
  MUSTER_INLINE void multiply(const Column& b) {
    for (int i = 0; i < eights; ++i) eight[i] *= b.eight[i];
    for (int i = 0; i < fours; ++i) four[i] *= b.four[i];
    if (has_two) two *= b.two;
  }
  MUSTER_INLINE void add_product(const Column& b, const Column& c) {
    for (int i = 0; i < eights; ++i) eight[i] += b.eight[i] * c.eight[i];
    for (int i = 0; i < fours; ++i) four[i] += b.four[i] * c.four[i];
    if (has_two) two += b.two * c.two;
  }
  // By twos in their order, for any vector length.
  MUSTER_INLINE double sum() const {
    Two sum = {};
    for (int i = 0; i < eights; ++i) {
      const Eight& e = eight[i];
      sum += __builtin_shufflevector(e, e, 0, 1);
      sum += __builtin_shufflevector(e, e, 2, 3);
      sum += __builtin_shufflevector(e, e, 4, 5);
      sum += __builtin_shufflevector(e, e, 6, 7);
    }
    for (int i = 0; i < fours; ++i) {
      const Four& f = four[i];
      sum += __builtin_shufflevector(f, f, 0, 1);
      sum += __builtin_shufflevector(f, f, 2, 3);
    }
    if (has_two) sum += two;
    return sum[0] + sum[1];
  }

  Eight eight[eights > 0 ? eights : 1];
  Four four[fours > 0 ? fours : 1];
  Two two;
};

// By twos: a wider load of data just written in smaller pieces would stall.
template <int N>
MUSTER_INLINE double dot(const double* a, const double* b) {
  Two sum = {};
  for (int i = 0; i < N; i += 2) {
    Two x, y;
    __builtin_memcpy(&x, a + i, sizeof x);
    __builtin_memcpy(&y, b + i, sizeof y);
    sum = i == 0 ? x * y : sum + x * y;
  }
  return sum[0] + sum[1];
}

template <int N>
struct Arithmetic {
  using C = Column<N>;

  static void copy(double* to, const double* from) {
    for (int j = 0; j < N; ++j) C::of(from + N * j).store(to + N * j);
  }

  static void add_contacts(double* block, int count, const double* const* a, const double* const* b, const double* k) {
    double weighed[3 * N * BlockArithmetic<N>::most_contacts];
    for (int i = 0; i < count; ++i) {
      const double* of_k = k + 4 * i;
      C normal = C::of(b[i]), x = C::of(b[i] + N), y = x;
      const C slip_y = C::of(b[i] + 2 * N);
      normal.scale(of_k[0]);
      x.scale(of_k[1]);
      x.add(slip_y, of_k[2]);
      y.scale(of_k[2]);
      y.add(slip_y, of_k[3]);
      normal.store(weighed + 3 * N * i);
      x.store(weighed + 3 * N * i + N);
      y.store(weighed + 3 * N * i + 2 * N);
    }
    constexpr int some = C::eights > 0 ? 8 : N % 4 == 0 ? 4 : 2;  // columns held in registers
    for (int first = 0; first < N; first += some) {
      C sums[some];
      for (int j = 0; j < some; ++j) sums[j] = C::of(block + N * (first + j));
      for (int row = 0; row < 3 * count; ++row) {
        const C of_a = C::of(a[row / 3] + N * (row % 3));
        // NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage): rows are those that were weighed above
        for (int j = 0; j < some; ++j) sums[j].add(of_a, weighed[N * row + first + j]);
      }
      for (int j = 0; j < some; ++j) sums[j].store(block + N * (first + j));
    }
  }

  static void add_speeds(double* sums, const double* a, const double* velocity) {
    for (int row = 0; row < 3; ++row) sums[row] += dot<N>(a + N * row, velocity);
  }
  static void subtract_rows(double* to, const double* a, const double* k) {
    C rest = C::of(to);
    for (int row = 0; row < 3; ++row) rest.subtract(C::of(a + N * row), k[row]);
    rest.store(to);
  }

  static void look_ahead(const ContactTable& table, const double* velocities, ContactLanes* contacts) {
    for (int i = 0; i < table.count; ++i) {
      const int body = table.bodies[2 * i], other = table.bodies[2 * i + 1];
      const double* rows = table.rows + table.stride * i;
      const C own = C::of(velocities + N * body), others = C::of(velocities + N * (other < 0 ? body : other));
      double speeds[3];
      for (int row = 0; row < 3; ++row) {
        C product = C::of(rows + N * row);
        product.multiply(own);
        if (other >= 0) product.add_product(C::of(rows + table.other + N * row), others);
        speeds[row] = product.sum();
      }
      ContactLanes& lanes = contacts[i / ContactLanes::width];
      const int k = i % ContactLanes::width;
      lanes.speed_ahead[k] = speeds[0];
      lanes.slip_ahead[0][k] = speeds[1];
      lanes.slip_ahead[1][k] = speeds[2];
    }
  }
  static void take_impulses(const ContactTable& table, const ContactLanes* contacts, double* momenta) {
    for (int i = 0; i < table.count; ++i) {
      const ContactLanes& lanes = contacts[i / ContactLanes::width];
      const int k = i % ContactLanes::width;
      if (!(lanes.push[k] > 0 || lanes.bound[k] > 0)) continue;
      const double impulses[] = {lanes.push[k], lanes.grip[0][k], lanes.grip[1][k]};
      const int body = table.bodies[2 * i], other = table.bodies[2 * i + 1];
      const double* rows = table.rows + table.stride * i;
      subtract_rows(momenta + N * body, rows, impulses);
      if (other >= 0) subtract_rows(momenta + N * other, rows + table.other, impulses);
    }
  }

  // Cholesky factorisation by columns. The row operations that reduce the block to D L^T, L with ones on its diagonal,
  // turn the unit matrix into L^-1, kept by rows. These are finally divided by the square roots of D, so no step waits
  // for a square root.
  static void invert_factor(const double* block, double* inverse) {
    C rest[N], rows[N];
#pragma GCC unroll 8
    for (int j = 0; j < N; ++j) {
      double unit[N] = {};
      unit[j] = 1;
      rest[j] = C::of(block + N * j);
      rows[j] = C::of(unit);
    }
#pragma GCC unroll 8
    for (int k = 0; k < N; ++k) {
      const double pivot = rest[k].at(k);
      C factors = rest[k];
      factors.scale(1 / pivot);
#pragma GCC unroll 8
      for (int j = k + 1; j < N; ++j) {
        const double by = factors.at(j);
        rest[j].subtract(rest[k], by);
        rows[j].subtract(rows[k], by);
      }
      rows[k].scale(1 / __builtin_sqrt(pivot));
      rows[k].store(inverse + N * k);
    }
  }

  static void multiply(double* a, const double* u) {
    for (int j = N - 1; j >= 0; --j) {
      C sum = C::of(a + N * j);
      sum.scale(u[(N + 1) * j]);
      for (int k = 0; k < j; ++k) sum.add(C::of(a + N * k), u[N * j + k]);
      sum.store(a + N * j);
    }
  }

  static void subtract(double* to, const double* a, const double* b) {
    for (int j = 0; j < N; ++j) {
      C rest = C::of(to + N * j);
      for (int k = 0; k < N; ++k) rest.subtract(C::of(a + N * k), b[N * k + j]);
      rest.store(to + N * j);
    }
  }

  static void subtract_product(double* to, const double* a, const double* x) {
    C rest = C::of(to);
    for (int k = 0; k < N; ++k) rest.subtract(C::of(a + N * k), x[k]);
    rest.store(to);
  }
  static void subtract_transposed(double* to, const double* a, const double* x) {
    for (int k = 0; k < N; ++k) to[k] -= dot<N>(a + N * k, x);
  }

  static void apply(double* x, const double* a) {
    C sum = C::of(a);
    sum.scale(x[0]);
    for (int k = 1; k < N; ++k) sum.add(C::of(a + N * k), x[k]);
    sum.store(x);
  }
  static void apply_transposed(double* x, const double* a) {
    double result[N];
    for (int k = 0; k < N; ++k) result[k] = dot<N>(a + N * k, x);
    for (int k = 0; k < N; ++k) x[k] = result[k];
  }

  static constexpr BlockArithmetic<N> all = {
      copy,     add_contacts, add_speeds,       subtract_rows,       look_ahead, take_impulses,   invert_factor,
      multiply, subtract,     subtract_product, subtract_transposed, apply,      apply_transposed};
};

}  // namespace

extern const BlockKernel MUSTER_KERNEL;
const BlockKernel MUSTER_KERNEL = {MUSTER_TEXT(MUSTER_KERNEL), Arithmetic<6>::all, Arithmetic<8>::all,
                                   Arithmetic<12>::all, Lanes::all};

}  // namespace muster::simbody
