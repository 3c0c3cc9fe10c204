// Two rooms of 4 x 4 m with two doors between them, a robot in the western one, and what it has come to.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/plugins/robots/robot_world.hpp"

namespace muster::test {

// As control.navigate writes it.
struct Navigation {
  double status, goal_x, goal_y, next, reached, plans, along, length, cost, echoes, told, way, seen;
};

inline const std::string two_rooms =
    "<material name='board' loss='5'/>"
    "<wall name='south' from='0 0' to='8 0' material='board'/><wall name='north' from='0 4' to='8 4' material='board'/>"
    "<wall name='west' from='0 0' to='0 4' material='board'/><wall name='east' from='8 0' to='8 4' material='board'/>"
    "<wall name='between' from='4 0' to='4 4' material='board'/>"
    "<door name='near' wall='between' at='0.5' width='0.9' state='open'/>"
    "<door name='far' wall='between' at='2.8' width='0.9' state='open'/>";
inline const std::string rover =
    "<robot name='rover' at='1 1 0'/><physics.planar name='physics' through_walls='true'/>"
    "<robots.drive/><robots.odometry/>";
inline const std::string plan = "<robots.roadmap name='plan' robot='rover'/>";
inline const std::string minutes = "dt=\"0.05\" until=\"120\" seed=\"1\"";
constexpr double rover_radius = 0.1524;  // of the scarab [m], a little less than its model has

// A robot that goes to the rows of `goals`, with more attributes of its controller.
inline Simulation navigating(const Folder& folder, const std::string& goals, const std::string& attributes = "",
                             const std::string& more = "", const std::string& given = plan,
                             const std::string& rooms = two_rooms) {
  return world_of(folder,
                  rooms + rover + given + "<control.navigate name='steer' robot='rover' goals='goals.csv' " +
                      attributes + "/>" + more,
                  {{"goals.csv", "x[m],y[m]\n" + goals}}, minutes);
}

inline Navigation state_of(const Simulation& run) { return row<Navigation>(run, "instance/steer/state"); }

inline std::vector<std::string> said(const Simulation& run) {
  std::vector<std::string> result;
  for (const auto& event : run.events()) {
    if (event.instance == "steer") result.push_back(event.message);
  }
  return result;
}

// Runs until as many goals are reached or the end; false at the end. `each` is called after every tick.
template <class Each>
bool run_to_goal(Simulation& run, double goals, const Each& each) {
  while (!run.done() && state_of(run).reached < goals) {
    run.step();
    each(row<Pose>(run, "robot/rover/pose"));
  }
  return state_of(run).reached >= goals;
}
inline bool run_to_goal(Simulation& run, double goals = 1) {
  return run_to_goal(run, goals, [](const Pose&) {});
}

}  // namespace muster::test
