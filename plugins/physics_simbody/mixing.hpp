// Anderson acceleration (Walker and Ni 2011) of a slowly converging iteration u += d(u): the combination of its last
// steps with the least d.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "block_cholesky.hpp"

namespace muster::simbody {

template <int N>
class MixingOf {
 public:
  using Velocities = Blocks<VelocityOf<N>>;

  void begin() { count_ = 0; }
  int count() const { return count_; }  // of steps since begin()

  // `d`: the step at u, replaced by the accelerated one. `weights`: of unknowns, in the norm of steps.
  void mix(const Velocities& u, Velocities& d, const VelocityOf<N>& weights) {
    Past& now = past_[count_ % most];
    const int known = std::min(count_, most);
    solve(known, d, weights);
    mixed_ = d;
    for (int j = 0; j < known; ++j) {
      for (std::size_t b = 0; b < d.size(); ++b) mixed_[b] -= share_[j] * (u[b] - past_[j].u[b] + d[b] - past_[j].d[b]);
    }
    now.u = u;
    now.d = d;
    d = mixed_;
    ++count_;
  }

 private:
  static constexpr int most = 4;
  using Gram = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;
  using Shares = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1>;
  struct Past {
    Velocities u, d;
  };

  // Least squares by their normal equations.
  void solve(int known, const Velocities& d, const VelocityOf<N>& weights) {
    Gram products = Gram::Zero(known, known);
    Shares with_now = Shares::Zero(known);
    for (std::size_t b = 0; b < d.size(); ++b) {
      std::array<VelocityOf<N>, most> change;
      for (int j = 0; j < known; ++j) {
        change[j] = d[b] - past_[j].d[b];
        const VelocityOf<N> weighed = weights.cwiseProduct(change[j]);
        with_now[j] += weighed.dot(d[b]);
        for (int k = 0; k <= j; ++k) products(j, k) += weighed.dot(change[k]);
      }
    }
    products.diagonal() *= 1 + 1e-10;
    share_ = products.template selfadjointView<Eigen::Lower>().ldlt().solve(with_now);
    if (!share_.allFinite()) share_.setZero();
  }

  std::array<Past, most> past_;
  Velocities mixed_;
  Shares share_;
  int count_ = 0;
};

}  // namespace muster::simbody
