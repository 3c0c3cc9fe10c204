#include "model.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace muster::mujoco {

using description::JointKind;
using description::LimbModel;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace {

constexpr double thinnest_wall = 0.02;  // [m]: a robot may step through less without a contact
constexpr double smooth = 0, as_the_other = std::numeric_limits<double>::infinity();  // of a surface
constexpr double no_limit = 1e9;  // [rad], [m]: for MuJoCo, which reads no infinity

// Masks of collision: a pair is looked at where one's kind is in what the other one meets.
constexpr int ground = 1, part = 2, wall = 4;

// The shortest text that gives the same bits, whatever the locale.
std::string number(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + number(value);
  return text;
}

std::string vector(const Vector3d& v) { return numbers({v.x(), v.y(), v.z()}); }

std::string place(const Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  return " pos='" + vector(pose.translation()) + "' quat='" + numbers({q.w(), q.x(), q.y(), q.z()}) + "'";
}

std::string inertial(const description::Mass& m, const Vector3d& centre) {
  const auto& i = m.inertia;
  return "<inertial pos='" + vector(centre) + "' mass='" + number(m.mass) + "' fullinertia='" +
         numbers({i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2)}) + "'/>";
}

class Writer {
 public:
  Writer(const std::vector<RobotModel>& robots, const Surroundings& around) : robots_(robots), around_(around) {}

  Text write(const Room& room) {
    std::string bodies = shape("plane", "size='0 0 1'", ground, 0, {Surface::nobody, as_the_other, as_the_other});
    for (const scene::Slab& slab : around_.obstacles ? around_.walls : std::vector<scene::Slab>{})
      bodies += stand(slab);
    for (std::size_t i = 0; i < robots_.size(); ++i) bodies += robot(i);
    std::string chains;
    for (std::size_t i = 0; i < robots_.size(); ++i) chains += chain(i);
    // Hardest constraints: what they are to reach is set in each step.
    constexpr const char* hard = "='0.9999 0.9999 0.001'";
    made_.mjcf =
        "<mujoco model='muster'><compiler angle='radian' inertiafromgeom='false' boundmass='0' boundinertia='0' "
        "balanceinertia='false' fusestatic='false' discardvisual='false'/><size nconmax='" +
        std::to_string(room.contacts) + "' njmax='" + std::to_string(room.rows) + "'/><option gravity='0 0 " +
        number(-gravity) +
        "' cone='elliptic' solver='Newton' integrator='Euler' jacobian='auto'/><default><geom solimp" + hard +
        " condim='3' margin='" + number(margin) + "'/><joint limited='false' solimplimit" + hard + " solimpfriction" +
        hard + "/><equality solimp" + hard + "/></default><worldbody>" + bodies + "</worldbody><equality>" + chains +
        "</equality></mujoco>";
    return std::move(made_);
  }

 private:
  static constexpr double margin = 0.005;  // [m]: contacts are seen before they close

  // A shape; `where`: its attributes of place and size.
  std::string shape(const std::string& type, const std::string& where, int kind, int meets, Surface surface) {
    const std::string name = "g" + std::to_string(made_.surfaces.size());
    made_.surfaces.push_back(std::move(surface));
    return "<geom name='" + name + "' type='" + type + "' contype='" + std::to_string(kind) + "' conaffinity='" +
           std::to_string(meets) + "' " + where + "/>";
  }

  std::string stand(const scene::Slab& slab) {
    Isometry3d pose(Eigen::Translation3d(slab.x, slab.y, slab.z));
    pose.linear() << slab.cos_yaw, -slab.sin_yaw, 0, slab.sin_yaw, slab.cos_yaw, 0, 0, 0, 1;
    const Vector3d half(slab.length / 2, std::max(slab.thickness, thinnest_wall) / 2, slab.height / 2);
    return shape("box", "size='" + vector(half) + "'" + place(pose), wall, 0,
                 {Surface::nobody, as_the_other, as_the_other});
  }

  std::string tyre(double radius, const Vector3d& at, Surface surface) {
    return shape("sphere", "size='" + number(radius) + "' pos='" + vector(at) + "'", 0, ground, std::move(surface));
  }

  std::string robot(std::size_t i) {
    const RobotModel& model = robots_[i];
    std::string text =
        "<body name='" + body_name(i) + "'><freejoint/>" + inertial(model.body, Vector3d::Zero()) + parts(i, -1);
    for (std::size_t w = 0; w < model.wheels.size(); ++w) text += wheel(i, w);
    if (model.has_wheels && model.drive.steering) {
      const description::Steering& car = *model.drive.steering;
      for (int side = 0; side < 2; ++side) {
        Surface surface = own(i, model.drive.friction);
        surface.holds_along = true, surface.steered = side, surface.carries = model.mass / 4;
        text += tyre(car.radius, moved(i, -1, car.middle(side, 0)), surface);
      }
    }
    return text + limbs(i, -1) + "</body>";
  }

  // Places of what a carrier bears (-1: the body). The body's frame is in its centre of mass, whose velocity is then
  // one of MuJoCo's coordinates: in the air it keeps the momentum.
  Vector3d moved(std::size_t i, int carrier, const Vector3d& place) const {
    return carrier < 0 ? Vector3d(place - robots_[i].body.centre) : place;
  }
  Isometry3d moved(std::size_t i, int carrier, Isometry3d frame) const {
    frame.translation() = moved(i, carrier, Vector3d(frame.translation()));
    return frame;
  }

  Surface own(std::size_t i, double friction) const { return {static_cast<int>(i), friction, robots_[i].restitution}; }

