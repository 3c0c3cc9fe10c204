// Whether a sanitizer watches: its shadow costs time and memory of its own, and it keeps what is freed. Bounds of time
// and memory are not held then.
#pragma once

namespace muster::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace muster::test
