#include "world.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace muster::mujoco {

using description::JointKind;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

constexpr double fastest = 1e3;  // [m/s], [rad/s]: beyond, the motion has blown up
// Of the solver's cost, over the world's inertia: beyond, it only polishes what is next to rounding. So small, since
// one heavy robot makes that inertia large for all.
constexpr double settled = 1e-15;
constexpr int most_rows = 15000;  // of constraints: MuJoCo counts the bytes of a square matrix of them in an int

Vector3d vector(const double* values) { return {values[0], values[1], values[2]}; }

void put(const Vector3d& v, double* values) { std::copy(v.data(), v.data() + 3, values); }

Quaterniond turn_of(const Limb& limb) {
  const Quaterniond q(limb.qw, limb.qx, limb.qy, limb.qz);
  return q.squaredNorm() > 0 ? q.normalized() : Quaterniond::Identity();
}

}  // namespace

World::World(const std::vector<NamedRobot>& robots, const Settings& settings, const Room& room)
    : settings_(settings), room_(room) {
  for (const NamedRobot& named : robots) robots_.push_back({named.name, model_of(*named.description)});
  build();
}

void World::set_walls(const std::vector<scene::Slab>& walls) {
  walls_ = walls;
  if (settings_.obstacles) build();
}

void World::build() {
  std::vector<RobotModel> models;
  for (const Robot& robot : robots_) models.push_back(robot.model);
  if (room_.rows == 0) room_ = room_for(models);
  data_.reset();
  text_ = text_of(models, {settings_.friction, settings_.obstacles, walls_}, room_);
  model_ = compile(text_.mjcf);
  guarded([this] { data_ = data_of(model_.get()); });
  model_->opt.iterations = settings_.iterations;
  model_->opt.tolerance = settled;
  const auto id = [this](mjtObj kind, const std::string& name) { return mj_name2id(model_.get(), kind, name.c_str()); };
  shape_of_.assign(text_.surfaces.size(), 0);
  wanted_.assign(static_cast<std::size_t>(model_->nv), 0);
  for (Robot& robot : robots_) robot.wheel.clear(), robot.limb.clear();
  for (std::size_t k = 0; k < text_.surfaces.size(); ++k) {
    const int geom = id(mjOBJ_GEOM, "g" + std::to_string(k));
    shape_of_[static_cast<std::size_t>(geom)] = k;
    const Surface& surface = text_.surfaces[k];
    if (surface.steered == Surface::nobody) continue;
    robots_[static_cast<std::size_t>(surface.robot)].steered[static_cast<std::size_t>(surface.steered)] = geom;
    model_->geom_sameframe[geom] = 0;  // it moves on its body
  }
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    Robot& robot = robots_[i];
    robot.body = id(mjOBJ_BODY, body_name(i));
    robot.free = joint_of(body_name(i));
    for (std::size_t w = 0; w < robot.model.wheels.size(); ++w) {
      robot.wheel.push_back(joint_of(wheel_name(i, w)));
      if (w >= 2 && robot.model.drive.is_chained()) continue;
      model_->dof_frictionloss[robot.wheel[w].rate] = robot.model.drive.max_torque;
    }
    for (std::size_t k = 0; k < robot.model.limbs.size(); ++k) robot.limb.push_back(joint_of(limb_name(i, k)));
  }
}

World::Joint World::joint_of(const std::string& body) const {
  const int joint = model_->body_jntadr[mj_name2id(model_.get(), mjOBJ_BODY, body.c_str())];
  return {model_->jnt_qposadr[joint], model_->jnt_dofadr[joint]};
}

std::string World::step(double dt, const std::vector<Command>& commands, std::vector<RobotState>& states) {
  while (true) {
    std::vector<RobotState> stepped = states;
    try {
      std::string warning = step_in_room(dt, commands, stepped);
      states = std::move(stepped);
      return warning;
    } catch (const Full&) {  // results do not depend on the room
      room_.contacts *= 2, room_.rows *= 2;
      if (room_.rows > most_rows) throw std::runtime_error("more contacts at once than MuJoCo has memory for");
      build();
    }
  }
}

