// Worlds of robots, from text.
#pragma once

#include <map>
#include <string>

#include "tests/run_world.hpp"

namespace muster::test {

inline Simulation load(const std::filesystem::path& world) {
  return {read_world(world, standard()), standard(), options()};
}

// `inside` are the elements of the world, `files` are written beside it.
inline Simulation world_of(const Folder& folder, const std::string& inside,
                           const std::map<std::string, std::string>& files = {},
                           const std::string& attributes = "dt=\"0.05\" until=\"60\" seed=\"1\"") {
  for (const auto& [name, text] : files) folder.write(name, text);
  return load(folder.write("world.xml", "<world name=\"test\" " + attributes + ">" + inside + "</world>"));
}

}  // namespace muster::test
