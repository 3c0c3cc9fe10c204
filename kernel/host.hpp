// The host that an instance calls: the kernel behind a table of C functions.
#pragma once

#include <muster/plugin.h>

namespace muster {

class Instance;

// Valid as long as the instance, at its address.
muster_host make_host(Instance& instance);

}  // namespace muster
