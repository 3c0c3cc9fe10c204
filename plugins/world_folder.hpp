// The folder of the world file, below which a world's own files lie.
#pragma once

#include <muster/plugin.hpp>
#include <string>

namespace muster {

// The last of the folders in which files are looked for.
inline std::string world_folder(const muster_host* host) {
  std::string folder;
  for (uint32_t i = 0; const char* next = host->search_path(host, i); ++i) folder = next;
  return folder;
}

}  // namespace muster
