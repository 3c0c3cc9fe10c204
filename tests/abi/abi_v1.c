/* Uses each function of the host, as plugins of the first version do. */
#include <muster/plugin.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

MUSTER_DECLARE_ABI

struct all {
  const muster_host* host;
  uint64_t stream;
  int pose, own, sum, queue, messages, joins, file;
  double sent;
};

static const muster_param params[] = {
    {"gain", MUSTER_REAL, MUSTER_FREE, 2, 0, 10, "dB", "a gain", NULL},
    {"count", MUSTER_INTEGER, 0, 3, 0, 9, "", "a count", NULL},
    {"loud", MUSTER_FLAG, 0, 1, 0, 1, "", "a flag", NULL},
    {"how", MUSTER_CHOICE, 0, 0, 0, 0, "", "a choice", "well|badly"},
    {"robot", MUSTER_REFERENCE, 0, -1, -1, 0, "", "a robot", "robot"},
    {"word", MUSTER_TEXT, 0, 0, 0, 0, "", "a text", "hello"},
    {"data", MUSTER_FILE, MUSTER_REQUIRED, 0, 0, 0, "", "a file", ""},
};

static void* create(const muster_host* host) {
  struct all* self = calloc(1, sizeof *self);
  if (!self) return NULL;
  self->host = host;
  self->pose = host->claim(host, MUSTER_READ, MUSTER_OPTIONAL, "robot/*/nothing", "x");
  self->own =
      host->claim(host, MUSTER_WRITE, 0, "self/state", "gain count loud how robot rows alive key stream heard file");
  self->sum = host->claim(host, MUSTER_ADD, 0, "robot/*/sum@part", "s");
  self->queue = host->claim(host, MUSTER_WRITE, 0, "outbox/*/message", "radio:radio to:radio? payload{}");
  self->messages = host->claim(host, MUSTER_READ, 0, "outbox/*/message", "radio:radio to:radio? payload{}");
  self->joins = host->claim(host, MUSTER_WRITE, MUSTER_JOINS, "robot/*/sum", "s");
  self->file = host->file(host, "data", "robot:robot x[m]");
  self->stream = host->stream(host, "noise");
  if (strcmp(host->text(host, "word"), "hello") || strcmp(host->text(host, "robot/a/model"), "scarab") ||
      !host->search_path(host, 0) || host->text(host, "nothing") || host->search_path(host, 99) ||
      host->size < sizeof *host || host->abi != MUSTER_ABI)
    host->refuse(host, "the host does not answer as it did");
  return self;
}

static void destroy(void* self) { free(self); }

static int step(void* self, const muster_tick* tick, const muster_in* in, const muster_out* out) {
  struct all* all = self;
  const muster_host* host = all->host;
  uint64_t count = 0;
  double heard = 0;
  for (uint32_t row = 0; row < in[all->messages].rows; ++row) {
    const uint8_t* bytes = host->get_bytes(host, all->messages, row, 2, &count);
    heard += count == 3 && !memcmp(bytes, "abc", 3);
  }
  double* message = host->append(host, all->queue, 1);
  const uint64_t null_bits = MUSTER_NULL_BITS;
  message[0] = 0;
  memcpy(&message[1], &null_bits, sizeof null_bits);
  host->put_bytes(host, all->queue, 0, 2, (const uint8_t*)"abc", 3);
  if (tick->index == 2) {
    const int late = host->join(host, all->joins, "late", -1);
    if (late < 0 || host->place(host, all->joins, (uint32_t)late, "sum", 0, 5) != MUSTER_OK) return MUSTER_FAILED;
  }
  if (tick->index == 4 && host->leave(host, all->joins, 1) != MUSTER_OK) return MUSTER_FAILED;
  if (tick->index == 5) host->event(host, host->row_name(host, "robot", 1));
  if (tick->index == 6) {
    host->error(host, "and that was all");
    return MUSTER_FAILED;
  }
  for (uint32_t row = 0; row < out[all->sum].rows; ++row) out[all->sum].data[row] = tick->time + tick->dt;
  double* own = out[all->own].data;
  const double kept = in[all->own].data[9];
  memcpy(own, tick->params, 5 * sizeof *own);
  own[0] = host->param(host, "gain");
  own[5] = host->rows(host, "robot");
  own[6] = host->row_alive(host, "robot", 1);
  own[7] = (double)(host->row_key(host, "robot", 0) >> 12);
  own[8] = (double)(all->stream >> 12);
  own[9] = kept + heard;
  own[10] = in[all->file].data[1] + in[all->pose].rows;
  return MUSTER_OK;
}

static const muster_cause cause = {.size = sizeof(muster_cause),
                                   .kind = MUSTER_WORLD_EDIT,
                                   .title = "as the first version had it, by {gain}",
                                   .ranges_over = "",
                                   .covariates = "",
                                   .imitators = "",
                                   .tell_apart = ""};

static const muster_plugin plugin = {.size = sizeof(muster_plugin),
                                     .phase = MUSTER_NETWORK,
                                     .id = "abi.v1/1",
                                     .summary = "as the first version had it",
                                     .params = params,
                                     .param_count = sizeof params / sizeof *params,
                                     .create = create,
                                     .destroy = destroy,
                                     .step = step,
                                     .cause = &cause};

int muster_register(uint32_t abi, void* registry, muster_add add) {
  return abi == MUSTER_ABI ? add(registry, &plugin) : MUSTER_FAILED;
}
