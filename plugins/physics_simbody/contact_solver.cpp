#include "contact_solver.hpp"

#include <algorithm>
#include <cmath>

namespace muster::simbody {

namespace {

using Eigen::Vector2d;

// Softness of friction and motors: creep below a micrometre a second at this project's loads. [m/s per N s], [rad/s per
// N m s]
constexpr double grip_softness = 1e-6;
constexpr double motor_softness = 1e-4;
constexpr double tolerance = 1e-7;  // of the residual as a velocity [m/s]
constexpr double bound_tolerance = 1e-3;
constexpr int outer_passes = 12, first_newton = 4, later_newton = 2, last_newton = 50;
constexpr double turn_arm = 0.1, rim = 0.05;  // [m]: rates as speeds, in the residual only

// A contact at some velocity, its friction bound by `bound`.
struct Local {
  double speed;                      // normal
  Vector2d slip;                     // tangential
  double bound = 0;                  // [N s]
  Vector2d dual = Vector2d::Zero();  // estimate of the grip, kept beside the velocity for a better Hessian
  bool sticks(double s) const { return s <= grip_softness * bound; }
};

Vector2d within(const Vector2d& v, double radius) {
  const double size = v.norm();
  return size > radius ? Vector2d((radius / size) * v) : v;
}

class Solver {
 public:
  explicit Solver(Problem& problem) : p_(problem), local_(problem.contacts.size()) {}

  Outcome run() {
    Outcome outcome;
    if (stick_all()) {
      outcome.direct = true;
    } else {
      outcome.converged = slip();
    }
    outcome.velocity = u_;
    return outcome;
  }

 private:
  void locate(const Velocity& u) {
    for (std::size_t i = 0; i < local_.size(); ++i) {
      const Contact& c = p_.contacts[i];
      local_[i].speed = c.normal.dot(u);
      local_[i].slip = Vector2d(c.tangent[0].dot(u), c.tangent[1].dot(u));
    }
  }

  double motor_impulse(int m, double rate) const {
    const Motor& motor = p_.motors[m];
    return std::clamp((motor.asked - rate) / motor_softness, -motor.limit, motor.limit);
  }

  static Vector2d grip(const Local& at) {
    const double size = at.slip.norm();
    if (at.bound <= 0) return Vector2d::Zero();
    return at.sticks(size) ? Vector2d(-at.slip / grip_softness) : Vector2d(-(at.bound / size) * at.slip);
  }

  // Impulses at u_, and the energy's gradient there. With `refresh` the bounds follow the normal impulses at once: the
  // gradient is then the residual of Coulomb's law itself.
  Velocity gradient(bool refresh) {
    locate(u_);
    Velocity g = p_.mass * (u_ - p_.free);
    for (std::size_t i = 0; i < local_.size(); ++i) {
      Contact& c = p_.contacts[i];
      c.push = std::max(0.0, (c.target - local_[i].speed) / c.softness);
      if (refresh) local_[i].bound = c.friction * c.push;
      c.grip = grip(local_[i]);
      g -= c.push * c.normal + c.grip[0] * c.tangent[0] + c.grip[1] * c.tangent[1];
    }
    for (int m = 0; m < 2; ++m) g[6 + m] -= motor_impulse(m, u_[6 + m]);
    return g;
  }

  // The largest change of velocity that the gradient would still make.
  double residual(const Velocity& g) const {
    const Velocity v = p_.inverse_mass * g;
    return std::max({v.segment<3>(3).norm(), turn_arm * v.head<3>().norm(), rim * v.tail<2>().norm()});
  }

  static void add(MassMatrix& h, double k, const Velocity& a, const Velocity& b) {
    h.noalias() += (k * a) * b.transpose();
  }

  void add_motors(MassMatrix& h, bool all) const {
    for (int m = 0; m < 2; ++m) {
      const bool free = std::abs(p_.motors[m].asked - u_[6 + m]) >= motor_softness * p_.motors[m].limit;
      if (all || !free) h(6 + m, 6 + m) += 1 / motor_softness;
    }
  }

  // The guess that is true on a clear floor: what closes under the free motion closes, and sticks; motors hold their
  // rate.
  bool stick_all() {
    u_ = p_.free;
    locate(u_);
    MassMatrix h = p_.mass;
    Velocity impulse = Velocity::Zero();
    for (std::size_t i = 0; i < local_.size(); ++i) {
      const Contact& c = p_.contacts[i];
      const double push = (c.target - local_[i].speed) / c.softness;
      if (!(push > 0)) continue;
      add(h, 1 / c.softness, c.normal, c.normal);
      impulse += push * c.normal;
      if (!(c.friction > 0)) continue;
      for (int k = 0; k < 2; ++k) {
        add(h, 1 / grip_softness, c.tangent[k], c.tangent[k]);
        impulse -= (local_[i].slip[k] / grip_softness) * c.tangent[k];
      }
    }
    add_motors(h, true);
    for (int m = 0; m < 2; ++m) impulse[6 + m] += (p_.motors[m].asked - u_[6 + m]) / motor_softness;
    u_ += h.llt().solve(impulse);
    return residual(gradient(true)) <= tolerance;
  }

