#include "world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace muster::ode {

using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

constexpr double push_out = 0.2;        // highest speed out of penetrations [m/s]
constexpr double fastest = 1e3;         // [m/s], [rad/s]: beyond, the motion has blown up
constexpr double thinnest_wall = 0.02;  // [m]: a robot may step through less without a contact
constexpr double smooth = 0, as_the_other = std::numeric_limits<double>::infinity();  // of a surface
constexpr double sunk = 1e-4;  // [m] of a skid steer's wheels under its weight

// Collision categories. Robots are spaces of their own, whose parts do not collide.
constexpr unsigned long ground = 1, part = 2, wall = 4, tyre = 8;

dMass mass_of(const description::Mass& m) {
  dMass result;
  const auto& i = m.inertia;
  dMassSetParameters(&result, m.mass, 0, 0, 0, i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2));
  return result;
}

void set_quaternion(dBodyID body, const Quaterniond& q) {
  const dQuaternion values = {q.w(), q.x(), q.y(), q.z()};
  dBodySetQuaternion(body, values);
}

std::array<double, 3> array(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

// Position of a wheel's centre of mass in the body's frame, at an angle of the wheel.
Vector3d centre(const Wheel& wheel, double angle) {
  return wheel.frame * (Eigen::AngleAxisd(angle, wheel.axis) * wheel.mass.centre);
}

// State given by its hinge, on a body that turns with `spin` (in its own frame).
HungBody as_hinged(const Wheel& wheel, const Vector3d& body_centre, const Vector3d& spin, double angle, double rate) {
  const Vector3d hub = wheel.frame.translation(), middle = centre(wheel, angle);
  const Vector3d own = rate * (wheel.frame.linear() * wheel.axis);
  const Vector3d place = middle - body_centre;
  const Vector3d velocity = spin.cross(hub - body_centre) + (spin + own).cross(middle - hub);
  const Quaterniond q = Quaterniond(wheel.frame.linear()) * Eigen::AngleAxisd(angle, wheel.axis);
  return {array(place), {q.w(), q.x(), q.y(), q.z()}, array(velocity), array(own)};
}

// The frame of a body's mass data, from ODE's body, which is placed by its centre of mass.
Moving frame_of(dBodyID body, const description::Mass& mass) {
  const Quaterniond q = quaternion(dBodyGetQuaternion(body));
  const Vector3d place = vector(dBodyGetPosition(body)), spin = vector(dBodyGetAngularVel(body));
  const Moving centre{place, q.toRotationMatrix(), vector(dBodyGetLinearVel(body)), spin};
  const Vector3d at = place - q * mass.centre;
  return {at, centre.turned, centre.velocity_at(at), spin};
}

// States of limbs given by their joints, on a body that turns with `spin` (in its own frame).
std::vector<HungBody> as_hung(const RobotModel& robot, const Limbs& limbs, const Vector3d& spin) {
  const Vector3d centre = robot.body.centre;
  const Moving body{Vector3d::Zero(), Eigen::Matrix3d::Identity(), spin.cross(-centre), spin};
  std::vector<Moving> moving;
  std::vector<HungBody> result;
  for (std::size_t i = 0; i < robot.limbs.size(); ++i) {
    const LimbModel& limb = robot.limbs[i];
    moving.push_back(carried(limb, limbs.limb[i], limb.carrier < 0 ? body : moving[limb.carrier]));
    const Moving& now = moving.back();
    const Vector3d place = now.at + now.turned * limb.mass.centre;
    const Quaterniond q(now.turned);
    result.push_back(
        {array(place - centre), {q.w(), q.x(), q.y(), q.z()}, array(now.velocity_at(place)), array(now.spin - spin)});
  }
  return result;
}

}  // namespace

World::World(const std::vector<NamedRobot>& robots, const Settings& settings)
    : settings_(settings), world_(dWorldCreate()), space_(dHashSpaceCreate(nullptr)), contacts_(dJointGroupCreate(0)) {
  thread_.carry(world_.get());
  dWorldSetGravity(world_.get(), 0, 0, -gravity);
  dWorldSetERP(world_.get(), settings.erp);
  dWorldSetCFM(world_.get(), settings.cfm);
  dWorldSetQuickStepNumIterations(world_.get(), settings.iterations);
  dWorldSetQuickStepW(world_.get(), settings.over_relaxation);
  dWorldSetContactMaxCorrectingVel(world_.get(), push_out);
  dSpaceAdd(space_.get(), add_geom(dCreatePlane(nullptr, 0, 0, 1, 0), ground, 0, as_the_other, as_the_other));
  for (const NamedRobot& named : robots) robots_.push_back({named.name, model_of(*named.description)});
  for (Robot& robot : robots_) add(robot);
  surfaces_of_robots_ = surfaces_.size();
}

