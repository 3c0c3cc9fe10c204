#include "simbody_integrators.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace muster::simbody {

using SimTK::MobilizedBody;
using SimTK::Real;
using SimTK::Vec3;

namespace {

constexpr double constraint_tolerance = 1e-9;
constexpr double accuracy = 1e-6;  // of the adaptive ones

// Commanded rate of a wheel over a tick.
struct Course {
  const description::DifferentialDrive* drive = nullptr;
  double rate = 0, slope = 0;  // [rad/s] at the tick's start, [rad/s2]

  double at(double t) const { return drive->limited_rate(rate + slope * t); }
  double slope_at(double t) const { return at(t) == rate + slope * t ? slope : 0; }
};

class WheelMotion : public SimTK::Motion::Custom::Implementation {
 public:
  explicit WheelMotion(const Course& course) : course_(course) {}
  WheelMotion* clone() const override { return new WheelMotion(*this); }
  SimTK::Motion::Level getLevel(const SimTK::State&) const override { return SimTK::Motion::Velocity; }
  void calcPrescribedVelocity(const SimTK::State& s, int, Real* u) const override { u[0] = course_.at(s.getTime()); }
  void calcPrescribedVelocityDot(const SimTK::State& s, int, Real* udot) const override {
    udot[0] = course_.slope_at(s.getTime());
  }

 private:
  const Course& course_;
};

std::unique_ptr<SimTK::Integrator> make(Integrator kind, const SimTK::System& system, double step) {
  std::unique_ptr<SimTK::Integrator> integrator;
  if (kind == Integrator::rk3) {
    integrator = std::make_unique<SimTK::RungeKutta3Integrator>(system);
    integrator->setFixedStepSize(step);
    integrator->setAccuracy(0.1);  // a fixed step ignores its error estimate
  } else {
    if (kind == Integrator::rkm) {
      integrator = std::make_unique<SimTK::RungeKuttaMersonIntegrator>(system);
    } else {
      integrator = std::make_unique<SimTK::CPodesIntegrator>(system, SimTK::CPodes::BDF, SimTK::CPodes::Newton);
    }
    integrator->setAccuracy(accuracy);
  }
  integrator->setConstraintTolerance(constraint_tolerance);
  integrator->setAllowInterpolation(false);  // otherwise the state at the tick's end is interpolated
  integrator->setProjectEveryStep(true);
  return integrator;
}

}  // namespace

struct SimbodyIntegrators::Robot {
  explicit Robot(const NamedRobot& named) : name(named.name), model(*named.description) {
    if (!model.legs.empty())
      throw std::runtime_error("robot '" + name + "' walks; Simbody's own integrators roll on wheels: use midpoint");
    if (!model.has_wheels)
      throw std::runtime_error("robot '" + name + "' has no wheels: integrator=\"midpoint\" moves it");
    if (model.drive.steering || model.drive.mecanum)
      throw std::runtime_error(
          "robot '" + name + "' steers or has rollers, which Simbody's own integrators here do not have: use midpoint");
    if (!model.followers.empty())
      throw std::runtime_error(
          "robot '" + name +
          "' turns by slip of its wheels, which Simbody's own integrators do not have: use midpoint");
    if (model.restitution > 0)
      throw std::runtime_error("robot '" + name +
                               "' bounces; Simbody's own integrators keep wheels on the ground: use midpoint");
    bodies = system.add(model);
    MobilizedBody& ground = system.matter.updGround();
    const SimTK::Transform floor;  // its z points up
    for (std::size_t w = 0; w < 2; ++w) {
      course[w].drive = &model.drive;
      const SimTK::Motion::Custom turns(bodies.wheel[w], new WheelMotion(course[w]));
      const SimTK::Constraint::SphereOnPlaneContact rolls(ground, floor, bodies.wheel[w], Vec3(0),
                                                          model.drive.wheel_radius, true);
    }
    // A third support point: the lowest of its sliders.
    if (model.sliders.empty()) throw std::runtime_error("robot '" + name + "' would stand on two wheels only");
    const auto lowest = std::min_element(
        model.sliders.begin(), model.sliders.end(),
        [](const Slider& a, const Slider& b) { return a.centre.z() - a.radius < b.centre.z() - b.radius; });
    for (std::size_t i = 0; i < model.limbs.size(); ++i) hang(model.limbs[i], bodies.limbs[i]);
    const Vec3 centre(lowest->centre.x(), lowest->centre.y(), lowest->centre.z());
    const SimTK::Constraint::SphereOnPlaneContact slides(ground, floor, bodies.body, centre, lowest->radius, false);
    system.finish();
  }

