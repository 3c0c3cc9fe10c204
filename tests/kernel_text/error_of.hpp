// What a call throws, and a folder for the files that a test writes.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "text/error.hpp"

namespace muster::test {

// The message of the Error that the call throws, its file's folder left out, with the exit code in front if it is
// not 2.
template <class Call>
std::string error_of(Call&& call, const std::filesystem::path& folder = {}) {
  try {
    call();
  } catch (const Error& error) {
    std::string text = error.what();
    const std::string prefix = folder.string() + "/";
    if (!folder.empty() && text.starts_with(prefix)) text.erase(0, prefix.size());
    return error.exit() == Exit::invalid_input ? text : std::to_string(static_cast<int>(error.exit())) + " " + text;
  }
  return "no error";
}

class FolderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder = std::filesystem::temp_directory_path() /
             ("muster_" + std::string(info->test_suite_name()) + "_" + info->name() + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::filesystem::path write(std::string_view name, std::string_view bytes) const {
    std::ofstream(folder / name, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return folder / name;
  }

  std::filesystem::path folder;
};

}  // namespace muster::test
