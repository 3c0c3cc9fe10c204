// The only way in which this plugin includes Simbody.
#pragma once

// Debian's Simbody is built without NDEBUG, and a header's struct has more members then: a unit compiled with it
// crashes in realizeTopology().
#ifdef NDEBUG
#error "compile what includes Simbody with -UNDEBUG"
#endif
#include <Simbody.h>
