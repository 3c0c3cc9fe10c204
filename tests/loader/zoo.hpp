// A folder of its own for each test, in which it spoils copies of the zoo's libraries.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "loader/library.hpp"
#include "tests/folder.hpp"

namespace muster {

inline const std::filesystem::path zoo = ZOO;

// Overwrites in place, as cp does: the file keeps its inode.
inline void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

class ZooTest : public testing::Test {
 protected:
  // The whole message of the Error that `action` throws, and its exit code checked; "" if it throws none.
  static std::string error_of(const std::function<void()>& action) {
    try {
      action();
    } catch (const Error& error) {
      EXPECT_EQ(error.exit(), Exit::plugin_fault);
      return error.what();
    }
    return "";
  }
  std::string load_error(const std::string& id, const std::filesystem::path& file) const {
    return error_of([&] { Library::load(id, file, {}, {"world.xml", 5, 3}); });
  }

  const test::Folder temporary;
  const std::filesystem::path& folder = temporary.path();
};

}  // namespace muster
