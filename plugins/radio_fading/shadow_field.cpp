#include "shadow_field.hpp"

#include "even_points.hpp"

namespace muster {
namespace {

constexpr double full_turn = 6.283185307179586;

// The inverse of the spectrum's distribution function. exp(-r) has in space the spectral density 1 / (1 + k^2)^2, so
// with k = tan(a) the share of waves below k is (2 a - sin 2 a) / pi.
double wave_number(double share) {
  double low = 0, high = full_turn / 4;
  for (int round = 0; round < 60; ++round) {
    const double middle = (low + high) / 2;
    (2 * middle - std::sin(2 * middle) < full_turn / 2 * share ? low : high) = middle;
  }
  return std::tan((low + high) / 2);
}

}  // namespace

ShadowField::ShadowField(const Stream& random) {
  const std::array<double, 3> shift{random.uniform(0, 1), random.uniform(1, 1), random.uniform(2, 1)};
  for (int m = 0; m < waves::shadow_waves; ++m) {
    const auto [size, height, turn] = even_point(static_cast<std::size_t>(m), shift);
    const double number = wave_number(size), up = 2 * height - 1, along = std::sqrt(1 - up * up);
    waves_.x[m] = number * along * std::cos(full_turn * turn) / full_turn;
    waves_.y[m] = number * along * std::sin(full_turn * turn) / full_turn;
    waves_.z[m] = number * up / full_turn;
    waves_.phase[m] = random.uniform(static_cast<uint64_t>(m));
  }
}

std::vector<ShadowField::Tile> ShadowField::at(const std::vector<FieldPoint>& places,
                                               const waves::WaveKernel& kernel) const {
  return tiles<Tile>(places, [&](Tile& each) { kernel.shadow_at(waves_, each); });
}

double ShadowField::between(const FieldPoint& p, const FieldPoint& q) const {
  double all[waves::tile];
  const auto both = at({p, q});
  between(both[0], 0, both[0], 2, 1, all);
  return all[1];
}

}  // namespace muster
