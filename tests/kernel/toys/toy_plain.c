/* A plugin in plain C: a battery for each robot, emptied by a tenth of what is left each second. */
#include <muster/plugin.h>
#include <stdlib.h>

MUSTER_DECLARE_ABI

struct battery {
  const muster_host* host;
  int charge;
};

static const muster_param params[] = {
    {"rate", MUSTER_REAL, MUSTER_FREE, 0.1, 0, 1, "1/s", "share lost each second", NULL}};

static void* create(const muster_host* host) {
  struct battery* self = malloc(sizeof *self);
  if (!self) return NULL;
  self->host = host;
  self->charge = host->claim(host, MUSTER_WRITE, MUSTER_SENSED, "robot/*/battery", "charge");
  if (self->charge < 0) {
    free(self);
    return NULL;
  }
  return self;
}

static void destroy(void* self) { free(self); }

static int step(void* self, const muster_tick* tick, const muster_in* in, const muster_out* out) {
  const struct battery* battery = self;
  const muster_out* to = &out[battery->charge];
  for (uint32_t row = 0; row < to->rows; ++row) {
    const double left = in[battery->charge].tick == 0 ? 1 : in[battery->charge].data[row];
    to->data[row] = left * (1 - tick->params[0] * tick->dt);
  }
  if (tick->index == 5) battery->host->event(battery->host, "five ticks old");
  return MUSTER_OK;
}

static const muster_plugin plugin = {.size = sizeof(muster_plugin),
                                     .phase = MUSTER_PHYSICS,
                                     .id = "toy.plain/1",
                                     .summary = "batteries in plain C",
                                     .params = params,
                                     .param_count = 1,
                                     .create = create,
                                     .destroy = destroy,
                                     .step = step};

int muster_register(uint32_t abi, void* registry, muster_add add) {
  return abi == MUSTER_ABI ? add(registry, &plugin) : MUSTER_FAILED;
}