std::string World::step_in_room(double dt, const std::vector<Command>& commands, std::vector<RobotState>& states) {
  const int count = std::max(1, static_cast<int>(std::ceil(dt / settings_.step - 1e-9)));
  const double h = dt / count;
  Warnings warnings;
  guarded([&] {
    mj_resetData(model_.get(), data_.get());
    model_->opt.timestep = h;
    for (std::size_t i = 0; i < robots_.size(); ++i) place(robots_[i], states[i]);
    for (int k = 0; k < count; ++k) {
      for (std::size_t i = 0; i < robots_.size(); ++i) {
        const Robot& robot = robots_[i];
        if (robot.model.has_wheels) ask(robot, commands[i], (k + 0.5) * h);
        if (robot.model.has_wheels && robot.model.drive.steering)
          steer(robot, commands[i].steering + (k + 0.5) * h * commands[i].steering_rate);
      }
      mj_kinematics(model_.get(), data_.get());
      for (std::size_t i = 0; i < robots_.size(); ++i) {
        if (robots_[i].model.rotors) lift(robots_[i], commands[i], h, states[i]);
      }
      move(h);
    }
  });
  for (std::size_t i = 0; i < robots_.size(); ++i) read(robots_[i], states[i]);
  return warnings.first;
}

void World::place(const Robot& robot, const RobotState& s) {
  double *q = data_->qpos, *v = data_->qvel;
  const Quaterniond turned = Quaterniond(s.pose[3], s.pose[4], s.pose[5], s.pose[6]).normalized();
  const Vector3d arm = turned * robot.model.body.centre, spin = vector(s.twist.data() + 3);
  const double quaternion[] = {turned.w(), turned.x(), turned.y(), turned.z()};
  put(vector(s.pose.data()) + arm, q + robot.free.position);
  std::copy(std::begin(quaternion), std::end(quaternion), q + robot.free.position + 3);
  put(vector(s.twist.data()) + spin.cross(arm), v + robot.free.rate);
  put(turned.conjugate() * spin, v + robot.free.rate + 3);  // MuJoCo's is in the body's frame
  for (std::size_t w = 0; w < robot.wheel.size(); ++w) {
    const auto side = static_cast<std::size_t>(robot.model.wheels[w].side);
    const bool is_rear = w >= 2 && robot.model.drive.mecanum;
    const Wheel &own = robot.model.wheels[w], &first = robot.model.wheels[side];
    const bool is_turned = (own.frame.linear() * own.axis).dot(first.frame.linear() * first.axis) < 0;
    const double sign = w >= 2 && !is_rear && is_turned ? -1 : 1;
    q[robot.wheel[w].position] = sign * (is_rear ? s.rear_angle[side] : s.angle[side]);
    v[robot.wheel[w].rate] = sign * (is_rear ? s.rear_rate[side] : s.rate[side]);
  }
  for (std::size_t k = 0; k < robot.limb.size(); ++k) {
    const Limb& limb = s.limbs.limb[k];
    double *at = q + robot.limb[k].position, *rate = v + robot.limb[k].rate;
    if (robot.model.limbs[k].kind == JointKind::ball) {
      const Quaterniond turn = turn_of(limb);
      at[0] = turn.w(), at[1] = turn.x(), at[2] = turn.y(), at[3] = turn.z();
      put(turn.conjugate() * Vector3d(limb.wx, limb.wy, limb.wz), rate);
    } else if (robot.model.limbs[k].kind == JointKind::prismatic) {
      *at = limb.way, *rate = limb.speed;
    } else {
      *at = limb.angle, *rate = limb.rate;
    }
  }
}

void World::ask(const Robot& robot, const Command& command, double at) {
  const double rates[] = {command.left + at * command.left_rate, command.right + at * command.right_rate,
                          command.rear[0] + at * command.rear_rate[0], command.rear[1] + at * command.rear_rate[1]};
  const std::size_t motors = robot.model.drive.mecanum ? 4 : 2;
  for (std::size_t w = 0; w < motors; ++w)
    wanted_[static_cast<std::size_t>(robot.wheel[w].rate)] = robot.model.drive.limited_rate(rates[w]);
}

// The front wheels of a car are parts of its body: only where and along what they hold the ground changes.
void World::steer(const Robot& robot, double angle) {
  const description::Steering& car = *robot.model.drive.steering;
  for (int side = 0; side < 2; ++side) {
    const int geom = robot.steered[static_cast<std::size_t>(side)];
    put(car.middle(side, angle) - robot.model.body.centre, model_->geom_pos + 3 * geom);
    text_.surfaces[shape_of_[static_cast<std::size_t>(geom)]].along = car.axle(side, angle);
  }
}

