// Low-discrepancy points in a cube, by the additive recurrence of the generalised golden ratios (Roberts 2018). Under a
// random shift each point alone is uniform, so an average over them keeps its expectation and has less variance.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace muster {

// Point i of the sequence that starts at `shift`; both in [0, 1).
template <std::size_t dimensions>
std::array<double, dimensions> even_point(std::size_t i, std::array<double, dimensions> shift) {
  static const double ratio = [] {  // the root of x^(d + 1) = x + 1: 1.3247 in the plane, 1.2207 in space
    double root = 1;
    for (int round = 0; round < 64; ++round) root = std::pow(1 + root, 1.0 / (dimensions + 1));
    return root;
  }();
  double step = 1;
  for (double& x : shift) {
    step /= ratio;
    x += static_cast<double>(i) * step;
    x -= std::floor(x);
  }
  return shift;
}

}  // namespace muster