// Makes a body of this mass, whose own frame is at `frame` in the world.
dBodyID World::add_body(const description::Mass& mass, const Isometry3d& frame) const {
  dBodyID made = dBodyCreate(world_.get());
  const dMass m = mass_of(mass);
  const Vector3d at = frame * mass.centre;
  dBodySetMass(made, &m);
  dBodySetPosition(made, at.x(), at.y(), at.z());
  set_quaternion(made, Quaterniond(frame.linear()));
  dBodySetFiniteRotationMode(made, 1);
  return made;
}

// Hinges a wheel to the body, with its motor; a wheel that follows another is held at its rate as by a chain.
void World::add_wheel(Robot& robot, std::size_t w) const {
  const Wheel& wheel = robot.model.wheels[w];
  const bool follows = w >= 2 && robot.model.drive.is_chained();
  const Vector3d anchor = wheel.frame.translation(), axis = wheel.frame.linear() * wheel.axis;
  dBodyID body = add_body(wheel.mass, wheel.frame);
  dJointID hinge = dJointCreateHinge(world_.get(), nullptr);
  dJointAttach(hinge, body, robot.body);
  dJointSetHingeAnchor(hinge, anchor.x(), anchor.y(), anchor.z());
  dJointSetHingeAxis(hinge, axis.x(), axis.y(), axis.z());
  // Separate from the hinge's own motor: see README.md.
  dJointID motor = dJointCreateAMotor(world_.get(), nullptr);
  dJointAttach(motor, body, follows ? robot.wheel[static_cast<std::size_t>(wheel.side)] : robot.body);
  dJointSetAMotorNumAxes(motor, 1);
  dJointSetAMotorAxis(motor, 0, 2, axis.x(), axis.y(), axis.z());
  dJointSetAMotorParam(motor, dParamFMax, follows ? dInfinity : robot.model.drive.max_torque);
  robot.wheel.push_back(body);
  robot.hinge.push_back(hinge);
  robot.motor.push_back(motor);
}

// Bodies are placed with the robot's frame at the world's; joints and shapes keep those relative places.
void World::add(Robot& robot) {
  robot.body = add_body(robot.model.body, Isometry3d::Identity());
  for (std::size_t w = 0; w < robot.model.wheels.size(); ++w) add_wheel(robot, w);
  std::vector<Isometry3d> limbs;
  for (std::size_t i = 0; i < robot.model.limbs.size(); ++i) {
    const LimbModel& limb = robot.model.limbs[i];
    const Isometry3d carrier = limb.carrier < 0 ? Isometry3d::Identity() : limbs[limb.carrier];
    limbs.push_back(carrier * limb.frame);
    robot.limb[i] = add_body(limb.mass, limbs.back());
    join(world_.get(), limb, robot.limb[i], limb.carrier < 0 ? robot.body : robot.limb[limb.carrier], carrier);
  }
  add_shapes(robot, limbs);
}

