// Contacts of a robot in a step, for the solver: the ground under its wheels, legs and sliders, walls, other robots.
#pragma once

#include "contact_solver.hpp"
#include "legs.hpp"
#include "limbs.hpp"
#include "model.hpp"
#include "scene/slabs.hpp"
#include "state.hpp"

namespace muster::simbody {

// A robot half a step ahead.
template <int N>
struct PlacedOf {
  const RobotModel* model = nullptr;
  int index = 0;  // among all robots
  double mass = 0;
  std::array<double, 4> turned;  // quaternion, body to world; not quite of unit length
  Eigen::Matrix3d to_world;
  Eigen::Vector3d position;
  InertiaOf<N> inertia;
  BodyOf<N> body;             // its velocities before the solve
  LegAngles leg_angle;        // of a walking robot
  double steering = 0;        // of a car [rad]
  Posture posture;            // of one with limbs, at the step's start
  Posture posture_ahead;      // the same, half a step ahead; if limbs can be touched
  double speed = 0;           // upper bound over its parts [m/s]
  std::vector<Solid> solids;  // its parts in the world; filled if something is near
};

using Placed = PlacedOf<unknowns>;

// [m] Limit of penetration. A deeper one at a step's start has switched from the face that separated the solids so far,
// as at corners that pass each other within half a step.
constexpr double never_so_deep = 5e-4;

// Storage of a contact's impulse from step to step.
struct Trace {
  // For contacts with the ground, which need no frame.
  explicit Trace(int of, int on_wheel = -1) : robot(of), wheel(on_wheel) {}
  Trace(int of, double kept_as, const Eigen::Matrix3d& about) : robot(of), id(kept_as), frame(about) {}

  int robot;
  int wheel = -1;  // on the ground: 0 left, 1 right
  double id = 0;   // of others; 0: not kept; below 0: the ground under a wheel that follows another, or is steered
  bool step_is_too_long = false;  // for this contact
  Eigen::Matrix3d frame;          // normal and tangents as columns, in the world
};

// Data of a contact for robots that bounce.
struct Meeting {
  double gap;  // at the step's start [m]
  double restitution;
};

template <int N>
class EncountersOf {
 public:
  using Contact = ContactOf<N>;
  using Placed = PlacedOf<N>;

  // Starts a step of length h [s]; friction as between bodies; whether to note meetings. With h = 0, an instant,
  // springs give no force, and targets of other contacts are undefined.
  void begin(double h, double friction, bool somebody_bounces);

  // `body`: the robot's number in the contacts; their traces have its index.
  void with_ground(int body, const Placed& robot, const Memory& memory);
  void with_wall(int body, const Placed& robot, const Memory& memory, int wall_index, const Solid& wall);
  void between(int body_a, const Placed& a, const Memory& memory_a, int body_b, const Placed& b);

  std::vector<Contact> contacts;
  std::vector<Trace> traces;      // one a contact
  std::vector<Meeting> meetings;  // the same number, or none

 private:
  struct Side {
    const Placed* robot = nullptr;
    int body = -1;
    int wheel = -1, leg = -1, limb = -1;  // the touching part; all -1: the body
  };

  static Side side(int body, const Placed& robot, const Part& part) {
    return {&robot, body, part.wheel, -1, part.limb};
  }

  double margin(double speed) const;
  void add(const Side& a, const Side& b, Trace trace, const Memory& memory, const TouchPoint& point);
  void stand(int body, const Placed& robot, const Memory& memory);
  void hold(const Placed& robot, const Eigen::Vector3d& arm, const Eigen::Vector3d& along, int wheel,
            const Memory& memory, Contact& contact);
  void stand_on_legs(int body, const Placed& robot, const Memory& memory);
  template <class Meet>
  void each_leg_at(const Placed& robot, const Solid& solid, double margin, Meet meet) const;

  double h_ = 0, friction_ = 0;
  bool somebody_bounces_ = false;
};

// The row for the speed along `direction` of the body's point `arm`, all in the body's frame.
template <int N>
VelocityOf<N> point_row(const Eigen::Vector3d& arm, const Eigen::Vector3d& direction) {
  VelocityOf<N> row = VelocityOf<N>::Zero();
  row.template head<3>() = arm.cross(direction);
  row.template segment<3>(3) = direction;
  return row;
}

using ContactDetection = EncountersOf<unknowns>;

Solid solid_of(const scene::Slab& slab);

// Moves the robot's parts to its pose.
template <int N>
void place_parts(PlacedOf<N>& robot);

// Stores the impulse of a contact by its trace.
template <int N>
void keep(const ContactOf<N>& contact, const Trace& trace, Memory& memory);

}  // namespace muster::simbody
