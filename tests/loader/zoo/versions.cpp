// Two builds of one plugin. Its steps leave an object behind in each thread, which keeps the library mapped while that
// thread lives.
#include "animal.hpp"

struct Version : Animal {
  static constexpr auto summary = VERSION;
  using Animal::Animal;
  void step(const muster::Step&) const {
    thread_local std::string scratch;
    scratch += VERSION;
  }
};
MUSTER_PLUGIN_IS(Version)
