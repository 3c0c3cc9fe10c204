#include "animal.hpp"
namespace missing {
double law(double distance, const char* unit);
}
struct Lost : Animal {
  using Animal::Animal;
  void step(const muster::Step&) const { missing::law(1, "m"); }
};
MUSTER_PLUGIN_IS(Lost)
