// A robot without an engine: masses, joints, shapes and drives. Physics backends build themselves from this; nothing
// here depends on any of them.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "description/joint.hpp"
#include "description/mecanum.hpp"
#include "description/quadrotor.hpp"
#include "description/steering.hpp"

namespace muster::description {

// Mass properties in the frame of a link.
struct Mass {
  double mass = 0;                                    // [kg]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   // of mass [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about the centre of mass, axes of the frame [kg m2]
};

Mass operator+(const Mass& a, const Mass& b);

// The same mass in the parent's frame, where `frame` is the pose of its frame in the parent.
Mass in_parent(const Eigen::Isometry3d& frame, const Mass& mass);

struct Box {
  Eigen::Vector3d size;  // full edges [m]
};
struct Sphere {
  double radius;  // [m]
};
struct Cylinder {
  double radius, length;  // along z, centred [m]
};
struct Mesh {
  std::vector<Eigen::Vector3d> vertices;            // [m]
  std::vector<std::array<std::uint32_t, 3>> faces;  // counter-clockwise from outside
};

struct Shape {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  // in the link's frame
  std::variant<Box, Sphere, Cylinder, Mesh> geometry;
};

struct Link {
  std::string name;
  Mass mass;                     // mass 0: a frame only
  std::vector<Shape> shapes;     // for collisions
  std::vector<Shape> visuals{};  // for pictures; empty unless read with Meshes::visual
  int line = 0;                  // of its <link> in the URDF, for messages
};

// A wheel that a chain or gears turn at the rate of the first wheel on its side.
struct Follower {
  std::size_t joint = 0;  // index
  int side = 0;           // 0 left, 1 right
};

// At the rim of a drive's wheels [m/s], and as m/s2: with less a robot creeps, and its limits are in doubt.
inline constexpr double slowest_drive = 0.1;

// A motor on each side that turns one wheel, or all wheels of its side at one rate (skid steer); all other parts slide
// on the ground. Of a car it is the rear axle, of a mecanum drive the front one, whose followers have motors too.
struct DifferentialDrive {
  std::size_t left = 0, right = 0;  // indices of the first wheels' joints
  std::vector<Follower> followers;  // none: two wheels on one axle
  double wheel_radius = 0;          // [m]
  double wheel_base = 0;            // between the wheels' middles, left to right [m]
  // Of two wheels that turn the robot alike without slip: wheel_base, and more where wheels follow each other, since
  // these slip sideways in every turn [m].
  double effective_base = 0;
  double max_torque = 0;  // of a motor at its wheel [N m]
  double max_speed = 0;   // of a wheel [rad/s]
  double max_acceleration =
      std::numeric_limits<double>::infinity();  // of a wheel, set by the motor's controller [rad/s2]
  double friction = 0;                          // Coulomb, between wheel and ground
  std::optional<Steering> steering;             // of a car's front wheels
  std::optional<Mecanum> mecanum;               // four motors; the followers are the rear wheels, left and right

  // True if wheels that follow others turn at their rate.
  bool is_chained() const { return !followers.empty() && !mecanum; }

  // Kinematics of rigid wheels that do not slip along their way.
  double forward(double left_rate, double right_rate) const { return (left_rate + right_rate) * wheel_radius / 2; }
  double turn(double left_rate, double right_rate) const {
    return (right_rate - left_rate) * wheel_radius / effective_base;
  }
  double left_rate(double v, double w) const { return (v - w * effective_base / 2) / wheel_radius; }
  double right_rate(double v, double w) const { return (v + w * effective_base / 2) / wheel_radius; }

  // The commanded rate within the motor's limit.
  double limited_rate(double asked) const {
    return asked < -max_speed ? -max_speed : asked > max_speed ? max_speed : asked;
  }

