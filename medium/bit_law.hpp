// Bit error rate, tabulated over the ratio of signal to noise and interference.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace muster::medium {

// A closed form costs many exponentials at each receiver of each interval of a frame. 128 points an octave, linear
// between: within 1e-4 of a bit error rate that changes by a factor of e in a dB.
class BitLaw {
 public:
  // `error_rate`: of a bit, 0 to 0.5, falling as the ratio rises.
  template <class ErrorRate>
  explicit BitLaw(ErrorRate error_rate) {
    for (std::size_t i = 0; i < log_right_.size(); ++i) log_right_[i] = std::log1p(-error_rate(ratio_at(i)));
    while (first_clean_ > 0 && log_right_[first_clean_ - 1] > -1e-18) --first_clean_;
  }

  // The ratio from which the bit error rate is below 1e-18.
  double clean() const { return ratio_at(first_clean_); }

  // ln of the probability that a bit is right; 0 beyond 36 dB.
  double log_right(double ratio) const {
    if (!(ratio > least)) return log_right_.front();
    if (ratio >= most) return 0;
    std::uint64_t bits;
    std::memcpy(&bits, &ratio, sizeof bits);
    const std::size_t i = static_cast<std::size_t>((bits >> shift) - first());
    const double share =
        static_cast<double>(bits & ((std::uint64_t{1} << shift) - 1)) * (1.0 / (std::uint64_t{1} << shift));
    return log_right_[i] + share * (log_right_[i + 1] - log_right_[i]);
  }

 private:
  // The upper bits of a double count octaves and their 128 parts, so points lie between powers of two.
  static constexpr double least = 0x1p-8, most = 0x1p12;
  static constexpr int shift = 52 - 7;
  static std::uint64_t first() { return (std::uint64_t{1023 - 8} << 52) >> shift; }
  static double ratio_at(std::size_t i) {
    const std::uint64_t bits = (first() + i) << shift;
    double ratio;
    std::memcpy(&ratio, &bits, sizeof ratio);
    return ratio;
  }

  std::array<double, 20 * 128 + 1> log_right_;
  std::size_t first_clean_ = log_right_.size() - 1;
};

}  // namespace muster::medium
