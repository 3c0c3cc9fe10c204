// The error of a call, and a folder for the files that a test writes.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "tests/folder.hpp"
#include "text/error.hpp"

namespace muster::test {

// The message of the Error that the call throws, without its file's folder, and with the exit code in front unless it
// is 2.
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
  std::filesystem::path write(std::string_view name, std::string_view bytes) const {
    return temporary.write(std::string(name), std::string(bytes));
  }

  const Folder temporary;
  const std::filesystem::path& folder = temporary.path();
};

}  // namespace muster::test