  // All wheels, each with its side; those of `left` and `right` first.
  std::vector<Follower> wheels() const {
    std::vector<Follower> all = {{left, 0}, {right, 1}};
    all.insert(all.end(), followers.begin(), followers.end());
    return all;
  }
  // The side of the wheel on a joint, -1 if it is none of this drive.
  int side_of(std::size_t joint) const {
    for (const Follower& wheel : followers) {
      if (wheel.joint == joint) return wheel.side;
    }
    return joint == left ? 0 : joint == right ? 1 : -1;
  }
};

// Effective base of a skid steer that turns slowly, its weight the same on all wheels, with Coulomb's friction under
// each: that at which friction along the wheels and across them have no moment together. `ways` [m]: of a side's
// wheels along x from their middle. For two axles it is base (1 + (distance of axles / base)^2), whatever the weight
// and the friction. Mandow et al. (IROS 2007) measure it.
double effective_base(double wheel_base, const std::vector<double>& ways);

// Six legs, each a half circle that hangs from its hip and bulges backwards, turned whole turns by its own motor. At
// angle 0 a leg is upright on its end, two radii under the hip; positive rates carry the robot forward. Three legs are
// a tripod.
struct LegDrive {
  static constexpr std::size_t count = 6;
  struct Leg {
    std::size_t joint = 0;                          // index
    int tripod = 0;                                 // 0 or 1
    Eigen::Vector3d hip = Eigen::Vector3d::Zero();  // in the body's frame [m]
  };

  std::array<Leg, count> legs;
  double radius = 0;         // of the half circles [m]
  double position_gain = 0;  // of the motors' controllers [N m/rad]
  double rate_gain = 0;      // [N m s/rad]
  double max_torque = 0;     // of a motor at its hip [N m]
  double max_speed = 0;      // of a leg [rad/s]
  double friction = 0;       // Coulomb, between leg and ground
  // A leg as a spring and a damper along the ground's normal. Without a stiffness it is rigid.
  double stiffness = std::numeric_limits<double>::infinity();  // [N/m]
  double damping = 0;                                          // [N s/m]

  bool is_rigid() const { return stiffness == std::numeric_limits<double>::infinity(); }
  // Distance between the legs' planes, left to right [m].
  double track() const;
  // Position of a point of the half circle relative to its hip at an angle of the leg, in the body's frame [m]; `way`
  // goes from the hip (0) to the end (pi).
  Eigen::Vector3d place(double angle, double way) const;
  // The way to its lowest point; `up` in the body's frame.
  static double lowest_way(double angle, const Eigen::Vector3d& up);
};

// Rays in the x-y plane of the sensor's frame, counter-clockwise and evenly from one angle to the other, both included.
struct Laser {
  int samples = 1;
  double min_angle = 0, max_angle = 0;  // from the x axis [rad]
  double min_range = 0, max_range = 0;  // [m]
  double resolution = 0;                // to which ranges are rounded [m]; 0: they are not

  double step() const { return samples > 1 ? (max_angle - min_angle) / (samples - 1) : 0; }
};

// A sensor on a robot's body.
struct Sensor {
  std::string name;
  Eigen::Isometry3d pose;  // in the robot's frame
  double rate = 0;         // [Hz]
  Laser laser;
};

struct Robot {
  std::string name;
  std::string file;
  std::vector<Link> links;    // parents before children; the first is the root, whose frame is the robot's
  std::vector<Joint> joints;  // one for each link but the root: joints[i].child == i + 1
  std::optional<DifferentialDrive> drive;
  std::optional<LegDrive> legs;
  std::optional<Quadrotor> quadrotor;
  std::vector<Sensor> sensors;
  // Coefficient of restitution, 0 to 1; a contact of two bodies takes the smaller one. Ground and walls take that of
  // the other body; legs have 0.
  double restitution = 0;
  std::vector<std::string> warnings;  // one line each, for the user

