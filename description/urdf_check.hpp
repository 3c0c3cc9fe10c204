// What urdfdom takes without a word, checked beforehand on the XML itself, where the lines are known.
#pragma once

#include <tinyxml2.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "description/robot.hpp"

namespace muster::description {

// A place in a URDF file, to complain about.
struct Source {
  std::string file;
  [[noreturn]] void fail(int line, const std::string& message) const;
};

// Links and joints by name, with their lines; `order` lists joints so that parents come before children.
struct Outline {
  std::map<std::string, int> link_lines, joint_lines;
  std::set<std::string> with_inertial;  // links
  std::vector<std::string> order;
  std::string root;
};

// Parses the text under limits on depth and tag size; no DTD, no entities, one <robot>.
void parse_urdf(const Source& source, const std::string& text, tinyxml2::XMLDocument& document);

// Of a <link> or <joint>, and all in it: only elements and attributes that URDF has. What is drawn, <visual>, counts
// not.
void check_names(const Source& source, const tinyxml2::XMLElement& element);
// Every number strictly a number, every needed attribute there, links a tree.
Outline check_urdf(const Source& source, const tinyxml2::XMLElement& robot);

// What <muster> adds to a robot whose links, joints and sensors are there already: how elastic it is, balls, how far
// lasers see, and at most one drive.
void read_muster(const Source& source, const tinyxml2::XMLElement& element, Robot& robot);
Quadrotor read_quadrotor(const Source& source, const tinyxml2::XMLElement& element, const Robot& robot);
LegDrive read_legs(const Source& source, const tinyxml2::XMLElement& element, const Robot& robot);
void read_laser(const Source& source, const tinyxml2::XMLElement& element, Robot& robot);
void read_ball(const Source& source, const tinyxml2::XMLElement& element, Robot& robot);

// A <sensor> of a robot whose links and joints are there already. What muster has no sense for is warned of.
void read_sensor(const Source& source, const tinyxml2::XMLElement& element, Robot& robot);
// When all is read: of lasers that no <muster> gave a range.
void warn_of_blind_lasers(const Source& source, const tinyxml2::XMLElement& root, Robot& robot);

// The index of a joint; where one that turns without end about the body's +y axis is on the body.
std::size_t find_joint(const Source& source, const tinyxml2::XMLElement& element, const char* attribute,
                       const Robot& robot);
Eigen::Vector3d place_of_turning(const Source& source, const tinyxml2::XMLElement& element, const Robot& robot,
                                 std::size_t joint);

// "<wheel> ", as messages begin.
std::string tag(const tinyxml2::XMLElement& element);
// An attribute that must be there and not empty; one that must be a number above 0; those that may be there, beside
// those of other namespaces.
std::string required(const Source& source, const tinyxml2::XMLElement& element, const char* attribute);
double positive(const Source& source, const tinyxml2::XMLElement& element, const char* attribute);
void only_attributes(const Source& source, const tinyxml2::XMLElement& element, const std::vector<std::string>& known);
// The same of elements in it, each there at most once but for `many`.
void only_children(const Source& source, const tinyxml2::XMLElement& element, const std::vector<std::string>& known,
                   const std::vector<std::string>& many = {});

}  // namespace muster::description
