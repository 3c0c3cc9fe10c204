// What belongs to the whole process, and what a library's code must therefore leave as it was.
#pragma once

#include <csignal>
#include <filesystem>
#include <locale>
#include <string>

#include "float_guard.hpp"

namespace muster {

// Remembers it from its making on, and restores it in the end at the latest. Some microseconds: for loading, not for
// steps.
class ProcessGuard {
 public:
  ProcessGuard();
  ~ProcessGuard() { restore(); }
  ProcessGuard(const ProcessGuard&) = delete;
  ProcessGuard& operator=(const ProcessGuard&) = delete;

  // What was changed since, in words that follow a name ("changes the locale to de_DE"); empty if nothing was.
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
