// The Rician law of small-scale fading: a steady part and a diffuse one, K times weaker, with mean power one (Rice
// 1948).
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>

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

// K from which a reading varies by less than 0.09 dB: it is taken for steady.
constexpr double steady_k_db = 40;

// Log density per dB of 10 log10 of the mean power of n fades, each of mean 1: a noncentral chi-square with 2 n degrees
// of freedom. Of a steady reading: none, an atom at 0 dB.
inline double rician_log_density(double k_db, uint32_t n, double db) {
  constexpr double pi = 3.141592653589793;
  if (k_db >= steady_k_db) return -std::numeric_limits<double>::infinity();
  const double k = std::max(std::pow(10, k_db / 10), 1e-4), g = std::pow(10, db / 10), count = n;
  const double x = 2 * count * std::sqrt(k * (1 + k) * g);
  const double order = count - 1;
  const double bessel = x < 300 ? std::log(std::max(std::cyl_bessel_i(order, x), 1e-300))
                                : x - 0.5 * std::log(2 * pi * x) - (4 * order * order - 1) / (8 * x);
  return std::log(count * (1 + k)) + order / 2 * std::log((1 + k) * g / k) - count * (k + (1 + k) * g) + bessel +
         std::log(g * std::log(10.0) / 10);
}

inline double rician_typical_db(double k_db) { return 10 * std::log10(rician_typical_gain(rician_ratio(k_db))); }

}  // namespace muster
