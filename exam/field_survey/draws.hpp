// Random numbers of the field generator; they share nothing with the other generator's.
#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace muster::exam::survey {

// PCG32 (O'Neill 2014). The purpose selects the stream, so that a further draw for one purpose changes no other.
class Draws {
 public:
  Draws(std::uint64_t seed, std::string_view purpose) {
    std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
    for (const char c : purpose) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    increment_ = (hash << 1) | 1;
    next();
    state_ += seed ^ (hash >> 7);
    next();
  }

  std::uint32_t next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005u + increment_;
    const auto mixed = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27),
               turn = static_cast<std::uint32_t>(old >> 59);
    return (mixed >> turn) | (mixed << ((32 - turn) & 31));
  }
  std::uint64_t next64() {
    const std::uint64_t high = next();
    return high << 32 | next();
  }
  // Uniform in (0, 1).
  double unit() { return (next() + 0.5) * 0x1p-32; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  // Uniform in the logarithm.
  double log_between(double low, double high) { return low * std::pow(high / low, unit()); }
  // A whole number from low to high, both included.
  int whole(int low, int high) { return low + static_cast<int>(unit() * (high - low + 1)); }
  bool flip(double share = 0.5) { return unit() < share; }
  double sign() { return flip() ? 1 : -1; }
  template <class T>
  const T& one_of(const std::vector<T>& from) {
    return from[static_cast<std::size_t>(whole(0, static_cast<int>(from.size()) - 1))];
  }
  template <class T>
  void shuffle(std::vector<T>& list) {
    for (std::size_t i = list.size(); i > 1; --i)
      std::swap(list[i - 1], list[static_cast<std::size_t>(whole(0, static_cast<int>(i) - 1))]);
  }
  // Standard normal (Marsaglia's polar method).
  double gauss() {
    for (;;) {
      const double u = between(-1, 1), v = between(-1, 1), s = u * u + v * v;
      if (s > 0 && s < 1) return u * std::sqrt(-2 * std::log(s) / s);
    }
  }

 private:
  std::uint64_t state_ = 0, increment_ = 1;
};

}  // namespace muster::exam::survey
