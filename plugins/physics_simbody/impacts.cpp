// Robots that bounce. Their steps end at impacts, which take no time: all touching contacts then separate with a share
// of their approach speed (Newton's law of restitution for all contacts at once, Moreau 1988, with Coulomb's friction).
// Where friction would let that gain energy (Kane 1984), the restitution is reduced accordingly.
#include <algorithm>
#include <cmath>
#include <limits>

#include "stepper.hpp"

namespace muster::simbody {

namespace {

constexpr double slowest = 0.02;          // [m/s] slower impacts do not bounce
constexpr double touching = 1e-4;         // [m] largest gap
constexpr std::size_t most_impacts = 16;  // a robot and step; further impacts in it do not bounce
// Share of a speed that an impact leaves, by the robot's mass: it should be zero.
constexpr double softness_by_mass = 1e-8;
constexpr Search in_no_time{1e-8, 1e-4, 12, Search::First::all_sticks, true};
constexpr double never = std::numeric_limits<double>::infinity();

// Approach of two surfaces under free motion of their robots.
struct Approach {
  double gap;               // at the step's start [m]
  double stands = 0;        // the normal speed that robots carry, half a step before [m/s]
  double speed = 0;         // at the step's start
  double acceleration = 0;  // [m/s2]

  // Adds a robot's part: its present speed, and the free one half a step ahead, after a kick of (before + h) / 2.
  void add(double standing, double free, double before, double h) {
    const double change = 2 * (free - standing) / (before + h);
    stands += standing;
    speed += standing + 0.5 * before * change;
    acceleration += change;
  }

