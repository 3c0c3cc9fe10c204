// Where the program's own parts lie: beside it in a build folder; below its prefix where it is installed.
#pragma once

#include <filesystem>

namespace muster::cli {

struct Installation {
  std::filesystem::path parts;    // plugins/, viewer/, muster_exam
  std::filesystem::path shared;   // templates/
  std::filesystem::path package;  // muster-config.cmake
};

// Found by the place of the running program alone, so that a whole prefix can be moved.
Installation installation();

}  // namespace muster::cli
