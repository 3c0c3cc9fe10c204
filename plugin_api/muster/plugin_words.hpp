// What a plugin's author is told: exceptions that nobody wrote for a reader, state that is lost, and attributes that
// nothing looks at.
#pragma once

#include <cxxabi.h>
#include <muster/plugin.h>

#include <cstdlib>
#include <exception>
#include <string>
#include <typeinfo>

namespace muster::detail {

inline void warn(const muster_host* host, const std::string& row, const std::string& message) {
  const char* place = host->text(host, (row + "/place").c_str());
  host->event(host, ("warning: " + (place ? place + std::string(": ") : "") + message).c_str());
}

// Words of an exception that nobody wrote for a reader, such as that of vector::at(): they need the type, and the
// place.
inline std::string unexpected(const std::exception& e) {
  int failed = 0;
  char* name = abi::__cxa_demangle(typeid(e).name(), nullptr, nullptr, &failed);
  const std::string type = failed == 0 && name ? name : typeid(e).name();
  std::free(name);
  return "threw " + type + ": " + e.what() +
         "; a debugger shows where: gdb -ex 'catch throw' -ex run --args muster ...";
}

// Members that step() changes are state that a snapshot, a restore and a swap lose.
inline void warn_of_state(const muster_host* host, const char* why, const char* also) {
  warn(host, "self",
       std::string("its step() ") + why + ": what it keeps in members is lost where a run is restored or a plugin " +
           "swapped; expected state in a table, s.write<State>(\"self/state\") and k.last(state), and " + also +
           "; or, where members hold only what can be computed again, static constexpr bool keeps_only_caches = true");
}

inline void warn_of_unused(const muster_host* host, const std::string& name) {
  const char* place = host->text(host, ("self/place/" + name).c_str());
  const std::string quoted = '"' + name + '"';
  host->event(host, ("warning: " + (place ? place + std::string(": ") : "") + "attribute " + quoted +
                     " has no effect: the plugin's constructor never looks at it; expected s.value(" + quoted +
                     ") there, and k[...] of it in step(), or s.text(" + quoted + ") of a text")
                        .c_str());
}

}  // namespace muster::detail
