// Process-wide state that a library's code must leave unchanged.
#pragma once

#include <csignal>
#include <filesystem>
#include <locale>
#include <string>

#include "float_guard.hpp"

namespace muster {

// Saves that state when made, and restores it in its destructor at the latest. Takes some microseconds: for loading,
// not for steps.
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
};

}  // namespace muster
