// Built once for each instruction set, as MUSTER_KERNEL. Everything here but the kernel itself is internal.
//
// Phases are reduced in double, exact to 1e-9 for a kilometre of short waves. Sums are float: gains within 1e-5,
// shadowing within 1e-5 of a standard deviation for each decorrelation distance of places from the origin.
#include "plugins/radio_fading/wave_kernel.hpp"

#include <experimental/simd>

#define MUSTER_INLINE [[gnu::always_inline]] inline
#define MUSTER_TEXT_OF(name) #name
#define MUSTER_TEXT(name) MUSTER_TEXT_OF(name)

namespace muster::waves {
namespace {

namespace stdx = std::experimental;
using Floats = stdx::native_simd<float>;
using Mask = Floats::mask_type;
constexpr int lanes = static_cast<int>(Floats::size());
static_assert(tile % lanes == 0 && sizeof(Floats) <= alignof(ShadowTile));

MUSTER_INLINE Floats load(const float* from) { return Floats(from, stdx::vector_aligned); }

struct Turned {
  double cosine, sine;
};

// Sine and cosine of a number of turns, within 2e-10: by Taylor's series of half the angle, which is within a quarter
// turn.
MUSTER_INLINE Turned turned(double turns) {
  constexpr double to_nearest = 0x1.8p52;
  const double a = 3.141592653589793 * (turns - ((turns + to_nearest) - to_nearest)), b = a * a;
  double sine = -1.0 / 1307674368000, cosine = -1.0 / 87178291200;
  sine = sine * b + 1.0 / 6227020800;
  sine = sine * b - 1.0 / 39916800;
  sine = sine * b + 1.0 / 362880;
  sine = sine * b - 1.0 / 5040;
  sine = sine * b + 1.0 / 120;
  sine = sine * b - 1.0 / 6;
  sine = (sine * b + 1) * a;
  cosine = cosine * b + 1.0 / 479001600;
  cosine = cosine * b - 1.0 / 3628800;
  cosine = cosine * b + 1.0 / 40320;
  cosine = cosine * b - 1.0 / 720;
  cosine = cosine * b + 1.0 / 24;
  cosine = cosine * b - 1.0 / 2;
  cosine = cosine * b + 1;
  return {1 - 2 * sine * sine, 2 * sine * cosine};
}

template <int number>
MUSTER_INLINE double turns_at(const PlaneWaves<number>& waves, int m, const PlaceTile& at, int i) {
  return waves.x[m] * at.x[i] + waves.y[m] * at.y[i] + waves.z[m] * at.z[i] + waves.phase[m];
}

void shadow_at(const PlaneWaves<shadow_waves>& waves, ShadowTile& out) {
  for (int m = 0; m < shadow_waves; ++m) {
    for (int i = 0; i < tile; ++i) {
      const double turns = turns_at(waves, m, out.at, i);
      const Turned half = turned(turns / 2);
      out.along[m][i] = static_cast<float>(6.283185307179586 * (turns - waves.phase[m]));
      out.sine[m][i] = static_cast<float>(2 * half.sine * half.cosine);
      out.half_cosine[m][i] = static_cast<float>(half.cosine);
      out.half_sine[m][i] = static_cast<float>(half.sine);
    }
  }
}

void fading_at(const FadingWaves& waves, FadingTile& out) {
  for (int m = 0; m < fading_waves; ++m) {
    for (int i = 0; i < tile; ++i) {
      const Turned leaving = turned(turns_at(waves.leaving, m, out.at, i));
      const Turned arriving = turned(turns_at(waves.arriving, m, out.at, i));
      out.leaving_re[m][i] = static_cast<float>(leaving.cosine);
      out.leaving_im[m][i] = static_cast<float>(leaving.sine);
      out.arriving_re[m][i] = static_cast<float>(arriving.cosine);
      out.arriving_im[m][i] = static_cast<float>(arriving.sine);
    }
  }
}

MUSTER_INLINE bool is_wanted(unsigned wanted, int first) { return (wanted >> first & ((1u << lanes) - 1)) != 0; }

MUSTER_INLINE double length(const PlaceTile& from, int place, const PlaceTile& to, int i) {
  const double x = to.x[i] - from.x[place], y = to.y[i] - from.y[place], z = to.z[i] - from.z[place];
  return __builtin_sqrt(x * x + y * y + z * z);
}

// Sums quotients over a common denominator: one division serves four waves.
struct Quotient {
  Floats over, under;
};

MUSTER_INLINE Quotient operator+(const Quotient& a, const Quotient& b) {
  return {a.over * b.under + b.over * a.under, a.under * b.under};
}

// A wave's mean along the link: difference of its sines over that of its phases. In reverse both only change sign.
MUSTER_INLINE Quotient mean_along(const ShadowTile& from, int place, const ShadowTile& to, int first, int m) {
  return {load(to.sine[m] + first) - from.sine[m][place], load(to.along[m] + first) - from.along[m][place]};
}

constexpr float slow = 0.015625f;  // below, a difference of phases is small

// The same for a small difference: by the wave's middle and a series.
MUSTER_INLINE void mend_slow(const ShadowTile& from, int place, const ShadowTile& to, int first, int m,
                             Quotient& mean) {
  const Mask is_slow = stdx::abs(mean.under) < slow;
  const Floats middle = load(to.half_cosine[m] + first) * from.half_cosine[m][place] -
                        load(to.half_sine[m] + first) * from.half_sine[m][place];
  const Floats squared = mean.under * mean.under;
  stdx::where(is_slow, mean.over) = middle * (1 - squared * (1 / 24.0f - squared * (1 / 1920.0f)));
  stdx::where(is_slow, mean.under) = 1;
}

MUSTER_INLINE Floats sum_of_four(const ShadowTile& from, int place, const ShadowTile& to, int first, int m) {
  Quotient mean[4];
  for (int i = 0; i < 4; ++i) mean[i] = mean_along(from, place, to, first, m + i);
  const Floats least = stdx::min(stdx::min(stdx::abs(mean[0].under), stdx::abs(mean[1].under)),
                                 stdx::min(stdx::abs(mean[2].under), stdx::abs(mean[3].under)));
  if (__builtin_expect(stdx::any_of(least < slow), false)) {
    for (int i = 0; i < 4; ++i) mend_slow(from, place, to, first, m + i, mean[i]);
  }
  const Quotient four = (mean[0] + mean[1]) + (mean[2] + mean[3]);
  return four.over / four.under;
}

void shadow(const ShadowTile& from, int place, const ShadowTile& to, unsigned wanted, double sd, double* out) {
  for (int first = 0; first < tile; first += lanes) {
    if (!is_wanted(wanted, first)) continue;
    Floats sum = 0;
    for (int m = 0; m < shadow_waves; m += 4) sum += sum_of_four(from, place, to, first, m);
    for (int i = 0; i < lanes; ++i) {
      const double root = __builtin_sqrt(length(from.at, place, to.at, first + i) / shadow_waves);
      out[first + i] = sd * (static_cast<double>(sum[i]) * root);
    }
  }
}

// Through memory, to avoid extracting each number from its vector.
MUSTER_INLINE void put(const Floats& sums, double factor, double* out) {
  alignas(64) float each[lanes];
  sums.copy_to(each, stdx::vector_aligned);
  for (int i = 0; i < lanes; ++i) out[i] = factor * static_cast<double>(each[i]);
}

void fading(const FadingTile& from, int place, const FadingTile& to, unsigned wanted, double* re, double* im) {
  for (int first = 0; first < tile; first += lanes) {
    if (!is_wanted(wanted, first)) continue;
    Floats sum_re = 0, sum_im = 0;
    for (int m = 0; m < fading_waves; ++m) {
      const float a_re = from.leaving_re[m][place], a_im = from.leaving_im[m][place];
      const float d_re = from.arriving_re[m][place], d_im = from.arriving_im[m][place];
      const Floats b_re = load(to.arriving_re[m] + first), b_im = load(to.arriving_im[m] + first);
      const Floats c_re = load(to.leaving_re[m] + first), c_im = load(to.leaving_im[m] + first);
      sum_re += (a_re * b_re - a_im * b_im) + (c_re * d_re - c_im * d_im);
      sum_im += (a_re * b_im + a_im * b_re) + (c_re * d_im + c_im * d_re);
    }
    static_assert(fading_waves == 32, "the root of 0.5 / 32 is 1 / 8");
    put(sum_re, 0.125, re + first);
    put(sum_im, 0.125, im + first);
  }
}

void power(const PlaceTile& from, int place, const PlaceTile& to, double steady, double diffuse, const double* re,
           const double* im, double* out) {
  if (steady == 0) {
    for (int i = 0; i < tile; ++i) out[i] = diffuse * diffuse * (re[i] * re[i] + im[i] * im[i]);
    return;
  }
  for (int i = 0; i < tile; ++i) {
    const Turned phase = turned(-length(from, place, to, i));
    const double all_re = steady * phase.cosine + diffuse * re[i], all_im = steady * phase.sine + diffuse * im[i];
    out[i] = all_re * all_re + all_im * all_im;
  }
}

}  // namespace

extern const WaveKernel MUSTER_KERNEL;
const WaveKernel MUSTER_KERNEL{MUSTER_TEXT(MUSTER_KERNEL), shadow_at, fading_at, shadow, fading, power};

}  // namespace muster::waves
