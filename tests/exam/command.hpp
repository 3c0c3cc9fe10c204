// Runs a command of the shell and keeps what it prints.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace muster::exam {

struct Outcome {
  int code = -1;
  std::string text;  // of both streams
};

inline Outcome run_command(const std::string& command) {
  Outcome result;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> part;
  for (std::size_t n; (n = fread(part.data(), 1, part.size(), pipe)) > 0;) result.text.append(part.data(), n);
  result.code = WEXITSTATUS(pclose(pipe));
  return result;
}

}  // namespace muster::exam
