// Loads plugins again whose files have changed since the last look.
#pragma once

#include <fmt/core.h>
#include <sys/stat.h>

#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

#include "kernel/simulation.hpp"

namespace muster::cli {

class PluginWatcher {
 public:
  void look(Simulation& run) {
    for (const auto& instance : run.instances()) {
      const auto now = stamp(instance->library()->file());
      const auto [known, is_new] = seen_.emplace(instance->name(), now);
      if (is_new || known->second == now || now == Stamp{}) continue;
      known->second = now;
      try {
        run.reload(instance->name());
      } catch (const Error& e) {
        fmt::print(stderr, "muster: warning: {}; the old one goes on\n", e.what());
      }
      return;  // reload() has changed the list
    }
  }

 private:
  using Stamp = std::pair<int64_t, int64_t>;  // size and time of change
  static Stamp stamp(const std::filesystem::path& file) {
    struct stat s {};
    if (::stat(file.c_str(), &s) != 0 || s.st_size == 0) return {};
    return {s.st_size, s.st_mtim.tv_sec * 1'000'000'000 + s.st_mtim.tv_nsec};
  }
  std::map<std::string, Stamp> seen_;
};

}  // namespace muster::cli
