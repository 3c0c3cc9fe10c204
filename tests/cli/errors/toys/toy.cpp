#include "toy.hpp"

MUSTER_PLUGIN_IS(Toy)
