// Descriptors that a library registers, copied and checked, so that the rest of the kernel may trust them.
#pragma once

#include <muster/plugin.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace muster {

// Parts of "radio.multiwall/2"; revision 0 is not valid and marks a text of another form.
struct PluginId {
  std::string_view id;
  std::uint32_t revision = 0;
};
PluginId parse_plugin_id(std::string_view text);

// The descriptors that `muster_register` registers, by ascending revision: at least one, all of one id, each checked.
// Strings and parameters stay in the library. Throws Refusal.
std::vector<muster_plugin> registered_plugins(decltype(&muster_register) call);

}  // namespace muster
