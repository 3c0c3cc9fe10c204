/* One of fifty plugins that differ in their ids alone: BENCH_ID, a definition of the build. */
#include <muster/plugin.h>

static int self;

static void* create(const muster_host* host) {
  (void)host;
  return &self;
}
static void destroy(void* made) { (void)made; }
static int step(void* made, const muster_tick* tick, const muster_in* in, const muster_out* out) {
  (void)made, (void)tick, (void)in, (void)out;
  return MUSTER_OK;
}

static const muster_plugin plugin = {.size = sizeof(muster_plugin),
                                     .phase = MUSTER_OBSERVE,
                                     .id = BENCH_ID,
                                     .summary = "one of many",
                                     .create = create,
                                     .destroy = destroy,
                                     .step = step};

MUSTER_DECLARE_ABI
int muster_register(uint32_t abi, void* registry, muster_add add) {
  return abi == MUSTER_ABI ? add(registry, &plugin) : MUSTER_FAILED;
}
