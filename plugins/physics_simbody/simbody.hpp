// The only header of this plugin that includes Simbody.
#pragma once

// Debian's Simbody is built without NDEBUG, with which a header's struct loses members: a unit compiled with NDEBUG
// crashes in realizeTopology().
#ifdef NDEBUG
#error "compile what includes Simbody with -UNDEBUG"
#endif
#include <Simbody.h>
