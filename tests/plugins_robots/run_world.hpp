// A world from text, run in a test.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <muster/sets.hpp>
#include <string>

#include "kernel/simulation.hpp"

namespace muster::test {

// Removed with all that is in it.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "muster_robots_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

inline Options options(int workers = 1) {
  Options result;
  result.search_path = {MUSTER_PLUGINS_DIR, MUSTER_TOYS_DIR};
  result.workers = workers;
  return result;
}

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

template <class Row>
Row row(const Simulation& run, const std::string& table, std::size_t at = 0) {
  const TableView view = run.table(table);
  const double* first =
      view.table->now().data.data() + (view.row >= 0 ? static_cast<std::size_t>(view.row) : at) * view.cols();
  return *reinterpret_cast<const Row*>(first);
}

}  // namespace muster::test
