// Random numbers that are equal with every compiler and library, unlike the distributions of <random>.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <vector>

namespace muster::exam {

// SplitMix64 (Steele, Lea, Flood 2014) from a seed and the name of a stream; streams are independent.
class Random {
 public:
  Random(std::uint64_t seed, std::string_view stream) : state_(seed * 0x9E3779B97F4A7C15u) {
    for (const char c : stream) state_ = mixed(state_ ^ static_cast<unsigned char>(c));
  }

  std::uint64_t bits() { return mixed(state_ += 0x9E3779B97F4A7C15u); }
  // Uniform in [0, 1).
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  bool chance(double p) { return uniform() < p; }
  double sign() { return chance(0.5) ? 1 : -1; }
  int below(int n) { return static_cast<int>(uniform() * n); }
  template <class T>
  const T& pick(const std::vector<T>& from) {
    return from[static_cast<std::size_t>(below(static_cast<int>(from.size())))];
  }
  // Standard normal (Box and Muller 1958).
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

}  // namespace muster::exam
