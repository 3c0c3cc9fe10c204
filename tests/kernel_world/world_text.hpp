// World files written by tests, and what reading them says.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "kernel/world.hpp"

namespace muster {

class WorldText : public testing::Test {
 protected:
  WorldText() {
    std::string name = (std::filesystem::temp_directory_path() / "muster_world_XXXXXX").string();
    folder = ::mkdtemp(name.data());
  }
  ~WorldText() override { std::filesystem::remove_all(folder); }

  std::filesystem::path put(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return folder / name;
  }
  World read(const std::string& text) const { return read_world(put("world.xml", text), standard()); }
  // `elements` begin in line 2.
  World read_with(const std::string& elements) const {
    return read("<world dt='0.1' until='10'>\n" + elements + "\n</world>\n");
  }

  std::string error(const std::string& text) const {
    try {
      read(text);
    } catch (const Error& e) {
      EXPECT_EQ(e.exit(), Exit::invalid_input);
      std::string said = e.what();
      const std::string prefix = folder.string() + '/';
      for (auto at = said.find(prefix); at != said.npos; at = said.find(prefix)) said.erase(at, prefix.size());
      return said;
    }
    return "no error";
  }
  std::string error_with(const std::string& elements) const {
    return error("<world dt='0.1' until='10'>\n" + elements + "\n</world>\n");
  }

  std::filesystem::path folder;
};

}  // namespace muster
