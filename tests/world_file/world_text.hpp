// World files written by tests, and the result of reading them.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/folder.hpp"
#include "world_file/world.hpp"

namespace muster {

class WorldText : public testing::Test {
 protected:
  std::filesystem::path put(const std::string& name, const std::string& bytes) const {
    return temporary.write(name, bytes);
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
      return temporary.inside(e.what());
    }
    return "no error";
  }
  std::string error_with(const std::string& elements) const {
    return error("<world dt='0.1' until='10'>\n" + elements + "\n</world>\n");
  }

  const test::Folder temporary;
  const std::filesystem::path& folder = temporary.path();
};

}  // namespace muster
