// One function, compiled for several widths of vectors, of which the machine it runs on chooses the widest. Nothing is
// fused or reordered (-ffp-contract=off), so each gives the same bits.
#pragma once

namespace muster {

// Body::run is always inlined.
template <class Body, class... Arguments>
class Widest {
 public:
  static void run(Arguments... arguments) {
    static const auto widest = choose();
    widest(arguments...);
  }

 private:
  static void plain(Arguments... arguments) { Body::run(arguments...); }
#ifdef __x86_64__
  [[gnu::target("arch=x86-64-v3")]] static void v3(Arguments... arguments) { Body::run(arguments...); }
  [[gnu::target("arch=x86-64-v4,prefer-vector-width=512")]] static void v4(Arguments... arguments) {
    Body::run(arguments...);
  }
  static auto choose() {
    return __builtin_cpu_supports("x86-64-v4") ? v4 : __builtin_cpu_supports("x86-64-v3") ? v3 : plain;
  }
#else
  static auto choose() { return plain; }
#endif
};

}  // namespace muster