  std::string wheel(std::size_t i, std::size_t w) {
    const RobotModel& model = robots_[i];
    const Wheel& one = model.wheels[w];
    Surface surface = own(i, model.drive.friction);
    const std::size_t wheels = model.wheels.size();
    if (wheels > 2 || model.drive.steering)
      surface.carries = model.mass / static_cast<double>(std::max<std::size_t>(4, wheels));
    if (model.drive.mecanum) surface.holds_along = true, surface.along = description::Mecanum::hold(w);
    return "<body name='" + wheel_name(i, w) + "'" + place(moved(i, -1, one.frame)) + "><joint type='hinge' name='" +
           wheel_name(i, w) + "' axis='" + vector(one.axis) + "'/>" + inertial(one.mass, one.mass.centre) +
           tyre(model.drive.wheel_radius, Vector3d::Zero(), surface) + "</body>";
  }

  // Limbs that the carrier bears, with theirs.
  std::string limbs(std::size_t i, int carrier) {
    const RobotModel& model = robots_[i];
    std::string text;
    for (std::size_t k = 0; k < model.limbs.size(); ++k) {
      const LimbModel& limb = model.limbs[k];
      if (limb.carrier != carrier) continue;
      text += "<body name='" + limb_name(i, k) + "'" + place(moved(i, carrier, limb.frame)) + ">" +
              joint(limb, limb_name(i, k)) + inertial(limb.mass, limb.mass.centre) + parts(i, static_cast<int>(k)) +
              limbs(i, static_cast<int>(k)) + "</body>";
    }
    return text;
  }

  static std::string joint(const LimbModel& limb, const std::string& name) {
    std::string text = "<joint name='" + name + "' damping='" + number(limb.damping) + "' frictionloss='" +
                       number(limb.friction) + "'";
    if (limb.kind == JointKind::ball) return text + " type='ball'/>";
    text += std::string(" type='") + (limb.kind == JointKind::prismatic ? "slide" : "hinge") + "' axis='" +
            vector(limb.axis) + "'";
    if (std::isfinite(limb.lower) || std::isfinite(limb.upper)) {
      text += " limited='true' margin='" + number(margin) + "' range='" +
              numbers({std::max(limb.lower, -no_limit), std::min(limb.upper, no_limit)}) + "'";
    }
    return text + "/>";
  }

  std::string parts(std::size_t i, int limb) {
    const RobotModel& model = robots_[i];
    const int others = around_.obstacles ? part | wall : 0, kind = around_.obstacles ? part : 0;
    std::string text;
    for (const rigid::Ball& ball : model.balls) {
      if (ball.limb != limb) continue;
      const double friction = model.is_driven && limb < 0 ? smooth : around_.friction;
      text += shape("sphere", "size='" + number(ball.radius) + "' pos='" + vector(moved(i, limb, ball.centre)) + "'",
                    kind, ground | others, own(i, friction));
    }
    for (const rigid::Block& block : model.blocks) {
      if (block.limb != limb) continue;
      text += shape("box", "size='" + vector(block.size / 2) + "'" + place(moved(i, limb, block.pose)), kind,
                    block.is_wheel ? others : ground | others, own(i, around_.friction));
    }
    return text;
  }

  // Wheels that follow the first one of their side.
  std::string chain(std::size_t i) const {
    const RobotModel& model = robots_[i];
    std::string text;
    for (std::size_t w = 2; w < model.wheels.size() && model.drive.is_chained(); ++w) {
      const auto first = static_cast<std::size_t>(model.wheels[w].side);
      const auto axle = [&](std::size_t k) -> Vector3d {
        return model.wheels[k].frame.linear() * model.wheels[k].axis;
      };
      const std::string ratio = axle(w).dot(axle(first)) > 0 ? "1" : "-1";
      text += "<joint joint1='" + wheel_name(i, w) + "' joint2='" + wheel_name(i, first) + "' polycoef='0 " + ratio +
              " 0 0 0'/>";
    }
    return text;
  }

  const std::vector<RobotModel>& robots_;
  const Surroundings& around_;
  Text made_;
};

}  // namespace

std::string body_name(std::size_t robot) { return "r" + std::to_string(robot); }
std::string wheel_name(std::size_t robot, std::size_t wheel) { return body_name(robot) + "w" + std::to_string(wheel); }
std::string limb_name(std::size_t robot, std::size_t limb) { return body_name(robot) + "l" + std::to_string(limb); }

RobotModel model_of(const description::Robot& robot) {
  std::vector<std::string> reasons = rigid::lacks(robot, [](const description::Joint&) { return std::string(); });
  if (robot.restitution > 0 && robot.drive)
    reasons.push_back(
        "it bounces on wheels, whose motors act within the impact here (physics.simbody takes such robots)");
  rigid::refuse(robot, "physics.mujoco", reasons);
  return RobotModel(robot);
}

Text text_of(const std::vector<RobotModel>& robots, const Surroundings& around, const Room& room) {
  return Writer(robots, around).write(room);
}

Room room_for(const std::vector<RobotModel>& robots) {
  Room room{16, 0};
  for (const RobotModel& robot : robots) {
    const std::size_t corners = 4 * std::min<std::size_t>(robot.blocks.size(), 2);
    room.contacts += static_cast<int>(robot.wheels.size() + robot.balls.size() + corners + 2);
    room.rows += static_cast<int>(robot.wheels.size() + 4 * robot.limbs.size());
  }
  room.rows += 3 * room.contacts;
  return room;
}

}  // namespace muster::mujoco
