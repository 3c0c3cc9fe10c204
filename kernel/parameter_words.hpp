// What is said of a path that is asked for as a parameter and is none.
#pragma once

#include <string>
#include <vector>

#include "simulation.hpp"

namespace muster {

// True for numbers, flags and choices: texts, files and references stay as they are in a run.
bool is_settable(const muster_param& declared);

// Of a path that names nothing: what it names, if it is short of a name; whose plugin it begins with; and of its
// owner's parameters the one that is meant, by its name or by its help.
std::string unknown_parameter(const std::string& path, const std::vector<ParameterInfo>& all,
                              const std::string& owner_by_plugin);

// Of a path that names an attribute of the instance which stays as it is in a run; "" where it names none.
std::string fixed_attribute(const Instance& instance, const std::string& path);
// The same of a row of the world, "robot/rover/model".
std::string fixed_attribute_of_row(const World& world, const Standard& standard, const std::string& path);

// `<swap instance="driver"><control.waypoint robot="rover" path="other.csv"/></swap>`: the instance with another value.
std::string swap_with(const InstanceDeclaration& now, const std::string& name, const std::string& value);

// `"rover" is a robot (world.xml:6:3) and has no parameters; did you mean "driver/speed", of its controller ...?`; ""
// of a path that begins with no robot.
std::string fault_of_row(const Simulation& run, const std::string& path);

// Of a number that plugins write; "" where it is none.
std::string state_fault(const Simulation& run, const std::string& path);

}  // namespace muster