// `limbs`: their present frames.
void World::add_shapes(Robot& robot, const std::vector<Isometry3d>& limbs) {
  dSpaceID own = dSimpleSpaceCreate(space_.get());
  const auto fix = [&](dGeomID geom, dBodyID body, const Isometry3d& pose) {  // in the world, where bodies are now
    const Quaterniond q(pose.linear());
    const dQuaternion turned = {q.w(), q.x(), q.y(), q.z()};
    dSpaceAdd(own, geom);
    dGeomSetBody(geom, body);
    dGeomSetOffsetWorldPosition(geom, pose.translation().x(), pose.translation().y(), pose.translation().z());
    dGeomSetOffsetWorldQuaternion(geom, turned);
  };
  const unsigned long others = settings_.obstacles ? part | wall : 0;
  for (std::size_t w = 0; w < robot.wheel.size(); ++w) {
    dGeomID sphere = dCreateSphere(nullptr, robot.model.drive.wheel_radius);
    fix(add_geom(sphere, tyre, ground, robot.model.drive.friction, robot.model.restitution), robot.wheel[w],
        robot.model.wheels[w].frame);
    if (robot.wheel.size() <= 2 && !robot.model.drive.steering) continue;
    soften(robot, robot.model.mass / static_cast<double>(std::max<std::size_t>(4, robot.wheel.size())));
    if (!robot.model.drive.mecanum) continue;
    surfaces_.back().frame = robot.body;
    surfaces_.back().along = description::Mecanum::hold(w);
  }
  for (std::size_t side = 0; robot.model.has_wheels && robot.model.drive.steering && side < 2; ++side) {
    const description::Steering& car = *robot.model.drive.steering;
    robot.steered[side] =
        add_geom(dCreateSphere(nullptr, car.radius), tyre, ground, robot.model.drive.friction, robot.model.restitution);
    fix(robot.steered[side], robot.body, Isometry3d(Eigen::Translation3d(car.kingpin[side] + car.hub[side])));
    soften(robot, robot.model.mass / 4);
    surfaces_.back().frame = robot.body;
    surfaces_.back().along = Vector3d::UnitY();
  }
  const auto fix_part = [&](dGeomID geom, int limb, const Isometry3d& pose) {
    limb < 0 ? fix(geom, robot.body, pose) : fix(geom, robot.limb[limb], limbs[limb] * pose);
  };
  for (const Ball& ball : robot.model.balls) {
    const double friction = robot.model.is_driven && ball.limb < 0 ? smooth : settings_.friction;
    fix_part(add_geom(dCreateSphere(nullptr, ball.radius), part, ground | others, friction, robot.model.restitution),
             ball.limb, Isometry3d(Eigen::Translation3d(ball.centre)));
  }
  for (const Block& block : robot.model.blocks) {
    dGeomID box = dCreateBox(nullptr, block.size.x(), block.size.y(), block.size.z());
    fix_part(
        add_geom(box, part, block.is_wheel ? others : ground | others, settings_.friction, robot.model.restitution),
        block.limb, block.pose);
  }
}

// The last surface: a wheel that carries this share of the robot's mass.
void World::soften(const Robot& robot, double share) {
  Surface& wheel = surfaces_.back();
  wheel.stiffness = share * gravity / sunk;
  wheel.grip = robot.model.drive.friction * share * gravity;
  wheel.damping = 2 * std::sqrt(wheel.stiffness * share);
}

// Surfaces are numbered in the order of creation: contacts are made in that order, not in ODE's.
dGeomID World::add_geom(dGeomID geom, unsigned long category, unsigned long meets, double friction,
                        double restitution) {
  dGeomSetCategoryBits(geom, category);
  dGeomSetCollideBits(geom, meets);
  surfaces_.push_back({surfaces_.size(), friction, restitution});
  dGeomSetData(geom, &surfaces_.back());
  return geom;
}

void World::set_walls(const std::vector<scene::Slab>& walls) {
  for (dGeomID old : walls_) dGeomDestroy(old);
  walls_.clear();
  while (surfaces_.size() > surfaces_of_robots_) surfaces_.pop_back();
  if (!settings_.obstacles) return;
  for (const scene::Slab& slab : walls) {
    dGeomID geom = dCreateBox(nullptr, slab.length, std::max(slab.thickness, thinnest_wall), slab.height);
    dSpaceAdd(space_.get(), add_geom(geom, wall, 0, as_the_other, as_the_other));
    dGeomSetPosition(geom, slab.x, slab.y, slab.z);
    const double half_heading = std::atan2(slab.sin_yaw, slab.cos_yaw) / 2;
    const dQuaternion turned = {std::cos(half_heading), 0, 0, std::sin(half_heading)};
    dGeomSetQuaternion(geom, turned);
    walls_.push_back(geom);
  }
}

