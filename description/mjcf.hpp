// A robot of a MuJoCo file (MJCF): one tree of bodies, as the same description that URDF gives.
#pragma once

#include <tinyxml2.h>

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "description/urdf_check.hpp"

namespace muster::description {

// Converts the tree below <worldbody>; the outline has lines of bodies and joints. One warning of the robot lists what
// is not taken.
Robot read_mjcf(const Source& source, const tinyxml2::XMLElement& root, Meshes meshes, Outline& outline);

namespace mjcf {

// Attributes with MuJoCo's defaults: of the element, of its class, of the class of the body around it.
class Values {
 public:
  Values(const Source& source, const tinyxml2::XMLElement& root);

  struct Element {
    const tinyxml2::XMLElement* xml;
    std::string child_class;  // of the bodies around it; "" if they have none
  };

  // The text of an attribute; null if neither the element nor its class has it.
  std::optional<std::string> text(const Element& element, const char* attribute) const;
  // `count` numbers, of which fewer are allowed down to `least`.
  std::optional<std::vector<double>> numbers(const Element& element, const char* attribute, std::size_t count,
                                             std::size_t least = 0) const;
  double number(const Element& element, const char* attribute, double otherwise) const;
  Eigen::Vector3d vector(const Element& element, const char* attribute, const Eigen::Vector3d& otherwise) const;

  // A frame by pos and any of MuJoCo's ways to give a rotation.
  Eigen::Isometry3d frame(const Element& element) const;
  // True for degrees that no <compiler angle="..."> states: those of MuJoCo's default.
  bool is_degrees_by_default() const { return in_degrees_ && !states_angle_; }
  double angle(double value) const { return in_degrees_ ? value * 3.14159265358979323846 / 180 : value; }
  // What MuJoCo has with <compiler inertiafromgeom="true">: <inertial> is not used.
  bool takes_inertia_from_shapes() const { return inertia_from_shapes_; }
  const std::string& mesh_folder() const { return mesh_folder_; }

  [[noreturn]] void fail(const Element& element, const std::string& what) const;

 private:
  using Attributes = std::map<std::string, std::string>;
  using Class = std::map<std::string, Attributes>;  // by element

  void take_class(const tinyxml2::XMLElement& element, const std::string& parent);
  Eigen::Matrix3d turn(const Element& element) const;
  Eigen::Matrix3d turn_by_euler(const Element& element, const std::vector<double>& angles) const;

  const Source& source_;
  std::map<std::string, Class> classes_;
  std::string euler_ = "xyz", mesh_folder_;
  bool in_degrees_ = true, states_angle_ = false, inertia_from_shapes_ = false;
};

// A geom: its shapes in the body's frame, its mass, and whether it touches anything.
struct Geom {
  std::vector<Shape> shapes;
  std::optional<Mass> mass;  // null: a mesh without one
  bool collides = true;
};

// What is not taken, for the warning.
using NotTaken = std::set<std::string>;

Geom read_geom(const Source& source, const Values& values, const Values::Element& element, Meshes meshes,
               const std::map<std::string, const tinyxml2::XMLElement*>& mesh_assets, NotTaken& not_taken);

// Warns of turns of bodies and shapes that look like those of the other unit.
void warn_of_angles(const Source& source, const Values& values, const tinyxml2::XMLElement& root,
                    std::vector<std::string>& warnings);

}  // namespace mjcf

}  // namespace muster::description
