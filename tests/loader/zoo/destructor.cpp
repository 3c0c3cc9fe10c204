// Throws when it is unloaded.
#include "animal.hpp"
namespace {
struct Guest {
  ~Guest() noexcept(false) { throw std::runtime_error("not yet"); }
} guest;
}  // namespace
MUSTER_PLUGIN_IS(Animal)