int World::step(double dt, const std::vector<Command>& commands, std::vector<RobotState>& states, unsigned long seed) {
  const Complaints complaints;
  const int count = std::max(1, static_cast<int>(std::ceil(dt / settings_.step - 1e-9)));
  const double h = dt / count;
  h_ = h;
  for (std::size_t i = 0; i < robots_.size(); ++i) place(robots_[i], states[i]);
  for (int k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      if (robots_[i].model.has_wheels) ask(robots_[i], commands[i], (k + 0.5) * h);
      if (robots_[i].model.has_wheels && robots_[i].model.drive.steering)
        steer(robots_[i], commands[i].steering + (k + 0.5) * h * commands[i].steering_rate);
      if (robots_[i].model.rotors) lift(robots_[i], commands[i], h, states[i]);
    }
    touch();
    advance(h, seed + k);
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      for (int w = 0; robots_[i].model.has_wheels && w < 2; ++w)
        states[i].angle[w] += h * dJointGetHingeAngleRate(robots_[i].hinge[w]);
      for (int w = 0; robots_[i].model.has_wheels && robots_[i].model.drive.mecanum && w < 2; ++w)
        states[i].rear_angle[w] += h * dJointGetHingeAngleRate(robots_[i].hinge[2 + w]);
    }
  }
  for (std::size_t i = 0; i < robots_.size(); ++i) read(robots_[i], states[i]);
  return complaints.count();
}

void World::place(const Robot& robot, const RobotState& s) {
  const Quaterniond turned = Quaterniond(s.pose[3], s.pose[4], s.pose[5], s.pose[6]).normalized();
  const Vector3d origin = vector(s.pose.data()), v = vector(s.twist.data()), w = vector(s.twist.data() + 3);
  const auto put = [](dBodyID body, const Vector3d& at, const Quaterniond& q, const Vector3d& speed,
                      const Vector3d& spin) {
    dBodySetPosition(body, at.x(), at.y(), at.z());
    set_quaternion(body, q);
    dBodySetLinearVel(body, speed.x(), speed.y(), speed.z());
    dBodySetAngularVel(body, spin.x(), spin.y(), spin.z());
  };
  const Vector3d arm = turned * robot.model.body.centre, speed = v + w.cross(arm), own_spin = turned.conjugate() * w;
  put(robot.body, origin + arm, turned, speed, w);
  const auto put_hung = [&](dBodyID body, const HungBody& hung) {
    const auto& q = hung.quaternion;
    put(body, origin + arm + turned * vector(hung.place.data()), turned * Quaterniond(q[0], q[1], q[2], q[3]),
        speed + turned * vector(hung.velocity.data()), w + turned * vector(hung.spin.data()));
  };
  const auto is_known = [](const HungBody& hung) { return hung.quaternion != std::array<double, 4>{}; };
  for (std::size_t k = 0; k < robot.wheel.size(); ++k) {
    const Wheel& wheel = robot.model.wheels[k];
    const auto side = static_cast<std::size_t>(wheel.side);
    const bool is_rear = k >= 2 && robot.model.drive.mecanum;
    const HungBody kept = k < 2 ? s.hinged[k] : is_rear ? s.rear_hinged[side] : HungBody{};
    const double angle = is_rear ? s.rear_angle[side] : s.angle[side],
                 rate = is_rear ? s.rear_rate[side] : s.rate[side];
    put_hung(robot.wheel[k], is_known(kept) ? kept : as_hinged(wheel, robot.model.body.centre, own_spin, angle, rate));
  }
  if (robot.model.limbs.empty()) return;
  const std::vector<HungBody> wanted = as_hung(robot.model, s.limbs, own_spin);
  for (std::size_t k = 0; k < wanted.size(); ++k) put_hung(robot.limb[k], is_known(s.hung[k]) ? s.hung[k] : wanted[k]);
}

void World::ask(const Robot& robot, const Command& command, double at) const {
  const double rates[] = {command.left + at * command.left_rate, command.right + at * command.right_rate,
                          command.rear[0] + at * command.rear_rate[0], command.rear[1] + at * command.rear_rate[1]};
  const int motors = robot.model.drive.mecanum ? 4 : 2;
  for (int w = 0; w < motors; ++w) {
    dJointSetAMotorParam(robot.motor[w], dParamVel, robot.model.drive.limited_rate(rates[w]));
  }
}

// The front wheels of a car are parts of its body: only where and along what they hold the ground changes.
void World::steer(const Robot& robot, double angle) {
  const description::Steering& car = *robot.model.drive.steering;
  for (int side = 0; side < 2; ++side) {
    dGeomID wheel = robot.steered[static_cast<std::size_t>(side)];
    const Vector3d place = car.middle(side, angle) - robot.model.body.centre;
    dGeomSetOffsetPosition(wheel, place.x(), place.y(), place.z());
    static_cast<Surface*>(dGeomGetData(wheel))->along = car.axle(side, angle);
  }
}

