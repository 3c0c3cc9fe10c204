// Scarabs in ODE as a program without a kernel has them: bodies that live in ODE from step to step. Written for speed,
// as the peer of our engine: spheres for wheels, one box a robot, its own collision.
#pragma once

#include <algorithm>
#include <array>
#include <deque>
#include <vector>

#include "plugins/physics_ode/library.hpp"
#include "plugins/physics_ode/model.hpp"
#include "scene/slabs.hpp"

namespace muster::bench {

class RawOde {
 public:
  struct Start {
    double x, y, heading;
  };

  // iterations 0: dWorldStep; else of dWorldQuickStep.
  RawOde(const description::Robot& robot, const std::vector<Start>& starts, const std::vector<scene::Slab>& walls,
         int iterations)
      : model_(robot), iterations_(iterations), world_(dWorldCreate()), space_(dHashSpaceCreate(nullptr)) {
    thread_.carry(world_.get());
    dWorldSetGravity(world_.get(), 0, 0, -9.81);
    dWorldSetERP(world_.get(), 0.2);
    dWorldSetCFM(world_.get(), 1e-10);
    if (iterations) dWorldSetQuickStepNumIterations(world_.get(), iterations);
    dCreatePlane(space_.get(), 0, 0, 1, 0);
    for (const scene::Slab& wall : walls) {
      dGeomID box = dCreateBox(space_.get(), wall.length, wall.thickness, wall.height);
      dGeomSetPosition(box, wall.x, wall.y, wall.z);
      const double half = std::atan2(wall.sin_yaw, wall.cos_yaw) / 2;
      const dQuaternion turned = {std::cos(half), 0, 0, std::sin(half)};
      dGeomSetQuaternion(box, turned);
    }
    for (const Start& start : starts) add(start);
  }

  // rates(robot): of its left and right wheel, for the step.
  template <class Rates>
  void step(double h, Rates rates) {
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      const std::array<double, 2> asked = rates(i);
      for (std::size_t w = 0; w < 2; ++w) dJointSetHingeParam(robots_[i].motor[w], dParamVel, asked[w]);
    }
    dJointGroupEmpty(contacts_.get());
    dSpaceCollide(space_.get(), this, touch);
    if (iterations_) {
      dWorldQuickStep(world_.get(), h);
    } else {
      dWorldStep(world_.get(), h);
    }
  }

  // Of the robot's frame: x y z, qw qx qy qz.
  std::array<double, 7> pose(std::size_t robot) const {
    const auto& c = model_.body.centre;
    dVector3 origin;
    dBodyGetRelPointPos(robots_[robot].body, -c.x(), -c.y(), -c.z(), origin);
    const dReal* q = dBodyGetQuaternion(robots_[robot].body);
    return {origin[0], origin[1], origin[2], q[0], q[1], q[2], q[3]};
  }

 private:
  struct Made {
    dBodyID body;
    std::array<dJointID, 2> motor;
  };

  void add(const Start& start) {
    const Eigen::Isometry3d at =
        Eigen::Translation3d(start.x, start.y, 0) * Eigen::AngleAxisd(start.heading, Eigen::Vector3d::UnitZ());
    const Eigen::Quaterniond turned(at.linear());
    const auto body = [&](const description::Mass& mass, const Eigen::Vector3d& centre) {
      dBodyID made = dBodyCreate(world_.get());
      const auto& i = mass.inertia;
      dMass m;
      dMassSetParameters(&m, mass.mass, 0, 0, 0, i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2));
      dBodySetMass(made, &m);
      const Eigen::Vector3d place = at * centre;
      dBodySetPosition(made, place.x(), place.y(), place.z());
      const dQuaternion q = {turned.w(), turned.x(), turned.y(), turned.z()};
      dBodySetQuaternion(made, q);
      return made;
    };
    dSpaceID own = dSimpleSpaceCreate(space_.get());
    const auto shape = [&](dGeomID geom, dBodyID on, const Eigen::Vector3d& place, double friction) {
      frictions_.push_back(friction);
      dGeomSetData(geom, &frictions_.back());
      dGeomSetBody(geom, on);
      const Eigen::Vector3d p = at * place;
      dGeomSetOffsetWorldPosition(geom, p.x(), p.y(), p.z());
    };
    Made made;
    made.body = body(model_.body, model_.body.centre);
    for (const ode::Ball& slider : model_.balls) shape(dCreateSphere(own, slider.radius), made.body, slider.centre, 0);
    const ode::Block& box = model_.blocks.front();
    shape(dCreateBox(own, box.size.x(), box.size.y(), box.size.z()), made.body, box.pose.translation(), 0.3);
    for (std::size_t w = 0; w < 2; ++w) {
      const Eigen::Vector3d hub = model_.wheels[w].frame.translation(), axle = at.linear() * model_.wheels[w].axis;
      dBodyID wheel = body(model_.wheels[w].mass, hub);
      dBodySetFiniteRotationMode(wheel, 1);
      shape(dCreateSphere(own, model_.drive.wheel_radius), wheel, hub, model_.drive.friction);
      made.motor[w] = dJointCreateHinge(world_.get(), nullptr);
      dJointAttach(made.motor[w], wheel, made.body);
      const Eigen::Vector3d anchor = at * hub;
      dJointSetHingeAnchor(made.motor[w], anchor.x(), anchor.y(), anchor.z());
      dJointSetHingeAxis(made.motor[w], axle.x(), axle.y(), axle.z());
      dJointSetHingeParam(made.motor[w], dParamFMax, model_.drive.max_torque);
    }
    robots_.push_back(made);
  }

  static void touch(void* self, dGeomID a, dGeomID b) {
    if (dGeomIsSpace(a) || dGeomIsSpace(b)) return dSpaceCollide2(a, b, self, touch);
    auto& raw = *static_cast<RawOde*>(self);
    dBodyID on_a = dGeomGetBody(a), on_b = dGeomGetBody(b);
    if (!on_a && !on_b) return;
    dContact contact[4];
    const int count = dCollide(a, b, 4, &contact[0].geom, sizeof contact[0]);
    if (!count) return;
    const double mu = std::min(friction(a), friction(b));
    for (int i = 0; i < count; ++i) {
      contact[i].surface.mode = dContactApprox1;
      contact[i].surface.mu = mu;
      dJointAttach(dJointCreateContact(raw.world_.get(), raw.contacts_.get(), &contact[i]), on_a, on_b);
    }
  }

  // The ground and walls have none of their own.
  static double friction(dGeomID geom) {
    const auto* own = static_cast<const double*>(dGeomGetData(geom));
    return own ? *own : dInfinity;
  }

  ode::Library library_;
  ode::OwnThread thread_;
  ode::RobotModel model_;
  int iterations_;
  std::unique_ptr<dxWorld, ode::Destroy> world_;
  std::unique_ptr<dxSpace, ode::Destroy> space_;
  std::unique_ptr<dxJointGroup, ode::Destroy> contacts_{dJointGroupCreate(0)};
  std::vector<Made> robots_;
  std::deque<double> frictions_;  // what shapes point at
};

}  // namespace muster::bench
