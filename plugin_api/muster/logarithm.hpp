// Logarithms of many numbers at once, the same bits on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <muster/widest.hpp>

namespace muster {

struct Log10 {
  // x = 2^e m with m from sqrt(1/2) to sqrt(2), and ln m = 2 artanh s with s = (m - 1) / (m + 1), whose series is cut
  // after s^19.
  [[gnu::always_inline]] static double of(double x) {
    constexpr std::uint64_t exponent = 0x7ff0000000000000, half = 0x3fe6a09e667f3bcd, one = 0x3ff0000000000000;
    std::uint64_t bits;
    __builtin_memcpy(&bits, &x, sizeof bits);
    const std::uint64_t above = bits - half + one;  // its exponent is e, biased
    const std::uint64_t reduced = bits - (above & exponent) + one, whole = 0x4330000000000000 | above >> 52;
    double m, e;
    __builtin_memcpy(&m, &reduced, sizeof m);
    __builtin_memcpy(&e, &whole, sizeof e);
    e -= 0x1p52 + 1023;
    const double s = (m - 1) / (m + 1), t = s * s;
    double series = 1.0 / 19;
    series = series * t + 1.0 / 17;
    series = series * t + 1.0 / 15;
    series = series * t + 1.0 / 13;
    series = series * t + 1.0 / 11;
    series = series * t + 1.0 / 9;
    series = series * t + 1.0 / 7;
    series = series * t + 1.0 / 5;
    series = series * t + 1.0 / 3;
    return e * 0.30102999566398120 + (s + s * (t * series)) * 0.86858896380650366;
  }

  [[gnu::always_inline]] static void run(double* x, std::size_t number) {
    for (std::size_t i = 0; i < number; ++i) x[i] = of(x[i]);
  }
};

// Replaces positive normal numbers by their log10: within 4e-16 of it, or of 1 where it is smaller. Zero gives -308.
inline void log10_of_all(double* x, std::size_t number) { Widest<Log10, double*, std::size_t>::run(x, number); }

}  // namespace muster
