// What a library registers, copied and checked, so that the rest of the kernel may trust it.
#pragma once

#include <muster/plugin.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace muster {

// "radio.multiwall/2" taken apart; revision 0 is not valid and stands for "no such form".
struct PluginId {
  std::string_view id;
  std::uint32_t revision = 0;
};
PluginId parse_plugin_id(std::string_view text);

// The descriptors that `muster_register` registers, by ascending revision: one at least, all of one id, each checked.
// Strings and parameters stay in the library. Throws Refusal.
std::vector<muster_plugin> registered_plugins(decltype(&muster_register) call);

}  // namespace muster
