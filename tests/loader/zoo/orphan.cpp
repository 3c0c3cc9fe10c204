// Needs a library that is not installed.
#include "animal.hpp"
int gone();
struct Orphan : Animal {
  using Animal::Animal;
  void step(const muster::Step&) const { gone(); }
};
MUSTER_PLUGIN_IS(Orphan)
