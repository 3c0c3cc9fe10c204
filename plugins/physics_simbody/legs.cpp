#include "legs.hpp"

#include <algorithm>
#include <cmath>

#include "motion.hpp"

namespace muster::simbody {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double pi = 3.141592653589793;
constexpr int samples = 12;        // of a leg, between which its distance to a solid has one minimum
constexpr double resolved = 1e-5;  // [rad] along a leg: gives a gap within 1e-11 m

Matrix3d turned_about_y(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Matrix3d r;
  r << c, 0, s, 0, 1, 0, -s, 0, c;
  return r;
}

// A rigid part of the robot that turns with `rate` about the body's y axis through `hip`, in addition to the body's own
// motion.
struct Turning {
  const description::Mass& mass;  // in its own axes about the hip
  Vector3d hip;
  double angle, rate;
};

}  // namespace

LeggedMass weigh(const RobotModel& robot, const LegAngles& angle, const VelocityOf<unknowns_with_legs>& u,
                 const Vector3d& fall) {
  LeggedMass result;
  result.mass.setZero();
  result.force.setZero();
  const Vector3d w = u.head<3>(), axis = Vector3d::UnitY();
  const auto add = [&](const Turning& part, int joint) {
    const Matrix3d r = turned_about_y(part.angle), inertia = r * part.mass.inertia * r.transpose();
    const double m = part.mass.mass;
    const Vector3d arm = r * part.mass.centre, centre = part.hip + arm;  // from the hip, from the body's origin
    const Matrix3d c = cross_matrix(centre);
    result.mass.topLeftCorner<3, 3>() += inertia - m * c * c;
    result.mass.block<3, 3>(0, 3) += m * c;
    result.mass.block<3, 3>(3, 0) -= m * c;
    result.mass.block<3, 3>(3, 3) += m * Matrix3d::Identity();
    const Vector3d spin = w + part.rate * axis, swing = axis.cross(arm);
    // Rates of change of the velocity of the centre of mass and of the angular momentum while udot is zero.
    const Vector3d acceleration =
        w.cross(w.cross(centre)) + 2 * part.rate * w.cross(swing) + part.rate * part.rate * axis.cross(swing);
    const Vector3d pull = m * (fall - acceleration);
    const Vector3d turn = -(inertia * (part.rate * w.cross(axis)) + spin.cross(inertia * spin));
    result.force.head<3>() += turn + centre.cross(pull);
    result.force.segment<3>(3) += pull;
    if (joint < 0) return;
    result.mass.block<3, 1>(0, joint) = inertia * axis + m * centre.cross(swing);
    result.mass.block<3, 1>(3, joint) = m * swing;
    result.mass(joint, joint) = axis.dot(inertia * axis) + m * swing.squaredNorm();
    result.force[joint] = axis.dot(turn + arm.cross(pull));
  };
  add({robot.body, Vector3d::Zero(), 0, 0}, -1);
  for (std::size_t i = 0; i < robot.legs.size(); ++i) {
    const int joint = 6 + static_cast<int>(i);
    add({robot.legs[i].mass, robot.legs[i].hip, angle[i], u[joint]}, joint);
  }
  result.mass.bottomLeftCorner<6, 6>() = result.mass.topRightCorner<6, 6>().transpose();
  return result;
}

MassMatrixOf<unknowns_with_legs> inverse(const MassMatrixOf<unknowns_with_legs>& mass) {
  using Matrix6d = Eigen::Matrix<double, 6, 6>;
  const Eigen::Matrix<double, 6, 1> of_leg = mass.diagonal().tail<6>().cwiseInverse();
  const Matrix6d follow = of_leg.asDiagonal() * mass.bottomLeftCorner<6, 6>();  // legs' rates per body's acceleration
  const Matrix6d body =
      (mass.topLeftCorner<6, 6>() - mass.topRightCorner<6, 6>() * follow).llt().solve(Matrix6d::Identity());
  MassMatrixOf<unknowns_with_legs> result;
  result.topLeftCorner<6, 6>() = body;
  result.bottomLeftCorner<6, 6>() = -follow * body;
  result.topRightCorner<6, 6>() = result.bottomLeftCorner<6, 6>().transpose();
  result.bottomRightCorner<6, 6>() = follow * body * follow.transpose();
  result.bottomRightCorner<6, 6>().diagonal() += of_leg;
  return result;
}

Motor leg_motor(const description::LegDrive& drive, double asked, double asked_rate, double angle, double h) {
  const double kp = drive.position_gain, kd = drive.rate_gain;
  const double rate = std::clamp(asked_rate, -drive.max_speed, drive.max_speed);
  const double gain = kd + 0.5 * h * kp;
  Motor motor;
  motor.asked = (kp * std::remainder(asked - angle, 2 * pi) + kd * rate) / gain;
  motor.softness = 1 / (h * gain);
  motor.limit = drive.max_torque * h;
  return motor;
}

LegTouches touch_leg(const Vector3d& hip, const Vector3d& ahead, const Vector3d& above, double radius,
                     const Solid& solid, double margin) {
  const auto at = [&](double way) {
    const Vector3d p = hip - radius * (std::sin(way) * ahead + (1 - std::cos(way)) * above);
    const Touch t =
        touch({Solid::Kind::sphere, p, Matrix3d::Identity(), Vector3d::Zero()}, solid, 10 * radius + margin);
    return LegTouch{t.count > 0 ? t.points[0] : TouchPoint{p, 1e9, 0}, t.normal};
  };
  std::array<double, samples + 1> gap;
  for (int i = 0; i <= samples; ++i) gap[i] = at(pi * i / samples).point.gap;
  LegTouches result;
  for (int i = 0; i <= samples && result.count < 2; ++i) {
    if ((i > 0 && gap[i - 1] <= gap[i]) || (i < samples && gap[i + 1] < gap[i])) continue;
    double low = pi * std::max(i - 1, 0) / samples, high = pi * std::min(i + 1, samples) / samples;
    constexpr double golden = 0.6180339887498949;
    double p = high - golden * (high - low), q = low + golden * (high - low);
    double at_p = at(p).point.gap, at_q = at(q).point.gap;
    while (high - low > resolved) {
      if (at_p < at_q) {
        high = q, q = p, at_q = at_p;
        p = high - golden * (high - low), at_p = at(p).point.gap;
      } else {
        low = p, p = q, at_p = at_q;
        q = low + golden * (high - low), at_q = at(q).point.gap;
      }
    }
    // An end of the leg is returned exactly.
    const double way = low == 0 ? 0 : high == pi ? pi : 0.5 * (low + high);
    LegTouch nearest = at(way);
    if (nearest.point.gap >= margin) continue;
    nearest.point.mark = result.count;
    result.touch[result.count++] = nearest;
  }
  return result;
}

}  // namespace muster::simbody