// Rotors' rates are those in the middle of the step, the body's motion that at its start.
void World::lift(const Robot& robot, const Command& command, double h, RobotState& state) {
  const description::Quadrotor& rotors = *robot.model.rotors;
  const auto middle = rotors.later(state.rotors, command.rotors, rotors.decay(h / 2));
  const Quaterniond to_body = quaternion(dBodyGetQuaternion(robot.body)).conjugate();
  const Vector3d centre = robot.model.body.centre, w = to_body * vector(dBodyGetAngularVel(robot.body));
  const Vector3d v = to_body * vector(dBodyGetLinearVel(robot.body)) - w.cross(centre);
  const auto [force, torque] = rotors.wrench(middle, v, w);
  const Vector3d about_centre = torque - centre.cross(force);
  dBodyAddRelForce(robot.body, force.x(), force.y(), force.z());
  dBodyAddRelTorque(robot.body, about_centre.x(), about_centre.y(), about_centre.z());
  state.rotors = rotors.later(state.rotors, command.rotors, rotors.decay(h));
}

void World::advance(double h, unsigned long seed) {
  const bool done = settings_.quick ? quick_step(world_.get(), h, seed) : dWorldStep(world_.get(), h) != 0;
  if (!done) throw std::runtime_error("ODE has no memory left for a step");
}

void World::read(const Robot& robot, RobotState& s) {
  const Quaterniond q = quaternion(dBodyGetQuaternion(robot.body)), to_body = q.conjugate();
  const Vector3d place = vector(dBodyGetPosition(robot.body)), arm = q * robot.model.body.centre;
  const Vector3d v = vector(dBodyGetLinearVel(robot.body)), w = vector(dBodyGetAngularVel(robot.body));
  const Vector3d origin = place - arm, speed = v - w.cross(arm);
  if (!(std::max(speed.cwiseAbs().maxCoeff(), w.cwiseAbs().maxCoeff()) < fastest)) {
    throw std::runtime_error("robot '" + robot.name + "': its motion blew up");
  }
  s.pose = {origin.x(), origin.y(), origin.z(), q.w(), q.x(), q.y(), q.z()};
  s.twist = {speed.x(), speed.y(), speed.z(), w.x(), w.y(), w.z()};
  const auto hung = [&](dBodyID body) -> HungBody {
    const Quaterniond turned = to_body * quaternion(dBodyGetQuaternion(body));
    return {array(to_body * (vector(dBodyGetPosition(body)) - place)),
            {turned.w(), turned.x(), turned.y(), turned.z()},
            array(to_body * (vector(dBodyGetLinearVel(body)) - v)),
            array(to_body * (vector(dBodyGetAngularVel(body)) - w))};
  };
  for (int k = 0; robot.model.has_wheels && k < 2; ++k) {
    s.rate[k] = dJointGetHingeAngleRate(robot.hinge[k]);
    s.hinged[k] = hung(robot.wheel[k]);
    if (!robot.model.drive.mecanum) continue;
    s.rear_rate[k] = dJointGetHingeAngleRate(robot.hinge[2 + k]);
    s.rear_hinged[k] = hung(robot.wheel[2 + k]);
  }
  for (std::size_t k = 0; k < robot.model.limbs.size(); ++k) s.hung[k] = hung(robot.limb[k]);
  read_limbs(robot, s);
}

void World::read_limbs(const Robot& robot, RobotState& s) {
  const Moving body = frame_of(robot.body, robot.model.body);
  std::vector<Moving> moving;
  for (std::size_t i = 0; i < robot.model.limbs.size(); ++i) {
    const LimbModel& limb = robot.model.limbs[i];
    moving.push_back(frame_of(robot.limb[i], limb.mass));
    if (!(moving.back().spin.cwiseAbs().maxCoeff() < fastest))
      throw std::runtime_error("robot '" + robot.name + "': its motion blew up");
    s.limbs.limb[i] = hanging(limb, s.limbs.limb[i], limb.carrier < 0 ? body : moving[limb.carrier], moving.back());
  }
}

}  // namespace muster::ode
