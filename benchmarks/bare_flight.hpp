// The limit of what stepping quadrotors can cost: the classical Runge-Kutta method on the same equations, in plain
// numbers, with nothing around it. No shapes, no ground, no library; a body whose frame is its centre of mass turned
// to its principal axes.
#pragma once

#include <array>
#include <cmath>

#include "description/robot.hpp"

namespace muster::bench {

class BareFlight {
 public:
  // x y z, vx vy vz in the world; qw qx qy qz body to world; wx wy wz in the body's frame; of the centre of mass.
  using State = std::array<double, 13>;
  using Rotors = std::array<double, 4>;

  explicit BareFlight(const description::Robot& robot) : drive_(*robot.quadrotor) {
    const description::Mass whole = whole_mass(robot);
    mass_ = whole.mass;
    for (int i = 0; i < 3; ++i) inertia_[i] = whole.inertia(i, i);
    height_ = drive_.height - whole.centre.z();
  }

  void step(double h, const Rotors& asked, Rotors& rotors, State& s) const {
    Rotors middle, end;
    const double up = std::exp(-0.5 * h / drive_.lag_up), down = std::exp(-0.5 * h / drive_.lag_down);
    for (int i = 0; i < 4; ++i) {
      const double share = asked[i] > rotors[i] ? up : down;
      middle[i] = asked[i] + (rotors[i] - asked[i]) * share;
      end[i] = asked[i] + (rotors[i] - asked[i]) * share * share;
    }
    State a, b, c, d, at;
    rate(s, rotors, a);
    for (int i = 0; i < 13; ++i) at[i] = s[i] + 0.5 * h * a[i];
    rate(at, middle, b);
    for (int i = 0; i < 13; ++i) at[i] = s[i] + 0.5 * h * b[i];
    rate(at, middle, c);
    for (int i = 0; i < 13; ++i) at[i] = s[i] + h * c[i];
    rate(at, end, d);
    for (int i = 0; i < 13; ++i) s[i] += h / 6 * (a[i] + 2 * (b[i] + c[i]) + d[i]);
    const double size = 1 / std::sqrt(s[6] * s[6] + s[7] * s[7] + s[8] * s[8] + s[9] * s[9]);
    for (int i = 6; i < 10; ++i) s[i] *= size;
    rotors = end;
  }

 private:
  void rate(const State& s, const Rotors& r, State& d) const {
    const double vx = s[3], vy = s[4], vz = s[5], w = s[6], x = s[7], y = s[8], z = s[9];
    const double p = s[10], q = s[11], t = s[12];
    // The body's axes in the world.
    const double xx = 1 - 2 * (y * y + z * z), xy = 2 * (x * y + w * z), xz = 2 * (x * z - w * y);
    const double yx = 2 * (x * y - w * z), yy = 1 - 2 * (x * x + z * z), yz = 2 * (y * z + w * x);
    const double zx = 2 * (x * z + w * y), zy = 2 * (y * z - w * x), zz = 1 - 2 * (x * x + y * y);
    // Air that meets the rotors.
    const double bx = xx * vx + xy * vy + xz * vz + height_ * q, by = yx * vx + yy * vy + yz * vz - height_ * p;
    const double sum = r[0] + r[1] + r[2] + r[3];
    const double along = drive_.arm * (r[0] - r[2]), across = drive_.arm * (r[1] - r[3]);
    const double f0 = r[0] * r[0], f1 = r[1] * r[1], f2 = r[2] * r[2], f3 = r[3] * r[3];
    const double fx = -drive_.drag_factor * (sum * bx - across * t), fy = -drive_.drag_factor * (sum * by + along * t);
    const double fz = drive_.thrust_factor * (f0 + f1 + f2 + f3), lever = drive_.thrust_factor * drive_.arm;
    const double mx = lever * (f1 - f3) - height_ * fy, my = lever * (f2 - f0) + height_ * fx;
    const double mz = drive_.torque_factor * (f0 + f2 - f1 - f3) -
                      drive_.drag_factor * (along * by - across * bx + drive_.arm * drive_.arm * sum * t);
    d[0] = vx, d[1] = vy, d[2] = vz;
    d[3] = (xx * fx + yx * fy + zx * fz) / mass_;
    d[4] = (xy * fx + yy * fy + zy * fz) / mass_;
    d[5] = (xz * fx + yz * fy + zz * fz) / mass_ - 9.81;
    d[6] = 0.5 * (-x * p - y * q - z * t);
    d[7] = 0.5 * (w * p + y * t - z * q);
    d[8] = 0.5 * (w * q + z * p - x * t);
    d[9] = 0.5 * (w * t + x * q - y * p);
    d[10] = (mx - (inertia_[2] - inertia_[1]) * q * t) / inertia_[0];
    d[11] = (my - (inertia_[0] - inertia_[2]) * t * p) / inertia_[1];
    d[12] = (mz - (inertia_[1] - inertia_[0]) * p * q) / inertia_[2];
  }

  description::Quadrotor drive_;
  double mass_, height_;  // of the rotors above the centre of mass
  double inertia_[3];
};

}  // namespace muster::bench
