// Parameters that a plugin declares: attributes of its element, with bounds, unit and help.
#pragma once

#include <muster/plugin.h>

#include <cstddef>

namespace muster {

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
