// One controller and what it drives: a simulated robot, a log of one, or one over UDP.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <muster/sets.hpp>

#include "run_log/run_log.hpp"
#include "tests/folder.hpp"
#include "tests/run_world.hpp"

namespace muster::test {

// A model of the project's own, or ROBOTIS' URDF, which is not part of it.
inline std::string burger_model() {
  const auto path = std::filesystem::path(MUSTER_SOURCE_DIR).parent_path() / "shared/data/urdf/turtlebot3_burger.urdf";
  return std::filesystem::exists(path) ? path.string() + "\" fittings=\"burger_fittings.xml" : "";
}

inline std::string world_text(const std::string& inside, const std::string& until, const std::string& dt = "0.02") {
  return "<world name=\"w\" dt=\"" + dt + "\" until=\"" + until + "\" seed=\"3\">" + inside + "</world>";
}

inline Simulation start_of(const Folder& folder, const std::string& name, const std::string& text) {
  return {read_world(folder.write(name, text), standard()), standard(), {{MUSTER_PLUGINS_DIR}, 1, {}}};
}

// Runs the world to its end with a log of its <record>s.
inline void log_run(Simulation& run, const std::filesystem::path& file) {
  run_log::RunLog log(run, run.world().records, file, "of the test");
  log.write(run);
  while (!run.done()) {
    run.step();
    log.write(run);
  }
  log.close(run);
}

inline std::string refusal_of(const Folder& folder, const std::string& text) {
  try {
    Simulation run = start_of(folder, "world.xml", text);
    run.step();
  } catch (const Error& error) {
    EXPECT_EQ(error.exit(), Exit::invalid_input);
    return folder.inside(error.what());
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

}  // namespace muster::test
