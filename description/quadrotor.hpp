// Four rotors that lift and turn a body, independent of any engine.
//
// The rotors are a quarter turn apart, the first `rotor_angle` from the body's x axis: 0 is a plus, an eighth of a turn
// an X, whose front rotor is in front on the left. The front and the back rotor turn clockwise seen from above, the
// left and the right one the other way. Thrust and torque grow with the square of a rotor's rate, which follows its
// command as a first-order lag (Powers, Mellinger, Kumar: Quadrotor kinematics and dynamics. Handbook of Unmanned
// Aerial Vehicles, 2015). Lateral air flow causes a drag at a rotor in proportion to its rate (Martin, Salaun: The true
// role of accelerometer feedback in quadrotor control. ICRA 2010). Rotors have no angular momentum of their own and do
// not flap.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

namespace muster::description {

using RotorRates = std::array<double, 4>;  // front, left, back, right [rad/s], from 0

struct Wrench {
  Eigen::Vector3d force, torque;  // in the body's frame, the torque about the body's origin [N], [N m]
};

// Remaining fraction of a rotor's rate error after some time, when it speeds up and when it slows down.
struct RotorDecay {
  double up = 0, down = 0;
};

struct Quadrotor {
  double arm = 0;            // of the rotors' axes from the body's z axis [m]
  double rotor_angle = 0;    // of the front rotor's arm from the body's x axis, to the left [rad]
  double height = 0;         // of the rotors' plane above the body's origin [m]
  double thrust_factor = 0;  // [N s2/rad2]
  double torque_factor = 0;  // [N m s2/rad2]
  double drag_factor = 0;    // [N s2/(rad m)]
  double max_speed = 0;      // of a rotor [rad/s]
  double lag_up = 0;         // time constant of a rotor that speeds up [s]
  double lag_down = 0;       // of one that slows down

  // Gains of the attitude controller on board: commanded angular acceleration for each radian of error, its integral
  // and its rate.
  double attitude_p = 0;  // [1/s2]
  double attitude_i = 0;  // [1/s3]
  double attitude_d = 0;  // [1/s]
  double yaw_p = 0;       // for each rad/s of turn-rate error [1/s]
  double yaw_i = 0;       // [1/s2]

  double max_thrust() const { return 4 * thrust_factor * max_speed * max_speed; }

  RotorDecay decay(double time) const;
  RotorRates later(const RotorRates& now, const RotorRates& asked, const RotorDecay& decay) const;

  // Wrench of the rotors on a body whose origin moves at `v` and that turns at `w`, both in its own frame. `squares` of
  // the rates are separate, for callers that average both over time.
  Wrench wrench(const RotorRates& rates, const RotorRates& squares, const Eigen::Vector3d& v,
                const Eigen::Vector3d& w) const;
  Wrench wrench(const RotorRates& rates, const Eigen::Vector3d& v, const Eigen::Vector3d& w) const;
  // The same of a plus, whose axes are the rotors' arms.
  Wrench wrench_along_arms(const RotorRates& rates, const RotorRates& squares, const Eigen::Vector3d& v,
                           const Eigen::Vector3d& w) const;
  // A vector of the body's frame along the arms, and back.
  Eigen::Vector3d along_arms(const Eigen::Vector3d& vector) const;
  Eigen::Vector3d from_arms(const Eigen::Vector3d& vector) const;

  // Rates for a lift of `thrust` [N] and a torque [N m]. Under saturation it reduces first the torque about z, then
  // changes thrust (up or down), then reduces roll and pitch. Without thrust the rotors stop.
  RotorRates rates_for(double thrust, const Eigen::Vector3d& torque) const;

  // Drag coefficient of slow sideways motion while the rotors together lift `thrust` [N s/m].
  double hover_drag(double thrust) const;
};

inline Eigen::Vector3d Quadrotor::along_arms(const Eigen::Vector3d& a) const {
  const double c = std::cos(rotor_angle), s = std::sin(rotor_angle);
  return {c * a.x() + s * a.y(), c * a.y() - s * a.x(), a.z()};
}

inline Eigen::Vector3d Quadrotor::from_arms(const Eigen::Vector3d& a) const {
  const double c = std::cos(rotor_angle), s = std::sin(rotor_angle);
  return {c * a.x() - s * a.y(), c * a.y() + s * a.x(), a.z()};
}

inline Wrench Quadrotor::wrench(const RotorRates& rates, const RotorRates& squares, const Eigen::Vector3d& v,
                                const Eigen::Vector3d& w) const {
  if (rotor_angle == 0) return wrench_along_arms(rates, squares, v, w);
  const Wrench own = wrench_along_arms(rates, squares, along_arms(v), along_arms(w));
  return {from_arms(own.force), from_arms(own.torque)};
}

inline Wrench Quadrotor::wrench_along_arms(const RotorRates& rates, const RotorRates& squares, const Eigen::Vector3d& v,
                                           const Eigen::Vector3d& w) const {
  const auto& [front, left, back, right] = rates;
  const auto& [f2, l2, b2, r2] = squares;
  // Sums over rotors of their rates, and of the rates times their positions.
  const double sum = front + left + back + right, along = arm * (front - back), across = arm * (left - right);
  const double vx = v.x() + height * w.y(), vy = v.y() - height * w.x();  // of the middle of the rotors
  const double drag_x = -drag_factor * (sum * vx - across * w.z());
  const double drag_y = -drag_factor * (sum * vy + along * w.z());
  const double drag_z = -drag_factor * (along * vy - across * vx + arm * arm * sum * w.z());
  return {{drag_x, drag_y, thrust_factor * (f2 + l2 + b2 + r2)},
          {thrust_factor * arm * (l2 - r2) - height * drag_y, thrust_factor * arm * (b2 - f2) + height * drag_x,
           torque_factor * (f2 + b2 - l2 - r2) + drag_z}};
}

}  // namespace muster::description
