// Written against plugin.h alone: nothing stops what it throws but the kernel.
#include <muster/plugin.h>

#include <stdexcept>

namespace {

int self = 0;

void* create(const muster_host*) { return &self; }
void destroy(void*) {}
int step(void*, const muster_tick* tick, const muster_in*, const muster_out*) {
  if (tick->index == 5) throw std::out_of_range("no such shelf");
  return MUSTER_OK;
}

muster_plugin described() {
  muster_plugin result{};
  result.size = sizeof result;
  result.phase = MUSTER_OBSERVE;
  result.id = "test.bare/1";
  result.summary = "throws across the border";
  result.create = create;
  result.destroy = destroy;
  result.step = step;
  return result;
}
const muster_plugin plugin = described();

}  // namespace

MUSTER_DECLARE_ABI
extern "C" int muster_register(uint32_t, void* registry, muster_add add) { return add(registry, &plugin); }
