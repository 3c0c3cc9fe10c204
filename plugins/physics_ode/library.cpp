#include "library.hpp"

#include <atomic>
#include <cstdarg>
#include <cstdio>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>

// Replacements of stdout and stderr for ODE's archive: see CMakeLists.txt.
extern "C" {
FILE* muster_ode_stdout;
FILE* muster_ode_stderr;
}

namespace muster::ode {

namespace {

std::mutex global;  // guards ODE's global state
int users = 0;
std::atomic<bool> broken{false};
thread_local int* counted = nullptr;

void count(int, const char*, va_list) {
  if (counted) ++*counted;
}

// An assertion of ODE's that does not hold, which would end the whole process: an error of the step. ODE is compiled
// with the tables that unwinding needs.
void give_up(int, const char* message, va_list values) {
  broken = true;
  char words[512];
  std::vsnprintf(words, sizeof words, message, values);
  throw std::runtime_error(std::string("ODE gives up: ") + words +
                           "; is a mass, a size or a place of a robot far from what things have (1e-6 to 1e6 kg, 1e-4 "
                           "to 1e4 m)? physics.simbody and physics.mujoco take the same world");
}

}  // namespace

bool has_given_up() { return broken; }

Library::Library() {
  const std::lock_guard<std::mutex> lock(global);
  if (users++) return;
  muster_ode_stdout = stdout;
  muster_ode_stderr = stderr;
  dInitODE2(0);
  dSetMessageHandler(count);
  dSetErrorHandler(give_up);
  dSetDebugHandler(give_up);
}

Library::~Library() {
  const std::lock_guard<std::mutex> lock(global);
  if (--users == 0 && !broken) dCloseODE();
}

Complaints::Complaints() { counted = &count_; }
Complaints::~Complaints() { counted = nullptr; }

OwnThread::OwnThread() : made_(dThreadingAllocateSelfThreadedImplementation()) {
  if (!made_) throw std::bad_alloc();
}
OwnThread::~OwnThread() {
  if (!has_given_up()) dThreadingFreeImplementation(made_);
}

void OwnThread::carry(dWorldID world) const {
  dWorldSetStepThreadingImplementation(world, dThreadingImplementationGetFunctions(made_), made_);
}

bool quick_step(dWorldID world, double h, unsigned long seed) {
  const std::lock_guard<std::mutex> lock(global);
  dRandSetSeed(seed);
  return dWorldQuickStep(world, h) != 0;
}

}  // namespace muster::ode
