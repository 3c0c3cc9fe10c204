// Robots as Simbody multibody systems: a free body with two wheels on pins, gravity, and flat ground at z = 0.
#pragma once

#include "description/robot.hpp"
#include "simbody.hpp"

namespace muster::simbody {

// A smooth sphere fixed to the body, on which it slides.
struct Slider {
  Eigen::Vector3d centre;  // in the body's frame [m]
  double radius;           // [m]
};

// What of a robot this backend can hold; throws std::runtime_error for any other.
struct RobotModel {
  explicit RobotModel(const description::Robot& robot);

  std::string name;
  description::DifferentialDrive drive;
  description::Mass body;                        // all that is rigid with the root, in its frame
  std::array<description::Mass, 2> wheel;        // in the wheel joint's frame
  std::array<Eigen::Isometry3d, 2> wheel_frame;  // of the joints in the body's frame
  std::vector<Slider> sliders;
};

struct RobotBodies {
  SimTK::MobilizedBody::Free body;
  std::array<SimTK::MobilizedBody::Pin, 2> wheel;
};

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
