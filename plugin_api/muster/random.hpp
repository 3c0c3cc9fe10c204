// Counter-based random numbers: a pure function of (world seed, declared stream, row names, tick or place). No order,
// thread count, instance name or neighbour changes them, so two backends under comparison draw the same numbers.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace muster {

// Philox4x32-10: Salmon, Moraes, Dror, Shaw, Parallel Random Numbers: As Easy as 1, 2, 3 (SC 2011).
inline std::array<uint32_t, 4> philox(std::array<uint32_t, 4> counter, std::array<uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const uint64_t a = uint64_t{0xD2511F53u} * counter[0];
    const uint64_t b = uint64_t{0xCD9E8D57u} * counter[2];
    counter = {static_cast<uint32_t>(b >> 32) ^ counter[1] ^ key[0], static_cast<uint32_t>(b),
               static_cast<uint32_t>(a >> 32) ^ counter[3] ^ key[1], static_cast<uint32_t>(a)};
    key[0] += 0x9E3779B9u;
    key[1] += 0xBB67AE85u;
  }
  return counter;
}

// The finaliser of SplitMix64 (Steele, Lea, Flood 2014): a bijection of 64 bits that spreads every input bit.
constexpr uint64_t mixed(uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// Keys combine in order: combined(a, b) differs from combined(b, a).
constexpr uint64_t combined(uint64_t a, uint64_t b) { return mixed(a ^ mixed(b + 0x632be59bd9b4e019u)); }

// FNV-1a, then mixed: the key of a name.
constexpr uint64_t key_of(std::string_view name) {
  uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return mixed(hash);
}

// The draws of one key, numbered by two indices, for example (row key, tick).
class Stream {
 public:
  explicit Stream(uint64_t key = 0) : key_(key) {}

  // The stream of one row, link or place within this one.
  Stream of(uint64_t key) const { return Stream(combined(key_, key)); }

  // Uniform on (0, 1), never 0: 53 bits, centred.
  double uniform(uint64_t i, uint64_t j = 0) const { return unit(bits(i, j), 0); }

  // Standard normal, by Box and Muller (1958).
  double normal(uint64_t i, uint64_t j = 0) const {
    const auto word = bits(i, j);
    return std::sqrt(-2.0 * std::log(unit(word, 0))) * std::cos(6.283185307179586 * unit(word, 2));
  }

  // Exponential, of mean 1.
  double exponential(uint64_t i, uint64_t j = 0) const { return -std::log(uniform(i, j)); }

 private:
  std::array<uint32_t, 4> bits(uint64_t i, uint64_t j) const {
    return philox({static_cast<uint32_t>(i), static_cast<uint32_t>(i >> 32), static_cast<uint32_t>(j),
                   static_cast<uint32_t>(j >> 32)},
                  {static_cast<uint32_t>(key_), static_cast<uint32_t>(key_ >> 32)});
  }
  static double unit(const std::array<uint32_t, 4>& word, std::size_t at) {
    const uint64_t both = (uint64_t{word[at]} << 32) | word[at + 1];
    return (static_cast<double>(both >> 11) + 0.5) * 0x1p-53;
  }

  uint64_t key_;
};

}  // namespace muster
