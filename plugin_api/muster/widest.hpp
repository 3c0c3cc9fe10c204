// One function compiled for several vector widths; the widest that the machine runs is chosen at run time. Nothing is
// fused or reordered (-ffp-contract=off), so each gives the same bits.
#pragma once

namespace muster {

// Body::run is always inlined: branch-free loops, which the compiler vectorises.
template <class Body, class... Arguments>
class Widest {
 public:
  using Function = void (*)(Arguments...);

  static void run(Arguments... arguments) {
    static const Function widest = all().of[all().number - 1];
    widest(arguments...);
  }

  // The versions that this machine can run, the widest last.
  struct Functions {
    Function of[3];
    int number;
  };
  static Functions all() {
    Functions result{{plain}, 1};
#ifdef __x86_64__
    if (__builtin_cpu_supports("x86-64-v3")) result.of[result.number++] = v3;
    if (__builtin_cpu_supports("x86-64-v4")) result.of[result.number++] = v4;
#endif
    return result;
  }

 private:
  static void plain(Arguments... arguments) { Body::run(arguments...); }
#ifdef __x86_64__
  [[gnu::target("arch=x86-64-v3")]] static void v3(Arguments... arguments) { Body::run(arguments...); }
  [[gnu::target("arch=x86-64-v4,prefer-vector-width=512")]] static void v4(Arguments... arguments) {
    Body::run(arguments...);
  }
#endif
};

}  // namespace muster