  bool slip() {
    for (std::size_t i = 0; i < local_.size(); ++i) {
      local_[i].bound = p_.contacts[i].friction * start_[i].first;
      local_[i].dual = within(start_[i].second, local_[i].bound);
    }
    u_ = p_.previous;
    for (int pass = 0; pass < outer_passes; ++pass) {
      const bool last = pass + 1 == outer_passes;
      const bool done = minimise(last ? last_newton : pass == 0 ? first_newton : later_newton);
      double change = 0, size = 0;
      for (std::size_t i = 0; i < local_.size(); ++i) {
        const double bound = p_.contacts[i].friction * p_.contacts[i].push;
        change = std::max(change, std::abs(bound - local_[i].bound));
        size = std::max(size, bound);
      }
      if (done && change <= bound_tolerance * (size + 1e-9)) return true;
      if (!last) refresh_bounds(pass);
    }
    return false;
  }

  void refresh_bounds(int pass) {
    for (std::size_t i = 0; i < local_.size(); ++i) {
      const double bound = p_.contacts[i].friction * p_.contacts[i].push;
      local_[i].bound = pass < 2 ? bound : 0.5 * (bound + local_[i].bound);  // an average ends cycles
      local_[i].dual = within(local_[i].dual, local_[i].bound);
    }
  }

  // Newton with exact line search on the convex energy of fixed bounds; the impulses are those at u_ when it returns.
  bool minimise(int limit) {
    for (int iteration = 0;; ++iteration) {
      const Velocity g = gradient(false);
      if (residual(g) <= tolerance) return true;
      if (iteration == limit) return false;
      const Velocity d = -(hessian().llt().solve(g));
      move_duals(d);
      u_ += line_search(d) * d;
    }
  }

  MassMatrix hessian() const {
    MassMatrix h = p_.mass;
    for (std::size_t i = 0; i < local_.size(); ++i) {
      const Contact& c = p_.contacts[i];
      const Local& at = local_[i];
      if (c.push > 0) add(h, 1 / c.softness, c.normal, c.normal);
      if (at.bound <= 0) continue;
      const double size = at.slip.norm();
      Eigen::Matrix2d k = Eigen::Matrix2d::Identity();
      if (at.sticks(size)) {
        k /= grip_softness;
      } else {  // sym: half of each product, so that the Hessian stays symmetric
        const Eigen::Matrix2d product = (-1 / (at.bound * size)) * at.dual * at.slip.transpose();
        k = (at.bound / size) * (k - 0.5 * (product + product.transpose()));
      }
      for (int r = 0; r < 2; ++r) {
        for (int s = 0; s < 2; ++s) add(h, k(r, s), c.tangent[r], c.tangent[s]);
      }
    }
    add_motors(h, false);
    return h;
  }

  void move_duals(const Velocity& d) {
    for (std::size_t i = 0; i < local_.size(); ++i) {
      Local& at = local_[i];
      if (at.bound <= 0) continue;
      const Contact& c = p_.contacts[i];
      const Vector2d change(c.tangent[0].dot(d), c.tangent[1].dot(d));
      const double size = std::max(at.slip.norm(), grip_softness * at.bound);
      Vector2d x = at.slip + change;
      if (!at.sticks(at.slip.norm())) x += (at.slip.dot(change) / (size * at.bound)) * at.dual;
      at.dual = within(-(at.bound / size) * x, at.bound);
    }
  }

  // The energy's slope along d at u_ + a d, which rises with a.
  double slope(const Velocity& d, double a) const {
    const Velocity u = u_ + a * d;
    double s = d.dot(p_.mass * (u - p_.free));
    for (std::size_t i = 0; i < local_.size(); ++i) {
      const Contact& c = p_.contacts[i];
      s -= std::max(0.0, (c.target - c.normal.dot(u)) / c.softness) * c.normal.dot(d);
      Local there = local_[i];
      there.slip = Vector2d(c.tangent[0].dot(u), c.tangent[1].dot(u));
      s -= grip(there).dot(Vector2d(c.tangent[0].dot(d), c.tangent[1].dot(d)));
    }
    for (int m = 0; m < 2; ++m) s -= motor_impulse(m, u[6 + m]) * d[6 + m];
    return s;
  }

  double line_search(const Velocity& d) const {
    const double at_zero = slope(d, 0), at_one = slope(d, 1);
    if (at_one <= 0.5 * std::abs(at_zero)) return 1;
    double low = 0, high = 1, slope_low = at_zero, slope_high = at_one;
    for (int i = 0; i < 30 && high - low > 1e-9; ++i) {
      double middle = low - slope_low * (high - low) / (slope_high - slope_low);
      if (i % 3 == 2 || !(middle > low && middle < high)) middle = 0.5 * (low + high);
      const double s = slope(d, middle);
      if (std::abs(s) < 0.1 * std::abs(at_zero)) return middle;
      (s < 0 ? low : high) = middle;
      (s < 0 ? slope_low : slope_high) = s;
    }
    return low > 0 ? low : high;
  }

  Problem& p_;
  std::vector<Local> local_;
  std::vector<std::pair<double, Vector2d>> start_ = starts(p_);
  Velocity u_;

  static std::vector<std::pair<double, Vector2d>> starts(const Problem& problem) {
    std::vector<std::pair<double, Vector2d>> result;
    for (const Contact& c : problem.contacts) result.push_back({std::max(0.0, c.push), c.grip});
    return result;
  }
};

}  // namespace

Outcome solve(Problem& problem) { return Solver(problem).run(); }

}  // namespace muster::simbody