  // Time at which the gap closes fast enough to bounce [s]: now (0), later, or never within h.
  double impact(double h) const {
    if (gap < -never_so_deep) return never;
    if (gap <= touching && stands < -slowest) return 0;
    if (gap <= touching && speed <= 0) return never;  // resting contact
    const double square = speed * speed - 2 * acceleration * gap, closing = std::sqrt(std::max(0.0, square));
    if (closing <= slowest) return never;
    double time = never;
    if (speed < 0) {
      time = 2 * gap / (closing - speed);
    } else if (acceleration < 0) {
      time = -(speed + closing) / acceleration;
    }
    return time < (1 - 1e-9) * h ? time : never;
  }
};

template <int N>
double normal_speed(const ContactOf<N>& c, const std::vector<BodyOf<N>>& bodies, VelocityOf<N> BodyOf<N>::*velocity) {
  double speed = c.normal.dot(bodies[c.body].*velocity);
  if (c.other >= 0) speed += c.of_other.normal.dot(bodies[c.other].*velocity);
  return speed;
}

// Twice the energy of motion.
template <int N>
double twice_energy(const std::vector<BodyOf<N>>& bodies, VelocityOf<N> BodyOf<N>::*velocity) {
  double sum = 0;
  for (const BodyOf<N>& body : bodies) sum += (body.*velocity).dot(body.inertia->mass * (body.*velocity));
  return sum;
}

}  // namespace

template <int N>
bool StepperOf<N>::bounces(const Group& group) const {
  return std::any_of(group.robots.begin(), group.robots.end(),
                     [&](int i) { return arena_.crew[i].model.restitution > 0; });
}

// Continues the prepared step. Contacts that touch half a step ahead, but not yet (prisms turn with the cylinders that
// they represent), are examined again from nearer.
template <int N>
void StepperOf<N>::go_by_impacts(const Group& group, double h, double at, const std::vector<Command>& commands,
                                 std::vector<RobotState>& states) {
  double now = at - 0.5 * h, left = h, ahead = h;
  const auto prepare_for = [&](double time) { prepare(group, time, now + 0.5 * time, commands, states); };
  const auto go = [&](double time) {
    complete(group, time, now + 0.5 * time, commands, states);
    now += time;
    left -= time;
  };
  for (std::size_t tries = most_impacts * group.robots.size(); tries > 0; --tries) {
    const double first = first_impact(group, ahead, states);
    if (first >= ahead && ahead == left) break;
    const double time = std::min(first, ahead);
    if (time > 0) {
      if (time < ahead) prepare_for(time);
      go(time);
    }
    const bool struck = first < ahead && strike(group, now, commands, states);
    ahead = time > 0 || struck ? left : 0.5 * ahead;
    prepare_for(ahead);
  }
  if (ahead < left) prepare_for(left);
  go(left);
}

// Of the prepared step.
template <int N>
double StepperOf<N>::first_impact(const Group& group, double h, const std::vector<RobotState>& states) const {
  double first = never;
  for (std::size_t k = 0; k < encounters_.contacts.size(); ++k) {
    const Meeting& meeting = encounters_.meetings[k];
    if (meeting.restitution <= 0) continue;
    const auto& c = encounters_.contacts[k];
    Approach approach{meeting.gap};
    const auto add = [&](int place, const VelocityOf<N>& normal) {
      const int robot = group.robots[place];
      const BodyOf<N>& body = placed()[robot].body;
      approach.add(normal.dot(body.previous), normal.dot(body.free), states[robot].memory.previous_step, h);
    };
    add(c.body, c.normal);
    if (c.other >= 0) add(c.other, c.of_other.normal);
    first = std::min(first, approach.impact(h));
  }
  return first;
}

// Applies the impacts of an instant; the velocities of the robots involved are then those of the instant. True if there
// were any.
template <int N>
bool StepperOf<N>::strike(const Group& group, double at, const std::vector<Command>& commands,
                          std::vector<RobotState>& states) {
  prepare(group, 0, at, commands, states);
  bool any = false;
  for (std::size_t k = 0; k < group.robots.size(); ++k) {
    const Island& island = islands_[k];
    if (!take_impact(island)) continue;
    any = true;
    rebound();
    for (std::size_t i = 0; i < island.robots.size(); ++i) {
      const int robot = island.robots[i];
      placed()[robot].body.velocity = problem_.bodies[i].velocity;
      states[robot].memory = Memory();
      finish(robot, 0, commands[robot], states[robot]);
    }
  }
  return any;
}

// Sets up the island's touching contacts as a problem. False if none of them meets.
template <int N>
bool StepperOf<N>::take_impact(const Island& island) {
  problem_.search = in_no_time;
  problem_.bodies.clear();
  for (const int robot : island.robots) {
    problem_.bodies.push_back(placed()[robot].body);
    problem_.bodies.back().motors.fill({});  // their torque has no effect in zero time
  }
  problem_.contacts.clear();
  std::vector<double> restitution;
  bool any_meets = false;
  for (const int k : island.contacts) {
    const auto [gap, share] = encounters_.meetings[k];
    if (gap > touching || gap < -never_so_deep) continue;
    auto& c = problem_.contacts.emplace_back(encounters_.contacts[k]);
    c.body = place_[c.body];
    if (c.other >= 0) c.other = place_[c.other];
    c.softness = softness_by_mass / placed()[encounters_.traces[k].robot].mass;
    restitution.push_back(share);
    const double stands = normal_speed(c, problem_.bodies, &BodyOf<N>::previous);
    any_meets |= stands < -slowest && share > 0;
    if (std::abs(stands) > slowest) continue;
    for (const int body : {c.body, c.other}) {  // a resting contact does not fall: the ground has carried it since
      if (body >= 0) problem_.bodies[body].free = problem_.bodies[body].previous;
    }
  }
  for (std::size_t k = 0; k < restitution.size(); ++k) {
    auto& c = problem_.contacts[k];
    c.target = std::max(0.0, -restitution[k] * normal_speed(c, problem_.bodies, &BodyOf<N>::free));
  }
  return any_meets;
}

// Solves for the velocities from the free ones, without a gain of energy.
template <int N>
void StepperOf<N>::rebound() {
  using BodyN = BodyOf<N>;
  std::vector<BodyN>& bodies = problem_.bodies;
  solve_problem();
  const double before = twice_energy(bodies, &BodyN::free);
  if (twice_energy(bodies, &BodyN::velocity) <= before) return;
  // As much as possible between the plastic impact, which gains no energy, and this one: a share of the difference,
  // kept in `previous`.
  std::vector<VelocityOf<N>> elastic;
  elastic.reserve(bodies.size());
  for (const BodyN& body : bodies) elastic.push_back(body.velocity);
  for (auto& c : problem_.contacts) c.target = 0;
  solve_problem();
  double slope = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].previous = elastic[i] - bodies[i].velocity;
    slope += bodies[i].previous.dot(bodies[i].inertia->mass * bodies[i].velocity);
  }
  const double curve = twice_energy(bodies, &BodyN::previous);
  const double room = std::max(0.0, before - twice_energy(bodies, &BodyN::velocity));
  const double share = (-slope + std::sqrt(slope * slope + curve * room)) / curve;
  for (BodyN& body : bodies) body.velocity += share * body.previous;
}

template bool StepperOf<unknowns>::bounces(const Group&) const;
template bool StepperOf<unknowns_with_legs>::bounces(const Group&) const;
template void StepperOf<unknowns>::go_by_impacts(const Group&, double, double, const std::vector<Command>&,
                                                 std::vector<RobotState>&);
template void StepperOf<unknowns_with_legs>::go_by_impacts(const Group&, double, double, const std::vector<Command>&,
                                                           std::vector<RobotState>&);

}  // namespace muster::simbody
