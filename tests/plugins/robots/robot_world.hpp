// Worlds of robots, from text.
#pragma once

#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

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

// A model file: the Scarab's, with each first text of a pair replaced by the second.
inline std::filesystem::path scarab_with(const Folder& folder,
                                         const std::vector<std::pair<std::string, std::string>>& changes) {
  std::ifstream scarab(MUSTER_PLUGINS_DIR "/models/scarab.urdf");
  std::string urdf{std::istreambuf_iterator<char>(scarab), {}};
  for (const auto& [was, is] : changes) urdf.replace(urdf.find(was), was.size(), is);
  auto model = folder.write("scarab.urdf", urdf);
  std::filesystem::copy(MUSTER_PLUGINS_DIR "/models/hokuyo.stl", model.parent_path());
  return model;
}

}  // namespace muster::test
