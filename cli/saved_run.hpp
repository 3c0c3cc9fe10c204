// A run whose state goes into a file: at its end, and on the way, so that what is killed need not begin anew.
#pragma once

#include <optional>
#include <string>

#include "kernel/simulation.hpp"

namespace muster::cli {

class SavedRun {
 public:
  // `file`: empty for none. `every`: seconds of the run between two states. Throws Error that names --save-every.
  SavedRun(std::string file, const std::optional<std::string>& every, double dt);

  // The file holds the last state that was due, whole at each moment. Throws Error with Exit::io.
  void after_tick(const Simulation& run) const;
  // False where no file was asked for.
  bool at_end(const Simulation& run) const;

 private:
  std::string file_;
  uint64_t every_ = 0;  // ticks
};

}  // namespace muster::cli
