// Robots as Simbody multibody systems: a free body, with wheels or six legs on pins or without, gravity, and flat
// ground at z = 0.
#pragma once

#include "description/robot.hpp"
#include "narrow_phase.hpp"
#include "simbody.hpp"
#include "state.hpp"

namespace muster::simbody {

// A frictionless sphere fixed to a driven body, which slides on it.
struct Slider {
  Eigen::Vector3d centre;  // in the body's frame [m]
  double radius;           // [m]
};

// A collision part of a robot: a box, sphere or cylinder in the frame of the body or limb that carries it. A mesh is
// the box around it, along the axes of its own frame. A part of a wheel moves with its tread but keeps its place.
struct Part {
  Solid solid;
  int wheel = -1;  // number: see RobotModel
  int limb = -1;
  bool is_steered = false;  // of a car's front wheel; its place is that of a straight one
};

// A wheel that turns at the rate of the first one on its side, or by its own motor (mecanum).
struct FollowingWheel {
  int side;                 // 0 left, 1 right
  description::Mass mass;   // in the wheel joint's frame
  Eigen::Isometry3d frame;  // of the joint in the body's frame
};

// A leg on its hip; see description::LegDrive.
struct Leg {
  Eigen::Vector3d hip;     // in the body's frame [m]
  description::Mass mass;  // about the hip at angle 0, axes of the body
};

// A body on a joint without a motor.
struct LimbModel : description::LimbModel {
  int first;         // of its unknowns
  double reach = 0;  // radius about its joint of the collision parts of it and its followers; 0: none [m]

  // Largest displacement by its joint from position 0 [m].
  double travel() const;
};

// A robot that this backend can model; throws std::runtime_error for any other.
struct RobotModel {
  explicit RobotModel(const description::Robot& robot);

  // True if its mass matrix changes from step to step.
  bool is_articulated() const { return !legs.empty() || !limbs.empty(); }

  // True if it has twelve unknowns, not eight.
  bool has_many_joints() const { return is_articulated() || (has_wheels && drive.mecanum); }

  // True if the ground touches the part itself: a wheel has its sphere, a slider no friction.
  bool stands_on(const Part& part) const {
    return part.wheel < 0 && !part.is_steered &&
           (part.solid.kind != Solid::Kind::sphere || !is_driven || part.limb >= 0);
  }

  // Wheels are numbered: left, right, followers.
  int wheel_count() const { return has_wheels ? 2 + static_cast<int>(followers.size()) : 0; }
  int side_of(int number) const { return number < 2 ? number : followers[static_cast<std::size_t>(number) - 2].side; }
  // The joint, among a robot's, whose rate turns it.
  int joint_of(int number) const { return drive.mecanum ? number : side_of(number); }
  double wheel_inertia_of(int number) const {  // about the axle
    const auto i = static_cast<std::size_t>(number);
    return number < 2 ? wheel[i].inertia(2, 2) : followers[i - 2].mass.inertia(2, 2);
  }
  Eigen::Vector3d hub_of(int number) const {
    return number < 2 ? wheel_frame[static_cast<std::size_t>(number)].translation()
                      : followers[static_cast<std::size_t>(number) - 2].frame.translation();
  }

  // True if a limb has collision parts.
  bool feels_limbs() const;

  // Height of the lowest corner of the parts on the ground, and of the lowest point of its sliders too, relative to the
  // body's origin; `up` in the body's frame [m].
  double lowest_corner(const Eigen::Vector3d& up) const;
  double lowest_point(const Eigen::Vector3d& up) const;

  std::string name;
  bool is_driven = true;
  bool has_wheels = true;  // false: the wheels' fields below are unused
  description::DifferentialDrive drive;
  std::optional<description::Quadrotor> rotors;
  description::Mass body;                        // mass of the root and all that is fixed to it, in its frame
  std::array<description::Mass, 2> wheel;        // in the wheel joint's frame
  std::array<Eigen::Isometry3d, 2> wheel_frame;  // of the joints in the body's frame
  std::vector<FollowingWheel> followers;         // of a skid steer; rear wheels of a mecanum drive
  double restitution = 0;
  description::LegDrive leg_drive;
  std::vector<Leg> legs;  // none: on wheels
  std::vector<LimbModel> limbs;
  description::Mass core;  // body and wheels
  std::vector<Slider> sliders;
  std::vector<Part> parts;
  Eigen::Vector3d arm;     // largest distances of parts from the body's x, y and z axes [m]
  Eigen::Vector3d middle;  // of a sphere around all parts, in the body's frame [m]
  double reach = 0;        // its radius [m]

 private:
  void take_wheels(const description::Robot& robot);
  void take_legs(const description::Robot& robot);
  void take_limbs(const description::Robot& robot);
  void measure_limbs();
  void measure();
};

struct RobotBodies {
  SimTK::MobilizedBody::Free body;
  std::array<SimTK::MobilizedBody::Pin, 2> wheel;  // of a robot on wheels; its followers come right after them
  std::vector<SimTK::MobilizedBody::Pin> legs;
  std::vector<SimTK::MobilizedBody> limbs;
};

// Copies a limb's state to and from a state of the system.
void set_limb(const SimTK::MobilizedBody& body, const LimbModel& model, const Limb& limb, SimTK::State& state);
void get_limb(const SimTK::MobilizedBody& body, const LimbModel& model, const SimTK::State& state, Limb& limb);

// The system owns all that is added to it; state() is realised through Model after finish().
struct System {
  System();
  RobotBodies add(const RobotModel& model);
  void finish();

  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter;
  SimTK::GeneralForceSubsystem forces;
  SimTK::State state;
};

}  // namespace muster::simbody
