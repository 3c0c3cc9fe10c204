#include "flight.hpp"

namespace muster::simbody {

using description::RotorRates;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector4d;

// Of the centre of mass in the world, and of the body about it: q is w x y z, body to world, w in the body's frame. The
// same for rates of change.
struct Flight::Motion {
  Vector3d x, v;
  Vector4d q;
  Vector3d w;

  Motion moved(double h, const Motion& rate) const {
    return {x + h * rate.x, v + h * rate.v, q + h * rate.q, w + h * rate.w};
  }
};

namespace {

// Of a quaternion that is nearly of unit length.
Matrix3d matrix(const Vector4d& q) { return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix(); }

Vector4d quaternion_rate(const Vector4d& q, const Vector3d& w) {
  return 0.5 * Vector4d(-q[1] * w[0] - q[2] * w[1] - q[3] * w[2], q[0] * w[0] + q[2] * w[2] - q[3] * w[1],
                        q[0] * w[1] + q[3] * w[0] - q[1] * w[2], q[0] * w[2] + q[1] * w[1] - q[2] * w[0]);
}

}  // namespace

Flight::Flight(const description::Mass& whole, const description::Quadrotor& drive)
    : drive_(drive),
      mass_(whole.mass),
      centre_(whole.centre),
      inertia_(whole.inertia),
      inverse_inertia_(whole.inertia.inverse()) {}

Flight::Change Flight::change(const Matrix3d& to_world, const Vector3d& v, const Vector3d& w,
                              const RotorRates& rates) const {
  const description::Wrench wrench = drive_.wrench(rates, to_world.transpose() * v - w.cross(centre_), w);
  const Vector3d torque = wrench.torque - centre_.cross(wrench.force);
  return {to_world * wrench.force / mass_ - Vector3d(0, 0, gravity),
          inverse_inertia_ * (torque - w.cross(inertia_ * w))};
}

Flight::Motion Flight::rate(const Motion& at, const RotorRates& rates) const {
  const Change c = change(matrix(at.q), at.v, at.w, rates);
  return {at.v, c.v, quaternion_rate(at.q, at.w), c.w};
}

void Flight::step(double h, const RotorRates& asked, RobotState& s) const {
  Motion now;
  now.q = {s.pose[3], s.pose[4], s.pose[5], s.pose[6]};
  const Matrix3d from = matrix(now.q);
  const Vector3d turn(s.twist[3], s.twist[4], s.twist[5]);
  now.w = from.transpose() * turn;
  now.x = Vector3d(s.pose[0], s.pose[1], s.pose[2]) + from * centre_;
  now.v = Vector3d(s.twist[0], s.twist[1], s.twist[2]) + turn.cross(from * centre_);
  if (s.memory.previous_step > 0) {  // after a contact they stand half a step before
    const Change c = change(from, now.v, now.w, s.rotors);
    now.v += 0.5 * s.memory.previous_step * c.v;
    now.w += 0.5 * s.memory.previous_step * c.w;
  }
  const RotorRates middle = drive_.later(s.rotors, asked, drive_.decay(0.5 * h));
  const RotorRates end = drive_.later(s.rotors, asked, drive_.decay(h));
  const Motion a = rate(now, s.rotors), b = rate(now.moved(0.5 * h, a), middle);
  const Motion c = rate(now.moved(0.5 * h, b), middle), d = rate(now.moved(h, c), end);
  now = now.moved(h / 6, a).moved(h / 3, b).moved(h / 3, c).moved(h / 6, d);
  now.q.normalize();

  const Matrix3d to = matrix(now.q);
  const Vector3d w = to * now.w, arm = to * centre_, x = now.x - arm, v = now.v - w.cross(arm);
  s.pose = {x[0], x[1], x[2], now.q[0], now.q[1], now.q[2], now.q[3]};
  s.twist = {v[0], v[1], v[2], w[0], w[1], w[2]};
  s.rotors = end;
  s.memory = Memory();
}

}  // namespace muster::simbody
