// Hexapods in ODE as a program without a kernel has them: bodies that live in ODE from step to step, written for speed
// as the peer of our engine. The model is ours, as far as ODE has it: a hinge motor whose softness makes it the leg's
// controller, and one contact a leg, at its lowest point, as soft as the leg; friction is ODE's pyramid.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "plugins/physics_ode/library.hpp"
#include "plugins/physics_simbody/world.hpp"

namespace muster::bench {

class RawOdeLegs {
 public:
  RawOdeLegs(const description::Robot& model, int count)
      : model_(model), drive_(*model.legs), world_(dWorldCreate()), space_(dHashSpaceCreate(nullptr)) {
    thread_.carry(world_.get());
    dWorldSetGravity(world_.get(), 0, 0, -simbody::gravity);
    dCreatePlane(space_.get(), 0, 0, 1, 0);
    for (std::size_t i = 0; i < 6; ++i) centre_[i] = mass(i).centre;
    for (int i = 0; i < count; ++i) add(2.0 * i);
  }

  // One command for all, as over the step that begins now.
  void step(const simbody::Command& command, double h) {
    const double gain = drive_.rate_gain + h * drive_.position_gain;
    dJointGroupEmpty(contacts_.get());
    dSpaceCollide(space_.get(), this, touch);
    for (Robot& robot : robots_) {
      for (std::size_t i = 0; i < robot.legs.size(); ++i) {
        const double asked = command.leg_angle[i] + h * command.leg_rate[i];
        const double error = std::remainder(asked - dJointGetHingeAngle(robot.hips[i]), 2 * M_PI);
        const double rate = (drive_.position_gain * error + drive_.rate_gain * command.leg_rate[i]) / gain;
        dJointSetHingeParam(robot.hips[i], dParamVel, rate);
        dJointSetHingeParam(robot.hips[i], dParamCFM, 1 / gain);
        stand(robot.legs[i], centre_[i], h);
      }
    }
    dWorldStep(world_.get(), h);
  }

  double x(std::size_t robot) const { return dBodyGetPosition(robots_[robot].body)[0]; }
  double z(std::size_t robot) const { return dBodyGetPosition(robots_[robot].body)[2]; }

 private:
  struct Robot {
    dBodyID body;
    std::array<dBodyID, 6> legs;
    std::array<dJointID, 6> hips;
  };

  void add(double y) {
    const auto body = [&](const description::Mass& mass, const Eigen::Vector3d& at) {
      dBodyID made = dBodyCreate(world_.get());
      const auto& i = mass.inertia;
      dMass m;
      dMassSetParameters(&m, mass.mass, 0, 0, 0, i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2));
      dBodySetMass(made, &m);
      dBodySetPosition(made, at.x(), at.y() + y, at.z());
      return made;
    };
    Robot robot;
    const description::Mass base = rigid_mass(model_, 0);
    robot.body = body(base, base.centre);
    const auto& box = std::get<description::Box>(model_.links[0].shapes.at(0).geometry);
    dGeomID geom = dCreateBox(space_.get(), box.size.x(), box.size.y(), box.size.z());
    dGeomSetBody(geom, robot.body);
    for (std::size_t i = 0; i < robot.legs.size(); ++i) {
      const Eigen::Vector3d hip = drive_.legs[i].hip;
      robot.legs[i] = body(mass(i), hip + centre_[i]);
      dBodySetFiniteRotationMode(robot.legs[i], 1);
      robot.hips[i] = dJointCreateHinge(world_.get(), nullptr);
      dJointAttach(robot.hips[i], robot.legs[i], robot.body);
      dJointSetHingeAnchor(robot.hips[i], hip.x(), hip.y() + y, hip.z());
      dJointSetHingeAxis(robot.hips[i], 0, 1, 0);
      dJointSetHingeParam(robot.hips[i], dParamFMax, drive_.max_torque);
    }
    robots_.push_back(robot);
  }

  description::Mass mass(std::size_t leg) const {
    return rigid_mass(model_, model_.joints[drive_.legs[leg].joint].child);
  }

  void stand(dBodyID body, const Eigen::Vector3d& centre, double h) {
    const dReal* r = dBodyGetRotation(body);
    const Eigen::Vector3d place = drive_.place(0, drive_.lowest_way(0, {r[8], r[9], r[10]})) - centre;
    dContact contact{};
    dBodyGetRelPointPos(body, place.x(), place.y(), place.z(), contact.geom.pos);
    if (contact.geom.pos[2] >= 0) return;
    contact.geom.normal[2] = 1;
    contact.geom.depth = -contact.geom.pos[2];
    contact.surface.mode = dContactApprox1 | dContactSoftERP | dContactSoftCFM;
    contact.surface.mu = drive_.friction;
    contact.surface.soft_erp = h * drive_.stiffness / (h * drive_.stiffness + drive_.damping);
    contact.surface.soft_cfm = 1 / (h * drive_.stiffness + drive_.damping);
    dJointAttach(dJointCreateContact(world_.get(), contacts_.get(), &contact), body, nullptr);
  }

  // Bodies of robots that lie on the ground: none does.
  static void touch(void* self, dGeomID a, dGeomID b) {
    auto& raw = *static_cast<RawOdeLegs*>(self);
    dContact contact[4];
    const int count = dCollide(a, b, 4, &contact[0].geom, sizeof contact[0]);
    for (int i = 0; i < count; ++i) {
      contact[i].surface.mode = dContactApprox1;
      contact[i].surface.mu = model_friction;
      dJointAttach(dJointCreateContact(raw.world_.get(), raw.contacts_.get(), &contact[i]), dGeomGetBody(a),
                   dGeomGetBody(b));
    }
  }

  static constexpr double model_friction = 0.3;

  ode::Library library_;
  ode::OwnThread thread_;
  const description::Robot& model_;
  const description::LegDrive& drive_;
  std::array<Eigen::Vector3d, 6> centre_;  // of the legs' masses, from their hips
  std::unique_ptr<dxWorld, ode::Destroy> world_;
  std::unique_ptr<dxSpace, ode::Destroy> space_;
  std::unique_ptr<dxJointGroup, ode::Destroy> contacts_{dJointGroupCreate(0)};
  std::vector<Robot> robots_;
};

}  // namespace muster::bench
