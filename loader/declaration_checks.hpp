// Checks what a plugin declares of its laws, clips and bursts: names of parameters, sizes, and lists of values.
#pragma once

#include <muster/plugin.h>

namespace muster {

// `plugin`: with checked parameters. Throws Refusal.
void check_declarations(const muster_plugin& plugin);

}  // namespace muster