  void hang(const LimbModel& limb, SimTK::MobilizedBody& body) {
    const bool has_stops = std::isfinite(limb.lower) || std::isfinite(limb.upper);
    if (limb.friction > 0 || has_stops || (limb.damping > 0 && limb.kind == description::JointKind::ball)) {
      throw std::runtime_error("robot '" + name +
                               "' has a limb with a limit or a friction, or a ball with a damping: Simbody's own "
                               "integrators here have none; use midpoint");
    }
    if (limb.damping > 0)
      SimTK::Force::MobilityLinearDamper(system.forces, body, SimTK::MobilizerUIndex(0), limb.damping);
  }

  std::string name;
  RobotModel model;
  std::array<Course, 2> course;
  System system;
  RobotBodies bodies;
};

SimbodyIntegrators::SimbodyIntegrators(const std::vector<NamedRobot>& robots, Integrator integrator, double step)
    : integrator_(integrator), step_(step) {
  for (const NamedRobot& robot : robots) robots_.push_back(std::make_unique<Robot>(robot));
}

SimbodyIntegrators::~SimbodyIntegrators() = default;

void SimbodyIntegrators::step(double dt, const std::vector<Command>& commands, std::vector<RobotState>& states,
                              const Each& each) {
  each(robots_.size(), [&](std::size_t i) {
    Robot& robot = *robots_[i];
    RobotState& s = states[i];
    const double asked[] = {commands[i].left, commands[i].right};
    const double slopes[] = {commands[i].left_rate, commands[i].right_rate};
    SimTK::State state = robot.system.state;
    state.setTime(0);
    for (int k = 0; k < 4; ++k) state.updQ()[k] = s.pose[3 + k];
    for (int k = 0; k < 3; ++k) {
      state.updQ()[4 + k] = s.pose[k];
      state.updU()[k] = s.twist[3 + k];
      state.updU()[3 + k] = s.twist[k];
    }
    for (int w = 0; w < 2; ++w) {
      robot.course[w] = {&robot.model.drive, asked[w], slopes[w]};
      state.updQ()[7 + w] = s.angle[w];
      state.updU()[6 + w] = s.rate[w];
    }
    const auto& limbs = robot.model.limbs;
    for (std::size_t k = 0; k < limbs.size(); ++k) set_limb(robot.bodies.limbs[k], limbs[k], s.limbs.limb[k], state);
    try {
      const auto integrator = make(integrator_, robot.system.system, std::min(step_, dt));
      integrator->initialize(state);
      while (integrator->getTime() < dt) integrator->stepTo(dt);
      state = integrator->getState();
    } catch (const std::exception& error) {
      throw std::runtime_error("robot '" + robot.name + "': Simbody's integrator failed: " + error.what());
    }
    for (int k = 0; k < 4; ++k) s.pose[3 + k] = state.getQ()[k];
    for (int k = 0; k < 3; ++k) {
      s.pose[k] = state.getQ()[4 + k];
      s.twist[3 + k] = state.getU()[k];
      s.twist[k] = state.getU()[3 + k];
    }
    for (int w = 0; w < 2; ++w) {
      s.angle[w] = state.getQ()[7 + w];
      s.rate[w] = state.getU()[6 + w];
    }
    for (std::size_t k = 0; k < limbs.size(); ++k) get_limb(robot.bodies.limbs[k], limbs[k], state, s.limbs.limb[k]);
    s.memory = Memory();
  });
}

}  // namespace muster::simbody
