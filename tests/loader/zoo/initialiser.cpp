// Faults during static initialisation, chosen by INITIALISER.
#include <fenv.h>
#include <unistd.h>

#include <clocale>
#include <csignal>
#include <cstdlib>
#include <locale>
#include <stdexcept>

#include "animal.hpp"

namespace {
struct Decimal : std::numpunct<char> {};

[[maybe_unused]] void hide_signals() {
  sigset_t all;
  sigfillset(&all);
  sigprocmask(SIG_BLOCK, &all, nullptr);
}

// Behaves in the child that tries it out, and not in the process that MUSTER_ZOO_HOST names.
[[maybe_unused]] void round_down_in_host() {
  const char* host = std::getenv("MUSTER_ZOO_HOST");
  if (host && std::to_string(getpid()) == host) fesetround(FE_DOWNWARD);
}

const int made = [] {
  INITIALISER;
  return 0;
}();
}  // namespace

MUSTER_PLUGIN_IS(Animal)
