#include "installation.hpp"

namespace muster::cli {

namespace fs = std::filesystem;

Installation installation_of(const fs::path& program) {
  const fs::path folder = program.parent_path(), prefix = folder.parent_path();
  std::error_code ignored;
  if (folder.filename() == "bin" && fs::is_directory(prefix / "lib" / "muster", ignored))
    return {prefix / "lib" / "muster", prefix / "share" / "muster", prefix / "lib" / "cmake" / "muster"};
  return {folder, folder, folder};
}

Installation installation() { return installation_of(fs::read_symlink("/proc/self/exe")); }

}  // namespace muster::cli
