// Whether a sanitizer watches: its shadow costs time and memory of its own, and it keeps what is freed. Bounds of time
// and memory are not held then.
#pragma once

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/lsan_interface.h>
#endif

namespace muster::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

// What is left behind on purpose, such as what a crash left half changed: it is no leak if it was allocated on this
// thread while one of these lives.
class LeftBehind {
 public:
  LeftBehind() { watch(false); }
  ~LeftBehind() { watch(true); }
  LeftBehind(const LeftBehind&) = delete;
  LeftBehind& operator=(const LeftBehind&) = delete;

 private:
  static void watch([[maybe_unused]] bool on) {
#if defined(__SANITIZE_ADDRESS__)
    on ? __lsan_enable() : __lsan_disable();
#endif
  }
};

}  // namespace muster::test
