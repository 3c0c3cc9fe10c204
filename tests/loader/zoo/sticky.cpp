// Has a unique symbol: a static object of a template with default visibility, built without -fno-gnu-unique.
#include "animal.hpp"
template <class T>
struct __attribute__((visibility("default"))) Sticky {
  static int& value() {
    static int number = 1;
    return number;
  }
};
struct Stuck : Animal {
  using Animal::Animal;
  void step(const muster::Step&) const { ++Sticky<int>::value(); }
};
MUSTER_PLUGIN_IS(Stuck)
