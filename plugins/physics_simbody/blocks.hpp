// Arrays aligned to cache lines, so that blocks of eight numbers are read and written whole.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace muster::simbody {

constexpr std::size_t cache_line = 64;

template <class T>
struct OnCacheLines {
  using value_type = T;

  OnCacheLines() = default;
  template <class U>
  OnCacheLines(const OnCacheLines<U>&) {}

  T* allocate(std::size_t count) {
    return static_cast<T*>(::operator new(count * sizeof(T), std::align_val_t(cache_line)));
  }
  void deallocate(T* p, std::size_t) { ::operator delete(p, std::align_val_t(cache_line)); }

  bool operator==(const OnCacheLines&) const { return true; }
  bool operator!=(const OnCacheLines&) const { return false; }
};

template <class T>
using Blocks = std::vector<T, OnCacheLines<T>>;

}  // namespace muster::simbody
