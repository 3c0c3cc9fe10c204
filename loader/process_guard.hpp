// Process-wide state that a library's code must leave unchanged.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <locale>
#include <optional>
#include <string>
#include <utility>

#include "float_guard.hpp"

namespace muster {

// Saves that state when made, and restores it in its destructor at the latest: locales, the working directory, the
// signal mask, handlers of signals that end a run, the umask, limits (ulimit), arithmetic. A standard output or error
// that was exchanged is told, and not restored. Takes some microseconds: for loading and for single steps.
class ProcessGuard {
 public:
  ProcessGuard();
  ~ProcessGuard() { restore(); }
  ProcessGuard(const ProcessGuard&) = delete;
  ProcessGuard& operator=(const ProcessGuard&) = delete;

  // The change since, in words that follow a name ("changes the locale to de_DE"); empty if there is none.
  std::string what() const;
  void restore() const noexcept;

 private:
  FloatGuard float_;
  std::string c_locale_;
  std::locale locale_;
  std::filesystem::path folder_;
  sigset_t signals_;
  std::array<struct sigaction, 6> handlers_;
  std::array<std::pair<dev_t, ino_t>, 2> standard_;  // output, error
  std::optional<mode_t> umask_;
  std::array<struct rlimit, RLIM_NLIMITS> limits_;
};

}  // namespace muster
