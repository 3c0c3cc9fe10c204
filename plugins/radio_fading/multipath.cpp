#include "multipath.hpp"

#include "even_points.hpp"

namespace muster {
namespace {

constexpr double highest = 0.17;  // sine of the steepest elevation, 10 degrees

void set_wave(waves::PlaneWaves<waves::fading_waves>& waves, int m, double turn, double height, double phase) {
  constexpr double full_turn = 6.283185307179586;
  const double up = highest * (2 * height - 1), along = std::sqrt(1 - up * up);
  waves.x[m] = along * std::cos(full_turn * turn), waves.y[m] = along * std::sin(full_turn * turn), waves.z[m] = up;
  waves.phase[m] = phase;
}

}  // namespace

Multipath::Multipath(const Stream& random) {
  const std::array<double, 4> shift{random.uniform(0, 1), random.uniform(1, 1), random.uniform(2, 1),
                                    random.uniform(3, 1)};
  for (int m = 0; m < waves::fading_waves; ++m) {
    const auto [a, b, up_a, up_b] = even_point(static_cast<std::size_t>(m), shift);
    set_wave(waves_.leaving, m, a, up_a, random.uniform(static_cast<uint64_t>(m)));
    set_wave(waves_.arriving, m, b, up_b, 0);
  }
}

std::vector<Multipath::Tile> Multipath::at(const std::vector<FieldPoint>& places,
                                           const waves::WaveKernel& kernel) const {
  return tiles<Tile>(places, [&](Tile& each) { kernel.fading_at(waves_, each); });
}

std::complex<double> Multipath::between(const FieldPoint& p, const FieldPoint& q) const {
  double re[waves::tile], im[waves::tile];
  const auto both = at({p, q});
  waves::best_wave_kernel().fading(both[0], 0, both[0], 2, re, im);
  return {re[1], im[1]};
}

}  // namespace muster
