// Built once for each instruction set, as MUSTER_KERNEL. Everything here but the kernel itself is internal.
#include "block_kernel.hpp"

#define MUSTER_INLINE [[gnu::always_inline]] inline
#define MUSTER_TEXT_OF(name) #name
#define MUSTER_TEXT(name) MUSTER_TEXT_OF(name)

namespace muster::simbody {
namespace {

typedef double Four __attribute__((vector_size(32)));
typedef double Two __attribute__((vector_size(16)));

// A column of N numbers, even ones: fours, and two that may be left over.
template <int N>
struct Column {
  static constexpr int fours = N / 4;
  static constexpr bool has_two = N % 4 == 2;

  MUSTER_INLINE static Column of(const double* p) {
    Column c;
    for (int i = 0; i < fours; ++i) __builtin_memcpy(&c.four[i], p + 4 * i, sizeof(Four));
    if (has_two) __builtin_memcpy(&c.two, p + 4 * fours, sizeof(Two));
    return c;
  }
  MUSTER_INLINE void store(double* p) const {
    for (int i = 0; i < fours; ++i) __builtin_memcpy(p + 4 * i, &four[i], sizeof(Four));
    if (has_two) __builtin_memcpy(p + 4 * fours, &two, sizeof(Two));
  }
  MUSTER_INLINE void scale(double k) {
    for (int i = 0; i < fours; ++i) four[i] *= k;
    if (has_two) two *= k;
  }
  MUSTER_INLINE void add(const Column& b, double k) {
    for (int i = 0; i < fours; ++i) four[i] += b.four[i] * k;
    if (has_two) two += b.two * k;
  }
  MUSTER_INLINE void subtract(const Column& b, double k) {
    for (int i = 0; i < fours; ++i) four[i] -= b.four[i] * k;
    if (has_two) two -= b.two * k;
  }
  Four four[fours];
  Two two;
};

// By twos, since what was just written by other code cannot be read in larger pieces without waiting for memory.
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

  static void add_rows(double* block, int rows, const double* a, const double* b) {
    const C a0 = C::of(a);
    if (rows == 1) {
      for (int j = 0; j < N; ++j) {
        C sum = C::of(block + N * j);
        sum.add(a0, b[j]);
        sum.store(block + N * j);
      }
      return;
    }
    const C a1 = C::of(a + N), a2 = C::of(a + N * (rows - 1));
    const double* last = b + N * (rows - 1);
    for (int j = 0; j < N; ++j) {
      C sum = C::of(block + N * j);
      sum.add(a0, b[j]);
      sum.add(a1, b[N + j]);
      if (rows == 3) sum.add(a2, last[j]);
      sum.store(block + N * j);
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

  // Column by column; the row operations that make L of the block make L^-1 of the unit matrix, kept by its rows.
  static void invert_factor(double* block, double* inverse) {
    for (int k = 0; k < N * N; ++k) inverse[k] = k % (N + 1) == 0;
    for (int k = 0; k < N; ++k) {
      C column = C::of(block + N * k), row = C::of(inverse + N * k);
      const double scale = 1 / __builtin_sqrt(block[(N + 1) * k]);
      column.scale(scale);
      row.scale(scale);
      column.store(block + N * k);
      row.store(inverse + N * k);
      for (int j = k + 1; j < N; ++j) {
        const double factor = block[N * k + j];
        C rest = C::of(block + N * j), to = C::of(inverse + N * j);
        rest.subtract(column, factor);
        to.subtract(row, factor);
        rest.store(block + N * j);
        to.store(inverse + N * j);
      }
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
      copy,     add_rows,         add_speeds,          subtract_rows, invert_factor,   multiply,
      subtract, subtract_product, subtract_transposed, apply,         apply_transposed};
};

}  // namespace

extern const BlockKernel MUSTER_KERNEL;
const BlockKernel MUSTER_KERNEL = {MUSTER_TEXT(MUSTER_KERNEL), Arithmetic<6>::all, Arithmetic<8>::all,
                                   Arithmetic<12>::all};

}  // namespace muster::simbody
