// A folder of its own for each test, in which it spoils copies of the zoo's libraries.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include "loader/library.hpp"

namespace muster {

inline const std::filesystem::path zoo = ZOO;

inline std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Overwrites in place, as cp does: the file keeps its inode.
inline void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

class ZooTest : public testing::Test {
 protected:
  ZooTest() {
    std::string name = (std::filesystem::temp_directory_path() / "muster_zoo_XXXXXX").string();
    folder = ::mkdtemp(name.data());
  }
  ~ZooTest() override { std::filesystem::remove_all(folder); }

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

  std::filesystem::path folder;
};

}  // namespace muster
