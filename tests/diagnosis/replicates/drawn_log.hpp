// Worlds of one robot whose noise is known, and the logs that they draw.
#pragma once

#include <cmath>
#include <functional>
#include <string>

#include "diagnosis/replicates/noise_fit.hpp"
#include "tests/folder.hpp"
#include "text/number.hpp"
#include "world_file/world.hpp"

namespace muster::test {

inline World world_in(const Folder& folder, const std::string& name, const std::string& elements) {
  const auto file =
      folder.write(name,
                   "<world name=\"log\" dt=\"0.02\" until=\"10\">\n  <robot name=\"rover\" model=\"scarab\" "
                   "at=\"0 0 0\"/>\n" +
                       elements + "\n</world>\n");
  return read_world(file, standard());
}

inline Options running() { return {{MUSTER_PLUGINS_DIR}, 1, {}}; }

// The table's row of the rover as a file, each `every` ticks; `change` may alter the cells.
inline void log_table(const Folder& folder, Simulation& run, const std::string& table, const std::string& header,
                      int every, const std::string& file,
                      const std::function<void(double, std::vector<double>&)>& change = {}) {
  std::string text = "t[s],robot," + header + '\n';
  while (true) {
    if (run.tick() % static_cast<uint64_t>(every) == 0) {
      const TableView view = run.table("robot/rover/" + table);
      std::vector<double> cells(view.cols());
      for (std::size_t c = 0; c < cells.size(); ++c) cells[c] = view.at(0, c);
      if (change) change(run.time(), cells);
      text += print_real(run.time()) + ",rover";
      for (const double cell : cells) text += std::isnan(cell) ? "," : ',' + print_real(cell);
      text += '\n';
    }
    if (run.done()) break;
    run.step();
  }
  folder.write(file, text);
}

// Poses and odometry of a robot on random arcs, whose odometry has this noise.
inline void drive(const Folder& folder, uint64_t seed, const std::string& noise,
                  const std::function<void(double, std::vector<double>&)>& change = {}) {
  World world =
      world_in(folder, "drive.xml",
               "  <physics.planar/><robots.drive/><robots.odometry noise=\"" + noise + "\"/><control.wander/>");
  world.seed = seed;
  Simulation poses(world, standard(), running());
  log_table(folder, poses, "pose", "x[m],y[m],z[m],qw,qx,qy,qz", 1, "poses.csv");
  Simulation again(world, standard(), running());
  log_table(folder, again, "odometry", "x[m],y[m],yaw[rad],v[m/s],w[rad/s]", 5, "odometry.csv", change);
}

inline const std::string replayed = "  <physics.replay file=\"poses.csv\"/><robots.odometry/>";

inline diagnosis::NoiseFit fitted_odometry(const Folder& folder, const std::string& elements = replayed,
                                           const diagnosis::FitOptions& options = {}) {
  return diagnosis::fit_noise(world_in(folder, "given.xml", elements), running(), "robot/*/odometry",
                              folder / "odometry.csv", options);
}

}  // namespace muster::test
