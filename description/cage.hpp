// Restricts a process to computation: memory, and its exit.
#pragma once

#include <sys/resource.h>

namespace muster::description {

struct CageLimits {
  rlim_t memory = 1u << 30;  // bytes of address space
  rlim_t cpu = 5;            // [s]
};

// For the child of a fork: from here on it can open nothing, start nothing and reach no network, and it dies when its
// time or memory is used up.
void enter_cage(const CageLimits& limits);

}  // namespace muster::description
