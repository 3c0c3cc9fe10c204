// Backends of physics of this build: physics.mujoco is left out where its library is not installed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace muster::test {

// Those of the plugins that were built.
inline std::vector<const char*> built(std::vector<const char*> plugins) {
  std::vector<const char*> result;
  for (const char* plugin : plugins) {
    std::string file = plugin;
    file[file.find('.')] = '_';
    if (std::filesystem::exists(MUSTER_PLUGINS_DIR "/" + file + ".so")) result.push_back(plugin);
  }
  return result;
}

}  // namespace muster::test
