// What may be asked of a run that is watched, and is done between two of its ticks.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "kernel/simulation.hpp"

namespace muster::live {

// Numbers are those of simulation_interfaces/msg/SimulationState.
enum class RunState : std::uint8_t {
  stopped = 0,  // before the first tick, and nobody has let it go
  playing = 1,
  paused = 2,  // or at its end
  quitting = 3
};

class RunControl {
 public:
  using Done = std::function<void(const std::string& fault)>;  // "" where it was done
  virtual ~RunControl() = default;

  virtual Simulation& run() = 0;
  virtual RunState state() const = 0;
  // Stopped makes the run anew, and done() follows then.
  virtual void set_state(RunState state, Done done) = 0;
  // So many ticks, at once; the run is paused before and afterwards.
  virtual void step(std::uint64_t ticks, Done done) = 0;
  // Makes the run anew, in the state that it has.
  virtual void reset(Done done) = 0;
};

}  // namespace muster::live
