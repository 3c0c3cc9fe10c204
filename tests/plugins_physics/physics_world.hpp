// Worlds from text, with a physics backend each.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <muster/sets.hpp>
#include <string>

#include "kernel/simulation.hpp"

namespace muster::test {

class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "muster_physics_XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }
  std::string path(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

inline Simulation world_of(const Folder& folder, const std::string& inside, int workers = 1,
                           const std::string& dt = "0.01") {
  Options options;
  options.search_path = {MUSTER_PLUGINS_DIR, MUSTER_TOYS_DIR};
  options.workers = workers;
  const auto file = folder.write(
      "world.xml", "<world name=\"test\" dt=\"" + dt + "\" until=\"600\" seed=\"1\">" + inside + "</world>");
  return {read_world(file, standard()), standard(), options};
}

template <class Row>
Row row(const Simulation& run, const std::string& table, std::size_t at = 0) {
  const TableView view = run.table(table);
  const double* first =
      view.table->now().data.data() + (view.row >= 0 ? static_cast<std::size_t>(view.row) : at) * view.cols();
  return *reinterpret_cast<const Row*>(first);
}

inline void run_to(Simulation& run, uint64_t tick) {
  while (run.tick() < tick) run.step();
}

inline InstanceDeclaration instance(const std::string& plugin,
                                    const std::map<std::string, std::string>& attributes = {}) {
  InstanceDeclaration made;
  made.plugin = plugin;
  for (const auto& [name, value] : attributes) made.attributes.push_back({name, value, {}, {}});
  return made;
}

inline const char* two_scarabs =
    R"(<robot name="a" at="0 0 0" heading="0.3"/><robot name="b" at="3 1 0" heading="2"/>)";

}  // namespace muster::test
