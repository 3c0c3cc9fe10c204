// Sums of plane waves between many radios, several lanes at a time: the part built for each instruction set. All
// kernels give the same bits: a lane is a link, whose waves are summed in one order, and no product is fused.
//
// Only plain data cross this border: the linker could replace a function that both sides compile by its newest form.
#pragma once

namespace muster::waves {

constexpr int tile = 16;  // places processed side by side
constexpr int shadow_waves = 64, fading_waves = 32;

struct alignas(64) PlaceTile {
  double x[tile], y[tile], z[tile];
};

// Turns per unit of length, and turns at the origin.
template <int number>
struct PlaneWaves {
  double x[number], y[number], z[number], phase[number];
};

// Each wave at each place: its phase in radians, without that at the origin; the sine of its phase; and the sine and
// cosine of half the phase.
struct alignas(64) ShadowTile {
  PlaceTile at;
  float along[shadow_waves][tile], sine[shadow_waves][tile], half_cosine[shadow_waves][tile],
      half_sine[shadow_waves][tile];
};

struct FadingWaves {
  PlaneWaves<fading_waves> leaving, arriving;
};

// Each wave's phasor at each place.
struct alignas(64) FadingTile {
  PlaceTile at;
  float leaving_re[fading_waves][tile], leaving_im[fading_waves][tile];
  float arriving_re[fading_waves][tile], arriving_im[fading_waves][tile];
};

// `wanted` has a bit for each place of the tile `to`: the results of the others are undefined.
struct WaveKernel {
  const char* name;
  // Fill a tile from its places.
  void (*shadow_at)(const PlaneWaves<shadow_waves>&, ShadowTile&);
  void (*fading_at)(const FadingWaves&, FadingTile&);
  // From place number `place` of one tile to all of another: the sum of the waves' line integrals over the root of the
  // length, over that of the number of waves, times `sd`.
  void (*shadow)(const ShadowTile& from, int place, const ShadowTile& to, unsigned wanted, double sd, double* out);
  // The same for the complex gain, of mean power 1.
  void (*fading)(const FadingTile& from, int place, const FadingTile& to, unsigned wanted, double* re, double* im);
  // |steady exp(-2 pi i length) + diffuse (re + i im)|^2, lengths in the unit of the places.
  void (*power)(const PlaceTile& from, int place, const PlaceTile& to, double steady, double diffuse, const double* re,
                const double* im, double* out);
};

// The kernels that this machine can run, the widest last. There is at least one.
struct WaveKernels {
  const WaveKernel* all[3];
  int number = 0;
};
const WaveKernels& wave_kernels();
inline const WaveKernel& best_wave_kernel() { return *wave_kernels().all[wave_kernels().number - 1]; }

}  // namespace muster::waves
