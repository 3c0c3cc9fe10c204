#include "animal.hpp"
MUSTER_PLUGIN_IS(Animal)
