#include "flight.hpp"

#include <algorithm>
#include <cmath>

namespace muster::simbody {

using description::RotorRates;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector4d;

// Motion of the centre of mass in the world, and of the body about it: q is w x y z, body to world, w in the body's
// frame. Also used for rates of change.
struct Flight::Motion {
  Vector3d x, v;
  Vector4d q;
  Vector3d w;

  Motion moved(double h, const Motion& rate) const {
    return {x + h * rate.x, v + h * rate.v, q + h * rate.q, w + h * rate.w};
  }
};

namespace {

// Rotation matrix of a quaternion that is nearly of unit length.
Matrix3d matrix(const Vector4d& q) { return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix(); }

Vector4d quaternion_rate(const Vector4d& q, const Vector3d& w) {
  return 0.5 * Vector4d(-q[1] * w[0] - q[2] * w[1] - q[3] * w[2], q[0] * w[0] + q[2] * w[2] - q[3] * w[1],
                        q[0] * w[1] + q[3] * w[0] - q[1] * w[2], q[0] * w[2] + q[1] * w[1] - q[2] * w[0]);
}

}  // namespace

// The parabola with the moments of exp(-k t) for t from 0 to 1.
Flight::Nodes Flight::parabola_of_decay(double k) {
  if (k < 0.1) return {1, std::exp(-0.5 * k), std::exp(-k)};  // the same to 1e-7; the moments would lose digits
  const double e = std::exp(-k);
  const double m0 = (1 - e) / k, m1 = (m0 - e) / k, m2 = (2 * m1 - e) / k;
  return {9 * m0 - 36 * m1 + 30 * m2, -1.5 * m0 + 15 * m1 - 15 * m2, 3 * m0 - 24 * m1 + 30 * m2};
}

void Flight::set_decay(double h) {
  if (decay_.h == h) return;
  const double up = h / drive_.lag_up, down = h / drive_.lag_down;
  decay_ = {h,
            drive_.decay(h),
            parabola_of_decay(up),
            parabola_of_decay(2 * up),
            parabola_of_decay(down),
            parabola_of_decay(2 * down)};
}

Flight::Spin Flight::spin(const RotorRates& rates) {
  Spin result{rates, rates};
  for (double& square : result.squares) square *= square;
  return result;
}

// A rotor's rate is goal + gap exp(-t / lag); its square has that and exp(-2 t / lag).
std::array<Flight::Spin, 3> Flight::parabolas(const RotorRates& now, const RotorRates& asked) const {
  std::array<Spin, 3> result;
  for (std::size_t i = 0; i < 4; ++i) {
    const double goal = std::clamp(asked[i], 0.0, drive_.max_speed), gap = now[i] - goal;
    const Nodes& once = gap < 0 ? decay_.up : decay_.down;
    const Nodes& twice = gap < 0 ? decay_.up_squared : decay_.down_squared;
    for (std::size_t n = 0; n < 3; ++n) {
      result[n].rates[i] = goal + gap * once[n];
      result[n].squares[i] = goal * goal + gap * (2 * goal * once[n] + gap * twice[n]);
    }
  }
  return result;
}

Flight::Flight(const description::Mass& whole, const description::Quadrotor& drive)
    : drive_(drive),
      mass_(whole.mass),
      centre_(whole.centre),
      inertia_(whole.inertia),
      inverse_inertia_(whole.inertia.inverse()) {}

Flight::Change Flight::change(const Matrix3d& to_world, const Vector3d& v, const Vector3d& w, const Spin& spin) const {
  const description::Wrench wrench =
      drive_.wrench(spin.rates, spin.squares, to_world.transpose() * v - w.cross(centre_), w);
  const Vector3d torque = wrench.torque - centre_.cross(wrench.force);
  return {to_world * wrench.force / mass_ - Vector3d(0, 0, gravity),
          inverse_inertia_ * (torque - w.cross(inertia_ * w))};
}

Flight::Motion Flight::rate(const Motion& at, const Spin& spin) const {
  const Change c = change(matrix(at.q), at.v, at.w, spin);
  return {at.v, c.v, quaternion_rate(at.q, at.w), c.w};
}

void Flight::step(double h, const RotorRates& asked, RobotState& s) {
  set_decay(h);
  Motion now;
  now.q = {s.pose[3], s.pose[4], s.pose[5], s.pose[6]};
  const Matrix3d from = matrix(now.q);
  const Vector3d turn(s.twist[3], s.twist[4], s.twist[5]);
  now.w = from.transpose() * turn;
  now.x = Vector3d(s.pose[0], s.pose[1], s.pose[2]) + from * centre_;
  now.v = Vector3d(s.twist[0], s.twist[1], s.twist[2]) + turn.cross(from * centre_);
  if (s.memory.previous_step > 0) {  // after a contact they are those half a step before
    const Change c = change(from, now.v, now.w, spin(s.rotors));
    now.v += 0.5 * s.memory.previous_step * c.v;
    now.w += 0.5 * s.memory.previous_step * c.w;
    s.memory = Memory();
  }
  const auto [start, middle, end] = parabolas(s.rotors, asked);
  const Motion a = rate(now, start), b = rate(now.moved(0.5 * h, a), middle);
  const Motion c = rate(now.moved(0.5 * h, b), middle), d = rate(now.moved(h, c), end);
  now.x += h / 6 * (a.x + 2 * (b.x + c.x) + d.x);
  now.v += h / 6 * (a.v + 2 * (b.v + c.v) + d.v);
  now.q += h / 6 * (a.q + 2 * (b.q + c.q) + d.q);
  now.w += h / 6 * (a.w + 2 * (b.w + c.w) + d.w);
  now.q.normalize();

  const Matrix3d to = matrix(now.q);
  const Vector3d w = to * now.w, arm = to * centre_, x = now.x - arm, v = now.v - w.cross(arm);
  s.pose = {x[0], x[1], x[2], now.q[0], now.q[1], now.q[2], now.q[3]};
  s.twist = {v[0], v[1], v[2], w[0], w[1], w[2]};
  s.rotors = drive_.later(s.rotors, asked, decay_.end);
}

}  // namespace muster::simbody
