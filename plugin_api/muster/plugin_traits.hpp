// What a plugin declares: its parameters, the members of its struct, found at compile time by their names, and what its
// author is told of both.
#pragma once

#include <cxxabi.h>
#include <muster/plugin.h>

#include <cstddef>
#include <cstdlib>
#include <exception>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>

namespace muster {

class Setup;
class Step;

namespace detail {

template <class Plugin, class = void>
constexpr const char* manual_of = nullptr;
template <class Plugin>
inline constexpr const char* manual_of<Plugin, std::void_t<decltype(Plugin::manual)>> = Plugin::manual;
template <class Plugin, class = void>
constexpr const muster_cause* cause_of = nullptr;
template <class Plugin>
inline constexpr const muster_cause* cause_of<Plugin, std::void_t<decltype(Plugin::cause)>> = &Plugin::cause;
template <class Plugin, class = void>
constexpr const muster_draw* draw_of = nullptr;
template <class Plugin>
inline constexpr const muster_draw* draw_of<Plugin, std::void_t<decltype(Plugin::draw)>> = &Plugin::draw;
// A member of that name that is no declaration is left alone.
template <class Plugin, class = void>
constexpr const muster_law* law_of = nullptr;
template <class Plugin>
inline constexpr const muster_law*
    law_of<Plugin, std::enable_if_t<std::is_convertible_v<decltype(&Plugin::law), const muster_law*>>> = &Plugin::law;
template <class Plugin, class = void>
constexpr const muster_clip* clip_of = nullptr;
template <class Plugin>
inline constexpr const muster_clip*
    clip_of<Plugin, std::enable_if_t<std::is_convertible_v<decltype(&Plugin::clip), const muster_clip*>>> =
        &Plugin::clip;
template <class Plugin, class = void>
constexpr const muster_burst* burst_of = nullptr;
template <class Plugin>
inline constexpr const muster_burst*
    burst_of<Plugin, std::enable_if_t<std::is_convertible_v<decltype(&Plugin::burst), const muster_burst*>>> =
        &Plugin::burst;
template <class Plugin, class = void>
constexpr const char* cannot_hold_of = nullptr;
template <class Plugin>
inline constexpr const char* cannot_hold_of<Plugin, std::void_t<decltype(Plugin::cannot_hold)>> = Plugin::cannot_hold;

template <class Plugin, class = void>
constexpr bool has_id = false;
template <class Plugin>
inline constexpr bool has_id<Plugin, std::void_t<decltype(Plugin::id)>> = true;
template <class Plugin, class = void>
constexpr bool has_summary = false;
template <class Plugin>
inline constexpr bool has_summary<Plugin, std::void_t<decltype(Plugin::summary)>> = true;
template <class Plugin, class = void>
constexpr bool has_phase = false;
template <class Plugin>
inline constexpr bool has_phase<Plugin, std::void_t<decltype(Plugin::phase)>> = true;
template <class Plugin, class = void>
constexpr bool has_step = false;
template <class Plugin>
inline constexpr bool
    has_step<Plugin, std::void_t<decltype(std::declval<Plugin&>().step(std::declval<const Step&>()))>> = true;
template <class Plugin, class = void>
constexpr bool has_const_step = false;
template <class Plugin>
inline constexpr bool
    has_const_step<Plugin, std::void_t<decltype(std::declval<const Plugin&>().step(std::declval<const Step&>()))>> =
        true;
template <class Plugin, class = void>
constexpr bool keeps_only_caches_of = false;
template <class Plugin>
inline constexpr bool keeps_only_caches_of<Plugin, std::void_t<decltype(Plugin::keeps_only_caches)>> =
    Plugin::keeps_only_caches;

// ---- Words for its author ----

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

}  // namespace detail

// ---- Declared parameters ----

struct Param : muster_param {
  constexpr Param free() const { return with(MUSTER_FREE); }          // a fit may move it
  constexpr Param required() const { return with(MUSTER_REQUIRED); }  // the world file must give it
  constexpr Param with(uint32_t flag) const {
    Param result = *this;
    result.flags |= flag;
    return result;
  }
};

constexpr Param real(const char* name, double value, double min, double max, const char* unit, const char* help) {
  return {{name, MUSTER_REAL, 0, value, min, max, unit, help, nullptr}};
}
constexpr Param integer(const char* name, double value, double min, double max, const char* help) {
  return {{name, MUSTER_INTEGER, 0, value, min, max, "", help, nullptr}};
}
constexpr Param flag(const char* name, bool value, const char* help) {
  return {{name, MUSTER_FLAG, 0, value ? 1.0 : 0.0, 0, 1, "", help, nullptr}};
}
// `choices` is "a|b|c"; the default is the first.
constexpr Param choice(const char* name, const char* choices, const char* help) {
  return {{name, MUSTER_CHOICE, 0, 0, 0, 0, "", help, choices}};
}
// The name of a row of `set`; -1 where the world file does not give it.
constexpr Param reference(const char* name, const char* set, const char* help) {
  return {{name, MUSTER_REFERENCE, 0, -1, -1, 0, "", help, set}};
}
constexpr Param text(const char* name, const char* value, const char* help) {
  return {{name, MUSTER_TEXT, 0, 0, 0, 0, "", help, value}};
}
// A path, relative to the world file.
constexpr Param file(const char* name, const char* help) { return {{name, MUSTER_FILE, 0, 0, 0, 0, "", help, ""}}; }

// Texts in quotes where numbers are expected, of which the compiler would name no argument; to a bool each is true.
namespace detail {
template <class...>
constexpr bool is_a_number = false;
template <class... Rest>
constexpr Param text_for_real() {
  static_assert(is_a_number<Rest...>,
                "real(name, default, min, max, unit, help): default, min and max are numbers without quotes, such as "
                "real(\"speed\", 0.2, 0, 2, \"m/s\", \"forward speed\")");
  return {};
}
}  // namespace detail
template <std::size_t n, class... Rest>
constexpr Param real(const char*, const char (&)[n], const Rest&...) {
  return detail::text_for_real<Rest...>();
}
template <std::size_t n, class... Rest>
constexpr Param real(const char*, double, const char (&)[n], const Rest&...) {
  return detail::text_for_real<Rest...>();
}
template <std::size_t n, class... Rest>
constexpr Param real(const char*, double, double, const char (&)[n], const Rest&...) {
  return detail::text_for_real<Rest...>();
}
template <std::size_t n, class... Rest>
constexpr Param integer(const char*, const char (&)[n], const Rest&...) {
  static_assert(detail::is_a_number<Rest...>,
                "integer(name, default, min, max, help): default, min and max are numbers without quotes, such as "
                "integer(\"retries\", 3, 0, 10, \"sends again at most\")");
  return {};
}
template <std::size_t n, class... Rest>
constexpr Param flag(const char*, const char (&)[n], const Rest&...) {
  static_assert(detail::is_a_number<Rest...>,
                "flag(name, default, help): the default is true or false without quotes, such as flag(\"loop\", false, "
                "\"drives the way again and again\")");
  return {};
}

}  // namespace muster