// Rotors' rates are those in the middle of the step, the body's motion that at its start.
void World::lift(const Robot& robot, const Command& command, double h, RobotState& state) {
  const description::Quadrotor& rotors = *robot.model.rotors;
  const auto middle = rotors.later(state.rotors, command.rotors, rotors.decay(h / 2));
  const double *q = data_->qpos + robot.free.position, *rates = data_->qvel + robot.free.rate;
  const Quaterniond turned(q[3], q[4], q[5], q[6]);
  const Vector3d centre = robot.model.body.centre, w = vector(rates + 3);
  const Vector3d v = turned.conjugate() * vector(rates) - w.cross(centre);
  const auto [force, torque] = rotors.wrench(middle, v, w);
  const Vector3d about_centre = torque - centre.cross(force);
  put(turned * force, data_->xfrc_applied + 6 * robot.body);
  put(turned * about_centre, data_->xfrc_applied + 6 * robot.body + 3);
  state.rotors = rotors.later(state.rotors, command.rotors, rotors.decay(h));
}

// MuJoCo's mj_step in its parts, with contacts and the constraints' targets set between them. Forces of the bodies' own
// motion are those at the start of the step, as Euler's method has them. Constraints are those of the places in its
// middle: what rolls goes where its wheels point then, which makes rolling of second order. `mj_kinematics` is done.
void World::move(double h) {
  const mjModel* m = model_.get();
  mjData* d = data_.get();
  mj_comPos(m, d);
  mj_comVel(m, d);
  mj_passive(m, d);
  mj_rne(m, d, 0, d->qfrc_bias);
  start_.assign(d->qpos, d->qpos + m->nq);
  passive_.assign(d->qfrc_passive, d->qfrc_passive + m->nv);
  bias_.assign(d->qfrc_bias, d->qfrc_bias + m->nv);
  mj_integratePos(m, d->qpos, d->qvel, h / 2);
  mj_kinematics(m, d);
  mj_comPos(m, d);
  mj_crb(m, d);
  mj_factorM(m, d);
  mj_collision(m, d);
  touch();
  mj_makeConstraint(m, d);
  if (d->warning[mjWARN_CONTACTFULL].number || d->warning[mjWARN_CNSTRFULL].number) throw Full();
  let_roll();
  mj_fwdVelocity(m, d);
  aim(h);
  std::copy(passive_.begin(), passive_.end(), d->qfrc_passive);
  std::copy(bias_.begin(), bias_.end(), d->qfrc_bias);
  mj_fwdActuation(m, d);
  mj_fwdAcceleration(m, d);
  solve(h);
  std::copy(start_.begin(), start_.end(), d->qpos);
  mj_Euler(m, d);
}

void World::read(const Robot& robot, RobotState& s) const {
  const double *q = data_->qpos, *v = data_->qvel;
  const double *pose = q + robot.free.position, *rates = v + robot.free.rate;
  const Quaterniond turned = Quaterniond(pose[3], pose[4], pose[5], pose[6]).normalized();
  const Vector3d arm = turned * robot.model.body.centre, spin = turned * vector(rates + 3);
  const Vector3d origin = vector(pose) - arm, speed = vector(rates) - spin.cross(arm);
  const auto check = [&](const Vector3d& motion) {
    if (!(motion.cwiseAbs().maxCoeff() < fastest))
      throw std::runtime_error("robot '" + robot.name + "': its motion blew up");
  };
  check(speed), check(spin);
  s.pose = {origin.x(), origin.y(), origin.z(), turned.w(), turned.x(), turned.y(), turned.z()};
  s.twist = {speed.x(), speed.y(), speed.z(), spin.x(), spin.y(), spin.z()};
  for (std::size_t w = 0; robot.model.has_wheels && w < 2; ++w) {
    s.angle[w] = q[robot.wheel[w].position], s.rate[w] = v[robot.wheel[w].rate];
    if (!robot.model.drive.mecanum) continue;
    s.rear_angle[w] = q[robot.wheel[2 + w].position], s.rear_rate[w] = v[robot.wheel[2 + w].rate];
  }
  for (std::size_t k = 0; k < robot.limb.size(); ++k) {
    const double *at = q + robot.limb[k].position, *rate = v + robot.limb[k].rate;
    Limb& limb = s.limbs.limb[k];
    limb = {};
    if (robot.model.limbs[k].kind == JointKind::ball) {
      const Quaterniond turn = Quaterniond(at[0], at[1], at[2], at[3]).normalized();
      const Vector3d own = turn * vector(rate);
      check(own);
      limb.qw = turn.w(), limb.qx = turn.x(), limb.qy = turn.y(), limb.qz = turn.z();
      limb.wx = own.x(), limb.wy = own.y(), limb.wz = own.z();
      continue;
    }
    check({*rate, 0, 0});
    if (robot.model.limbs[k].kind == JointKind::prismatic) {
      limb.way = *at, limb.speed = *rate;
    } else {
      limb.angle = *at, limb.rate = *rate;
    }
  }
}

}  // namespace muster::mujoco
