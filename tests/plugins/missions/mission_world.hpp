// A robot with a mission, a base that it hears, and what it has come to.
#pragma once

#include <gmock/gmock.h>

#include <cmath>
#include <muster/tables.hpp>

#include "tests/plugins/robots/robot_world.hpp"
#include "tests/plugins/sensors/sense_world.hpp"

namespace muster::test {

inline const std::string ground = "<physics.planar/><robots.drive/><robots.odometry/>";
inline const std::string air = "<radio.multiwall l0='40' n='2'/><network.ideal/>";
inline const std::string scout =
    "<robot name='scout' at='0 0 0'/><control.goal2d robot='scout' speed='0.5'/>"
    "<control.mission name='mission' robot='scout' mission='mission.xml'/>";
inline const std::string base = "<station name='base' at='0 0 0.5'/>";
inline const std::string one_second = "dt=\"0.05\" until=\"200\" seed=\"1\"";

class Missions : public testing::Test {
 protected:
  Simulation run(const std::string& mission, const std::string& more = "", const std::string& robots = scout) const {
    return world_of(folder, base + robots + ground + air + more,
                    {{"mission.xml", "<mission>\n" + mission + "\n</mission>\n"}}, one_second);
  }
  const Folder folder;
};

inline Pose place_of(const Simulation& run, const std::string& robot = "scout") {
  return row<Pose>(run, "robot/" + robot + "/pose");
}
inline double away(const Simulation& run, double x, double y, const std::string& robot = "scout") {
  const Pose at = place_of(run, robot);
  return std::hypot(at.x - x, at.y - y);
}
// The line of its file that a mission is at.
inline double line(const Simulation& run, const std::string& mission = "mission") {
  return run.table("instance/" + mission + "/state").at(0, 0);
}
inline void run_to(Simulation& run, double time) {
  while (run.time() < time - run.world().dt / 2) run.step();
}
// Until the mission is at that line, or for `most` seconds; false where it never is.
inline bool run_to_line(Simulation& run, double wanted, double most = 100) {
  for (const double end = run.time() + most; run.time() < end && line(run) != wanted;) run.step();
  return line(run) == wanted;
}
inline std::vector<std::string> said(const Simulation& run, const std::string& instance) {
  std::vector<std::string> result;
  for (const auto& event : run.events()) {
    if (event.instance == instance) result.push_back(event.message);
  }
  return result;
}

}  // namespace muster::test
