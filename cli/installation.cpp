#include "installation.hpp"

namespace muster::cli {

namespace fs = std::filesystem;

Installation installation() {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path(), prefix = folder.parent_path();
  std::error_code ignored;
  if (folder.filename() == "bin" && fs::is_directory(prefix / "lib" / "muster", ignored))
    return {prefix / "lib" / "muster", prefix / "share" / "muster", prefix / "lib" / "cmake" / "muster"};
  return {folder, folder, folder};
}

}  // namespace muster::cli
