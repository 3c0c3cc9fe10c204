// Names that are looked up among radios and are another kind's: a wall, a door.
#pragma once

#include <muster/plugin.h>

#include <string>

namespace muster {

// `, which is a wall` behind `no radio is called "w1"`; "" where nothing else has the name. Instances are not known
// here.
inline std::string which_is_no_radio(const muster_host* host, const std::string& name) {
  for (const char* set : {"robot", "wall", "door", "material", "mesh", "floor"}) {
    for (uint32_t row = 0; row < host->rows(host, set); ++row)
      if (host->row_name(host, set, row) == name) return std::string(", which is a ") + set;
  }
  return "";
}

}  // namespace muster
