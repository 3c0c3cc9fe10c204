#include "library.hpp"

#include <cstdio>
#include <mutex>
#include <new>

// Replacements of stdout and stderr for ODE's archive: see CMakeLists.txt.
extern "C" {
FILE* muster_ode_stdout;
FILE* muster_ode_stderr;
}

namespace muster::ode {

namespace {

std::mutex global;  // guards ODE's global state
int users = 0;
thread_local int* counted = nullptr;

void count(int, const char*, va_list) {
  if (counted) ++*counted;
}

}  // namespace

Library::Library() {
  const std::lock_guard<std::mutex> lock(global);
  if (users++) return;
  muster_ode_stdout = stdout;
  muster_ode_stderr = stderr;
  dInitODE2(0);
  dSetMessageHandler(count);
}

Library::~Library() {
  const std::lock_guard<std::mutex> lock(global);
  if (--users == 0) dCloseODE();
}

Complaints::Complaints() { counted = &count_; }
Complaints::~Complaints() { counted = nullptr; }

OwnThread::OwnThread() : made_(dThreadingAllocateSelfThreadedImplementation()) {
  if (!made_) throw std::bad_alloc();
}
OwnThread::~OwnThread() { dThreadingFreeImplementation(made_); }

void OwnThread::carry(dWorldID world) const {
  dWorldSetStepThreadingImplementation(world, dThreadingImplementationGetFunctions(made_), made_);
}

bool quick_step(dWorldID world, double h, unsigned long seed) {
  const std::lock_guard<std::mutex> lock(global);
  dRandSetSeed(seed);
  return dWorldQuickStep(world, h) != 0;
}

}  // namespace muster::ode