  // False: only other bodies push it, and all its contacts stick.
  bool is_driven() const { return drive || legs || quadrotor; }
};

// Mass of the link and all that is fixed to it, in the link's frame.
Mass rigid_mass(const Robot& robot, std::size_t link);
std::vector<Shape> rigid_shapes(const Robot& robot, std::size_t link);
// Shapes of the root and all that is fixed to it, but not of steered wheels; those of a steered wheel (0 left, 1 right)
// while it is straight, with all that its kingpin turns. In the root's frame.
std::vector<Shape> body_shapes(const Robot& robot);
std::vector<Shape> steered_shapes(const Robot& robot, std::size_t side);
// All shapes of the robot, every joint at zero, in the root's frame.
std::vector<Shape> whole_shapes(const Robot& robot);

// A link's frame in the root's; null where a joint between them moves.
std::optional<Eigen::Isometry3d> frame_on_body(const Robot& robot, std::size_t link);

// The axis-aligned bounding box of a shape, in the frame in which it is placed; or of a whole robot, every joint at
// zero, in the root's frame: empty if it has neither shapes nor legs.
Eigen::AlignedBox3d bounds(const Shape& shape);
Eigen::AlignedBox3d bounds(const Robot& robot);

// A body on a joint without a motor.
struct LimbJoint {
  static constexpr int body = -1, driven = -2;  // a wheel or leg

  std::size_t joint = 0;    // index
  int carrier = body;       // a preceding limb, by its place among them, or one of the above
  Eigen::Isometry3d frame;  // of the joint, in the carrier's frame
};
std::vector<LimbJoint> limbs_of(const Robot& robot);

// The same in the form that an engine needs.
struct LimbModel {
  JointKind kind;
  int carrier;              // a preceding limb, or -1: the body
  Eigen::Isometry3d frame;  // of the joint, in the carrier
  Eigen::Vector3d axis;     // unit, in the joint's frame
  Mass mass;                // in the joint's frame, at position 0
  double lower, upper;      // [rad] or [m]
  double damping, friction;
};
LimbModel limb_model(const Robot& robot, const LimbJoint& limb);
// Properties of a joint that no engine here models; "" if there are none.
std::string unmodelled(const Joint& joint);

// Wheels by their names that do not turn, as "joint 'j' of link 'l' (FILE:LINE) is fixed, ...", or not about the
// robot's y axis; "" if there are none.
std::string wheels_that_stand(const Robot& robot);
std::string wheels_about_others(const Robot& robot);

// Mass of the whole robot, every joint at zero, in the root's frame.
Mass whole_mass(const Robot& robot);

// import: of collision shapes. skip: for callers without need of shapes; each mesh costs a child process. visual:
// import, and <visual> too, of which a mesh that cannot be read costs a warning and its link's other visuals.
enum class Meshes { import = 1, skip, visual };

// What a world declares about a URDF file.
struct UrdfSetting {
  std::string packages;  // the folder that holds ROS packages, for package://NAME/FILE; "": not declared
  std::string fittings;  // a second file of the robot, with what the first lacks: <sensor>, <gazebo>, <muster>; or ""
};

// The URDF file, or MuJoCo's (a root <mujoco>), checked; throws std::runtime_error("file:line: what is wrong; what was
// expected").
Robot read_robot(const std::string& path, Meshes meshes = Meshes::import, const UrdfSetting& setting = {});

// The file of model "scarab" (scarab.urdf in the first of the directories that has it) or "path/to/my.urdf" or ".xml"
// (absolute, or relative to one of the directories, of which the last are the world's own and come first then); throws
// with the name and the nearest valid one.
std::string find_model(const std::string& model, const std::vector<std::string>& directories);
// A model's name that two files have, in words; "" where one has it. The first is read.
std::string doubt_of_model(const std::string& model, const std::vector<std::string>& directories);

// Names of models whose file has the word in it.
std::vector<std::string> models_with(const std::string& word, const std::vector<std::string>& directories);

// Names of models whose file has the word in it.
std::vector<std::string> models_with(const std::string& word, const std::vector<std::string>& directories);

// The attributes `packages` and `fittings` of a robot, with their paths found in the directories; "" stays.
UrdfSetting find_setting(const UrdfSetting& declared, const std::vector<std::string>& directories);

}  // namespace muster::description
