// What a plugin's struct declares, found at compile time: each member by its name, or that it has none.
#pragma once

#include <muster/plugin.h>

#include <type_traits>
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

}  // namespace detail
}  // namespace muster
