// The program run as a user runs it: what it printed, how it ended, what it cost.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/folder.hpp"

namespace muster::test {

struct Outcome {
  int exit = -1;  // as a shell gives it: 128 + n for signal n
  std::string out, err;
  double cpu_seconds = 0, wall_seconds = 0;
  long peak_kilobytes = 0;
};

struct Surroundings {
  std::vector<std::string> environment;        // "NAME=VALUE", set; "NAME", removed
  std::filesystem::path folder;                // working directory
  std::filesystem::path standard_output;       // a file instead of a pipe
  bool terminal = false;                       // standard error is a terminal
  std::function<void(int process)> meanwhile;  // called once, when the program has printed its first bytes
  std::vector<std::string> wrapper;            // words before the program, such as strace
  bool bound_by_permissions = false;           // of files, even where the test is run by root
};

// Kills the program and fails the test after a minute.
Outcome run_muster(const std::vector<std::string>& words, const Surroundings& around = {});

// A folder of files, removed in the end; the program runs in it, so that messages name files as a user would.
class ProgramFolder : public Folder {
 public:
  // Runs the program in this folder.
  Outcome muster(const std::vector<std::string>& words, Surroundings around = {}) const;
  // With the toys on the plugin path: exit code and the one line on standard error after "muster: error: ", of `check`
  // on a world with this text.
  void expect_refused(const std::string& world, const std::string& message, int exit = 2) const;
};

// <world ...> around elements, all on the first line.
std::string world_of(const std::string& elements);

// Expects one line of error, and the exit code.
void expect_error(const Outcome& outcome, int exit, const std::string& message);

}  // namespace muster::test
