// What a library's symbols say of runs that do not repeat: random numbers and clocks of the system, waiting, and state
// of step() that no snapshot holds.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace muster {

// Warnings of a whole shared object for this machine, as elf_sections() accepts it, from its bytes. `id`: of its
// plugin; bridges, devices and hosts are of the world outside, and physics may link an engine that has such calls
// unused.
std::vector<std::string> library_doubts(std::string_view bytes, std::string_view id);

}  // namespace muster
