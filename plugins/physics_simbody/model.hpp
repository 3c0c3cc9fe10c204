// Robots as Simbody multibody systems: a free body, with two wheels or six legs on pins or without, gravity, and flat
// ground at z = 0.
#pragma once

#include "description/robot.hpp"
#include "narrow_phase.hpp"
#include "simbody.hpp"
#include "state.hpp"

namespace muster::simbody {

// A smooth sphere fixed to a body that is driven, on which it slides.
struct Slider {
  Eigen::Vector3d centre;  // in the body's frame [m]
  double radius;           // [m]
};

// What of a robot can be touched: a box, sphere or cylinder in the frame of the body, or of the limb that it belongs
// to. A mesh is the box around it, along the axes of its own frame; what belongs to a wheel moves with its tread but
// keeps its place.
struct Part {
  Solid solid;
  int wheel = -1;  // 0 left, 1 right
  int limb = -1;
};

// A leg on its hip; see description::LegDrive.
struct Leg {
  Eigen::Vector3d hip;     // in the body's frame [m]
  description::Mass mass;  // about the hip at angle 0, axes of the body
};

// What hangs on a joint that no motor turns.
struct LimbModel : description::LimbModel {
  int first;         // of its unknowns
  double reach = 0;  // from its joint, of what of it and of what it carries can be touched; 0: nothing can [m]

  // How far its joint lets it go from where it stands at 0 [m].
  double travel() const;
};

// What of a robot this backend can hold; throws std::runtime_error for any other.
struct RobotModel {
  explicit RobotModel(const description::Robot& robot);

  // Whether its mass is another in each step.
  bool is_articulated() const { return !legs.empty() || !limbs.empty(); }

  // Whether it is the part itself that the ground feels: a wheel has its sphere, a slider no friction.
  bool stands_on(const Part& part) const {
    return part.wheel < 0 && (part.solid.kind != Solid::Kind::sphere || !is_driven || part.limb >= 0);
  }

  // Whether a limb can be touched.
  bool feels_limbs() const;

  // Height of the body's lowest corner of what it stands on above its origin, and of the lowest point of its sliders
  // too; `up` in the body's frame [m].
  double lowest_corner(const Eigen::Vector3d& up) const;
  double lowest_point(const Eigen::Vector3d& up) const;

  std::string name;
  bool is_driven = true;
  bool has_wheels = true;  // else what is said of them below is nothing
  description::DifferentialDrive drive;
  std::optional<description::Quadrotor> rotors;
  description::Mass body;                        // all that is rigid with the root, in its frame
  std::array<description::Mass, 2> wheel;        // in the wheel joint's frame
  std::array<Eigen::Isometry3d, 2> wheel_frame;  // of the joints in the body's frame
  double restitution = 0;
  description::LegDrive leg_drive;
  std::vector<Leg> legs;  // none: on wheels
  std::vector<LimbModel> limbs;
  description::Mass core;  // body and wheels
  std::vector<Slider> sliders;
  std::vector<Part> parts;
  Eigen::Vector3d arm;     // how far they reach from the body's x, y and z axes [m]
  Eigen::Vector3d middle;  // of a sphere that holds them all, in the body's frame [m]
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
  std::array<SimTK::MobilizedBody::Pin, 2> wheel;  // of a robot on wheels
  std::vector<SimTK::MobilizedBody::Pin> legs;
  std::vector<SimTK::MobilizedBody> limbs;
};

// A limb in a state of the system, and back.
void set_limb(const SimTK::MobilizedBody& body, const LimbModel& model, const Limb& limb, SimTK::State& state);
void get_limb(const SimTK::MobilizedBody& body, const LimbModel& model, const SimTK::State& state, Limb& limb);

// The system keeps what is added to it alive; state() is realised through Model once finish() was called.
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
