// Registers control floating-point arithmetic: a callback that changes them changes every plugin's results, and so does
// the mere loading of a library built with -ffast-math. Keep one guard for a run and call changed() after each
// callback.
#pragma once

#include <xmmintrin.h>

#include <cstdint>
#include <string>

#ifndef __x86_64__
#error "FloatGuard reads the registers of x86-64"
#endif

namespace muster {

// Saves the constructing thread's rounding mode and its treatment of denormals and exceptions; the destructor restores
// them. Any thread that ought to compute in the same way may call it.
class FloatGuard {
 public:
  FloatGuard() noexcept : mxcsr_(_mm_getcsr()), x87_(x87_control()) {}
  ~FloatGuard() {
    if (changed()) restore();
  }
  FloatGuard(const FloatGuard&) = delete;
  FloatGuard& operator=(const FloatGuard&) = delete;

  // Sticky exception flags do not count: ordinary arithmetic raises them.
  bool changed() const noexcept { return ((_mm_getcsr() ^ mxcsr_) & ~flags) != 0 || x87_control() != x87_; }

  // The change since, in words that follow a name ("rounds upward"); empty if there is none. Call before restore().
  std::string what() const {
    const unsigned now = _mm_getcsr();
    const unsigned differs = now ^ mxcsr_;
    std::string result;
    const auto add = [&result](const std::string& words) { result += (result.empty() ? "" : ", ") + words; };
    if (differs & denormals) add((now & denormals) ? "flushes denormals to zero" : "stops flushing denormals to zero");
    if (differs & rounding) add(std::string("rounds ") + direction(now >> 13));
    if (differs & masks) add("changes which floating-point exceptions trap");
    const unsigned x87_differs = x87_control() ^ x87_;
    if ((x87_differs & x87_rounding) && !(differs & rounding))
      add(std::string("makes the x87 round ") + direction(x87_control() >> 10));
    if (x87_differs & ~unsigned{x87_rounding}) add("changes the x87 control word");
    return result;
  }

  void restore() const noexcept {
    _mm_setcsr((mxcsr_ & ~flags) | (_mm_getcsr() & flags));
    asm volatile("fldcw %0" : : "m"(x87_));
  }

 private:
  // Intel 64 and IA-32 Architectures Software Developer's Manual, volume 1: 10.2.3 (MXCSR) and 8.1.5 (x87 control
  // word).
  static constexpr unsigned flags = 0x003f, denormals = 0x8040, masks = 0x1f80, rounding = 0x6000,
                            x87_rounding = 0x0c00;

  static std::uint16_t x87_control() noexcept {
    std::uint16_t word;
    asm volatile("fnstcw %0" : "=m"(word));
    return word;
  }
  static const char* direction(unsigned bits) noexcept {
    constexpr const char* names[] = {"to nearest", "downward", "upward", "toward zero"};
    return names[bits & 3];
  }

  unsigned mxcsr_;
  std::uint16_t x87_;
};

}  // namespace muster
