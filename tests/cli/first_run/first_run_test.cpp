// The program that is built first runs worlds as the whole program does.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>

namespace {

std::string output_of(const std::string& program) {
  const std::string command = program + " run " MUSTER_SOURCE_DIR "/worlds/connectivity --until 3 --json";
  std::string result;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::array<char, 4096> some;
  while (const std::size_t size = std::fread(some.data(), 1, some.size(), pipe)) result.append(some.data(), size);
  EXPECT_EQ(::pclose(pipe), 0) << program;
  return result;
}

TEST(FirstRun, IsThatOfTheWholeProgram) {
  const std::string whole = output_of(MUSTER_PROGRAM);
  EXPECT_NE(whole.find("\"digest\""), whole.npos);
  EXPECT_EQ(output_of(MUSTER_PROGRAM "_runs"), whole);
}

}  // namespace
