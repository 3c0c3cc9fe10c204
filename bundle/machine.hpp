// What of a machine and a build may change the last bits of a result.
#pragma once

#include <string>
#include <vector>

namespace muster::bundle {

struct Machine {
  std::string system;                     // "Debian GNU/Linux 12 (bookworm)"
  std::string architecture;               // "x86_64"
  std::string libc;                       // "glibc 2.36"
  std::string compiler;                   // "GCC 12.2.0"
  std::string cpu;                        // its name as the system gives it
  std::vector<std::string> cpu_features;  // those by which code chooses its vector instructions
};

Machine this_machine();

}  // namespace muster::bundle
