/* The contract needs no C++; two revisions live in one library, registered in the wrong order. */
#include <muster/plugin.h>
#include <stdlib.h>

MUSTER_DECLARE_ABI

static void* create(const muster_host* host) {
  (void)host;
  return malloc(1);
}
static int step(void* self, const muster_tick* tick, const muster_in* in, const muster_out* out) {
  (void)self, (void)tick, (void)in, (void)out;
  return MUSTER_OK;
}

static const muster_plugin second = {sizeof(muster_plugin),
                                     MUSTER_SENSE,
                                     "zoo.plain/2",
                                     "the second",
                                     NULL,
                                     NULL,
                                     0,
                                     NULL,
                                     create,
                                     free,
                                     step,
                                     NULL,
                                     NULL,
                                     NULL,
                                     NULL,
                                     NULL};
static const muster_plugin first = {sizeof(muster_plugin),
                                    MUSTER_SENSE,
                                    "zoo.plain/1",
                                    "the first",
                                    NULL,
                                    NULL,
                                    0,
                                    NULL,
                                    create,
                                    free,
                                    step,
                                    NULL,
                                    NULL,
                                    NULL,
                                    NULL,
                                    NULL};

int muster_register(uint32_t abi, void* registry, muster_add add) {
  return abi == MUSTER_ABI ? add(registry, &second) | add(registry, &first) : MUSTER_FAILED;
}
