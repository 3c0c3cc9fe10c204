// The Rician law of small-scale fading: a steady part and a diffuse one, K times weaker, with mean power one (Rice
// 1948).
#pragma once

#include <cmath>
#include <complex>

namespace muster {

// K as a ratio of powers. From -40 dB down it is 0: Rayleigh fading exactly.
inline double rician_ratio(double k_db) { return k_db > -40 ? std::pow(10, k_db / 10) : 0; }

// Power gain from the diffuse part (complex normal of mean power 1) and the steady part's phase in radians.
inline double rician_gain(double k, std::complex<double> diffuse, double phase) {
  const double steady = std::sqrt(k / (k + 1)), scale = std::sqrt(1 / (k + 1));
  const double re = steady * std::cos(phase) + scale * diffuse.real();
  const double im = steady * std::sin(phase) + scale * diffuse.imag();
  return re * re + im * im;
}

// exp(E[ln gain]): the gain whose dB is the mean of the fading's dB. E[ln gain] = ln(K / (K + 1)) + E1(K), from the
// mean logarithm of the noncentral chi-square (Lapidoth and Moser 2003); for K = 0 it is minus Euler's constant, -2.507
// dB.
inline double rician_typical_gain(double k) {
  constexpr double euler = 0.5772156649015329;
  if (k <= 0) return std::exp(-euler);
  const double tail = k < 700 ? -std::expint(-k) : 0;  // E1(K); beyond, below the smallest double
  return k / (k + 1) * std::exp(tail);
}

}  // namespace muster
