// Whether a step() that is const has changed its plugin all the same, by a mutable member.
#pragma once

#include <cstring>

namespace muster::detail {

// The bytes of a plugin as its constructor left them. What a member points to is not among them.
template <class Plugin, bool is_kept>
struct FirstBytes {
  explicit FirstBytes(const Plugin& plugin) { std::memcpy(bytes, static_cast<const void*>(&plugin), sizeof bytes); }
  // True once.
  bool are_changed(const Plugin& plugin) {
    if (told || std::memcmp(bytes, static_cast<const void*>(&plugin), sizeof bytes) == 0) return false;
    return told = true;
  }
  unsigned char bytes[sizeof(Plugin)];
  bool told = false;
};
template <class Plugin>
struct FirstBytes<Plugin, false> {
  explicit FirstBytes(const Plugin&) {}
  bool are_changed(const Plugin&) { return false; }
};

}  // namespace muster::detail
