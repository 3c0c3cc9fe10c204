// A robot on wheels that slip, integrated without any engine: one rigid body, springs and dampers under it, Coulomb's
// law smoothed below a creeping speed, wheels that turn as they are asked to, and steps a thousand times as short as an
// engine's. As the steps, the creep and the springs' give are made smaller together it closes in on Coulomb's law.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "description/robot.hpp"
#include "toys/arcs.hpp"

namespace muster::bench {

class SmoothCoulomb {
 public:
  struct Fineness {
    double step = 5e-6;       // [s]
    double creep = 1e-4;      // per friction: below creep times friction slip is not quite stopped [m/s]
    double stiffness = 16e6;  // of the ground under each wheel and slider, critically damped [N/m]
    // Twice as coarse: two ends differ by about as much as the coarser one errs, twice what the finer one does.
    Fineness coarser() const { return {2 * step, 2 * creep, stiffness / 4}; }
  };

  SmoothCoulomb(const description::Robot& robot, double friction, const Fineness& fineness)
      : fineness_(fineness),
        whole_(description::whole_mass(robot)),
        inverse_inertia_(whole_.inertia.inverse()),
        friction_(friction),
        damping_(2 * std::sqrt(fineness.stiffness * whole_.mass / 3)) {
    for (const std::size_t joint : {robot.drive->left, robot.drive->right}) {
      const auto& j = robot.joints[joint];
      supports_.push_back({j.origin.translation() - whole_.centre, robot.drive->wheel_radius, true});
      spin_inertia_ += j.axis.dot(rigid_mass(robot, j.child).inertia * j.axis) / 2;  // both alike
    }
    for (const auto& shape : rigid_shapes(robot, 0)) {
      const auto* sphere = std::get_if<description::Sphere>(&shape.geometry);
      if (sphere) supports_.push_back({shape.pose.translation() - whole_.centre, sphere->radius, false});
    }
  }

  // Where its frame is in the end, x and y.
  std::array<double, 2> drive(const Arc& arc) {
    turned_ = Eigen::AngleAxisd(arc.heading, Eigen::Vector3d::UnitZ());
    place_ = Eigen::Vector3d(arc.x, arc.y, 0) + turned_ * whole_.centre;
    momentum_.setZero(), spin_.setZero();
    const long count = std::lround(until / fineness_.step);
    for (long k = 0; k < count; ++k) {
      const double t = (static_cast<double>(k) + 0.5) * fineness_.step;
      step({arc.left(t), arc.right(t)});
    }
    const Eigen::Vector3d origin = place_ - turned_ * whole_.centre;
    return {origin.x(), origin.y()};
  }

 private:
  struct Support {
    Eigen::Vector3d centre;  // from the mass centre, in the body's frame [m]
    double radius;           // [m]
    bool is_wheel;
  };

  // Of the body with wheels that turn at `rates`; `spin_` is all of its angular momentum.
  void step(const std::array<double, 2>& rates) {
    const double h = fineness_.step;
    const Eigen::Matrix3d r = turned_.toRotationMatrix();
    const Eigen::Vector3d axle = r.col(1), v = momentum_ / whole_.mass;
    const Eigen::Vector3d w =
        r * (inverse_inertia_ * (r.transpose() * (spin_ - spin_inertia_ * (rates[0] + rates[1]) * axle)));
    Eigen::Vector3d force(0, 0, -9.81 * whole_.mass), torque(0, 0, 0);
    for (std::size_t i = 0; i < supports_.size(); ++i) {
      const Support& s = supports_[i];
      const Eigen::Vector3d arm = r * s.centre - Eigen::Vector3d(0, 0, s.radius);
      const double depth = -(place_.z() + arm.z());
      if (depth <= 0) continue;
      Eigen::Vector3d speed = v + w.cross(arm);
      const double push = fineness_.stiffness * depth - damping_ * speed.z();
      if (push <= 0) continue;
      Eigen::Vector3d f(0, 0, push);
      if (s.is_wheel) {
        speed -= rates[i] * s.radius * axle.cross(Eigen::Vector3d::UnitZ());
        const double creep = fineness_.creep * friction_;
        const double size = std::sqrt(speed.x() * speed.x() + speed.y() * speed.y() + creep * creep);
        f.head<2>() = -(friction_ * push / size) * speed.head<2>();
      }
      force += f;
      torque += arm.cross(f);
    }
    momentum_ += h * force;
    spin_ += h * torque;
    place_ += h / whole_.mass * momentum_;
    const Eigen::Quaterniond turning(0, w.x(), w.y(), w.z());
    turned_.coeffs() += 0.5 * h * (turning * turned_).coeffs();
    turned_.normalize();
  }

  Fineness fineness_;
  description::Mass whole_;
  Eigen::Matrix3d inverse_inertia_;
  double friction_, damping_, spin_inertia_ = 0;
  std::vector<Support> supports_;  // wheels first

  Eigen::Quaterniond turned_;
  Eigen::Vector3d place_, momentum_, spin_;  // of the mass centre; angular momentum about it, wheels' spin included
};

}  // namespace muster::bench
