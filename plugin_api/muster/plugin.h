/* The whole contract between the kernel and a plugin: plain C, no allocation crosses it.
 *
 * A plugin registers descriptors; the kernel makes instances of them as the world file declares. Instances never call
 * each other: each reads and writes tables on the shared blackboard. All state that outlives a step is in tables;
 * anything else that an instance keeps must be computable from them. So a snapshot is a copy of the tables, and a
 * backend can be swapped between any two ticks.
 *
 * Structs that the kernel fills or reads begin with their `size` and grow only at the end.
 * Tags: [setup] inside create() only, [step] inside step() only, [any] from any callback. */
#ifndef MUSTER_PLUGIN_H
#define MUSTER_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Changes when a struct below changes meaning. Fields added at an end do not change it: see `size`. */
#define MUSTER_ABI 1u

/* Every tick runs the phases in this order; zero is never a valid phase. */
enum {
  MUSTER_CONTROL = 1, /* decisions of robots, from what they sense */
  MUSTER_ACTUATE,     /* commands on their way to the drives */
  MUSTER_PHYSICS,     /* bodies move from t - dt to t */
  MUSTER_RADIO,       /* the channel at t */
  MUSTER_NETWORK,     /* packets and messages */
  MUSTER_SENSE,       /* sensor readings of the world at t */
  MUSTER_OBSERVE      /* metrics and records; nothing inside the tick waits for them */
};

enum { MUSTER_OK = 0, MUSTER_FAILED = 1 };

/* Kinds of access to a table; see muster_host.claim. */
enum {
  MUSTER_READ = 1, /* in[i]: the table */
  MUSTER_WRITE,    /* out[i]: to be filled, every cell; in[i]: what this claim last published, so an own state needs no
                      second claim */
  MUSTER_ADD,      /* out[i]: a part of a sum; readers get the total in world-file order, or one part by its name */
  MUSTER_MODIFY    /* in[i]: the stage before; out[i]: this stage, to be filled; stages run in world-file order. Queues:
                      in[i]: rows that it has not seen; what goes on is appended */
};
enum {
  MUSTER_OPTIONAL = 1u, /* read: if the table has no writer, in[i] has no rows instead of an error */
  MUSTER_REST = 2u,     /* write: every row that no other instance claims by its name, instead of all rows */
  MUSTER_SENSED = 4u,   /* write: a quantity that is not standard may be read by the controllers of its row */
  MUSTER_ADOPTS =
      8u,            /* write: at a swap, take the table over although its columns differ (missing cells are initial) */
  MUSTER_JOINS = 16u /* write: this instance may call join() and leave() for the set */
};

/* Value of an empty nullable cell. Any other NaN is a fault of its writer. */
#define MUSTER_NULL_BITS 0x7ff8000000000000ull

/* A view of one table, row-major, [rows x cols]. Valid only until step() returns: never keep the pointer. */
typedef struct muster_in {
  const double* data;
  uint32_t rows, cols;
  uint64_t tick; /* of its last publication; 0: the initial values of the world file */
} muster_in;

typedef struct muster_out {
  double* data;
  uint32_t rows, cols;
} muster_out;

/* [step] Evaluate expectations instead of draws: E[reading in dB]. A fit compares means with measurements. */
enum { MUSTER_EXPECTED = 1u };

typedef struct muster_tick {
  uint32_t size, flags;
  uint64_t index;       /* 0 in the SENSE pass before the first tick */
  double time;          /* [s] index times the world's dt: the time of the values that are written */
  double dt;            /* [s] this instance's own period, every times the world's dt */
  const double* params; /* one value a declared parameter, in the order of declaration; a text or file counts as 0 */
} muster_tick;

/* Kinds of parameters. A value is a double: an integer; 0 or 1; the choice's place in its list; a row's number. */
enum { MUSTER_REAL = 1, MUSTER_INTEGER, MUSTER_FLAG, MUSTER_CHOICE, MUSTER_REFERENCE, MUSTER_TEXT, MUSTER_FILE };
enum {
  MUSTER_FREE = 1u,     /* a fit may move it, inside its bounds */
  MUSTER_REQUIRED = 2u, /* the world file must give it */
  /* Hints for a diagnosis that searches over a cause's parameter. */
  MUSTER_LINEAR = 4u,  /* the cause's contribution is proportional to it */
  MUSTER_LOG = 8u,     /* its scale is logarithmic: 1, 2, 4, ... */
  MUSTER_CYCLIC = 16u, /* max is min again: an angle */
  MUSTER_EAST = 32u,   /* a coordinate in the world, to be sought over the plan's extent: x */
  MUSTER_NORTH = 64u,  /* the same: y */
  MUSTER_EACH = 128u   /* each of its values is tried: of a choice, of an integer */
};

/* One attribute of the plugin's element in the world file. XML check, schema, manual, fit and sweep derive from it. */
typedef struct muster_param {
  const char* name;
  uint32_t kind, flags;
  double value, min, max; /* default and bounds of a number */
  const char* unit;       /* "" where it has none */
  const char* help;
  const char* text; /* choice: "a|b|c"; reference: the set; text or file: the default; else NULL */
} muster_param;

/* Calls that the kernel offers an instance. */
typedef struct muster_host {
  uint32_t size, abi;
  void* kernel;

  /* [setup] Claim a table as `kind` says; the result indexes step()'s `in` and `out`, or is -1 with the error already
   * reported. `table` is set/row/quantity: "robot/leader/pose" is one row, "robot/ * /pose" (without the blanks) every
   * row, "robot/{robot}/pose" the row that the parameter `robot` names, "self/quantity" a row of the instance's own.
   * After @ follows an instance's part of a sum or stage of a chain; an adder may name its parts
   * ("link/ * /level@walls" is read as level@INSTANCE.walls).
   *
   * `columns` are "x[m] y[m] theta[rad]", "range[m]*682" for many alike, "rssi[dBm]?" where a cell may be empty,
   * "range[m]~" where it may be infinite, "payload{}" for bytes, "tx:endpoint" for a row number of another set. A
   * reader's must equal its writer's. */
  int (*claim)(const struct muster_host*, uint32_t kind, uint32_t flags, const char* table, const char* columns);
  /* [setup] The table in the CSV file that parameter `param` names, with these columns in this order; " ." at the end:
   * no others; " +": and a row. A nullable one may be absent; references are names of rows ("tx:radio+": or join). */
  int (*file)(const struct muster_host*, const char* param, const char* columns);
  /* [setup] A text parameter by its name, or a text attribute by its path ("robot/leader/model"); NULL if absent.
   * [any] Where the world file has a row, the instance, or one of a plugin: "world.xml:3:1" of "robot/leader/place",
   * "self/place", "world/radio.receiver/place". */
  const char* (*text)(const struct muster_host*, const char* path);
  /* [setup] The directories in which files such as robots' models are looked for: those of the plugins, then the
   * world's own; NULL after the last. */
  const char* (*search_path)(const struct muster_host*, uint32_t index);
  /* [setup] The key of a declared random stream, from the world's seed and this name alone. */
  uint64_t (*stream)(const struct muster_host*, const char* name);
  /* [any] A parameter's value now, by its name. */
  double (*param)(const struct muster_host*, const char* name);
  /* [any] Rows of a set: their number ever, a row's name, its key for random numbers (from the name alone), and whether
   * it is still in the set. NULL or 0 past the end. */
  uint32_t (*rows)(const struct muster_host*, const char* set);
  const char* (*row_name)(const struct muster_host*, const char* set, uint32_t row);
  uint64_t (*row_key)(const struct muster_host*, const char* set, uint32_t row);
  int (*row_alive)(const struct muster_host*, const char* set, uint32_t row);
  /* [step] Queues and listed sets: `rows` more rows of the written claim, to be filled; the pointer to the first. */
  double* (*append)(const struct muster_host*, int claim, uint32_t rows);
  /* [step] Bytes in a cell of a bytes column. get: of a read table, valid until step() returns; put: copied. */
  const uint8_t* (*get_bytes)(const struct muster_host*, int claim, uint32_t row, uint32_t column, uint64_t* count);
  void (*put_bytes)(const struct muster_host*, int claim, uint32_t row, uint32_t column, const uint8_t* data,
                    uint64_t count);
  /* [step] A new row of a live set, seen by all from the next tick on; its values are those of row `like`, or initial
   * ones if `like` is negative; the new row's number, or -1. leave: the row keeps its number and its last values. */
  int (*join)(const struct muster_host*, int claim, const char* name, int like);
  int (*leave)(const struct muster_host*, int claim, uint32_t row);
  /* [step] One initial value of a row that joined in this very step: quantity, column by number. */
  int (*place)(const struct muster_host*, int claim, uint32_t row, const char* quantity, uint32_t column, double value);
  /* [any] Reports the reason before a callback fails; the kernel adds file, line, instance, callback and tick. */
  void (*error)(const struct muster_host*, const char* message);
  /* [any] As error(), for a fault of the user's input rather than of the plugin: a parameter, a file. */
  void (*refuse)(const struct muster_host*, const char* message);
  /* [any] A line for the run's list of events. */
  void (*event)(const struct muster_host*, const char* message);
  /* [step] Calls one(work, i) for each i below `count`, on the run's threads and in any order, and returns when all are
   * done. `one` does not call the host and writes nothing that another call reads or writes, so the result does not
   * depend on the number of threads. */
  void (*each)(const struct muster_host*, uint32_t count, void (*one)(void* work, uint32_t i), void* work);
} muster_host;

/* Kinds of causes, by the part of the simulation that they change. */
enum {
  MUSTER_TERM = 1,   /* adds to the level of links, in dB */
  MUSTER_STAGE,      /* a stage of a chain: the receiver's, a command's */
  MUSTER_WORLD_EDIT, /* changes rows of the world's sets: a wall, a place */
  MUSTER_LAW,        /* changes a probability law: fading, outliers */
  MUSTER_INSTRUMENT  /* a fault of the record itself: identities exchanged, a unit */
};
/* Flags of causes. A cause whose `size` ends before its flags has MUSTER_FIRST as a world edit and an instrument. */
enum {
  MUSTER_FIRST = 1u,     /* where it is found beside others, they are judged again in a world that has it */
  MUSTER_OWN_WORLD = 2u, /* it bends all that is fitted without it: it is no term beside others, but judged in a world
                            that has it, with parameters and noise fitted there */
  MUSTER_BOTH_ENDS = 4u  /* it tells what a radio sends from what it receives: tested for radios that do both in the
                            data. Of others it equals a cause of what they send, or receive */
};

/* Declares a plugin as a cause: a diagnosis may accept it as the explanation of a misfit. */
typedef struct muster_cause {
  uint32_t size, kind;
  const char* title;       /* one sentence with {parameter} slots: "the radio {radio} sends {offset} more than given" */
  const char* ranges_over; /* the reference parameter that names the affected row: "radio", "wall"; "" for the world */
  const char* covariates;  /* columns that it needs in measured data: "t", "rx_yaw"; "" for none */
  const char* imitators;   /* ids of causes that it can be mistaken for, with blanks between */
  const char* tell_apart;  /* measurements that separate it from its imitators */
  const char* replaces;    /* the plugin's part of a sum that it replaces; NULL: it is added */
  uint32_t flags;
} muster_cause;

/* What a term draws, as a probability law: normal, with mean 0. A fit and a diagnosis take errors to be correlated so.
 */
typedef struct muster_draw {
  uint32_t size;
  const char* scale;    /* the real parameter that the draw is proportional to: "shadowing" */
  const char* distance; /* the real parameter over which it decorrelates, in m: "decorrelation" */
  /* out[i]: covariance of the draws on links a and b, in the term's units squared, at these values of all parameters.
   * `ends`: one row a link, x y z of one end, then of the other, in m; a[i] and b[i] are rows of it. The same for
   * both directions of a link. It is called from several threads and without an instance. */
  void (*covariance)(const double* params, const double* ends, const uint32_t* a, const uint32_t* b, uint32_t count,
                     double* out);
} muster_draw;

/* Flags of laws of readings. */
enum {
  MUSTER_REPLACES = 1u /* it is drawn instead of the laws with this flag that stand before it in the world file: fading.
                          Without, its draws are added to those of all others and independent of them */
};

/* What a plugin adds to single readings, in dB, as a probability law: each reading, or each place, draws anew. A
 * diagnosis fits it to the readings; a cause with a law is found by it. The functions are called from several threads
 * and without an instance; `params` has the values of all parameters. */
typedef struct muster_law {
  uint32_t size, flags;
  const char* strength; /* the real parameter that is fitted: "rician_k", "share" */
  const double* grid;   /* values of it, positive and growing, from which its search starts; NULL with MUSTER_REPLACES:
                           the search starts from multiples of the variance that the world states */
  const char* form;     /* a further number, of which the best of `forms` is taken: "half_width"; NULL: none */
  const double* forms;  /* growing */
  uint32_t grid_count, form_count;
  uint32_t most_draws; /* the density is known for up to so many independent draws, whose mean power a receiver reports;
                          1: for single ones */
  /* out[i]: natural logarithm of the density per dB at db[i]; -infinity where there is none. 0 dB: nothing is added. */
  void (*log_density)(const double* params, uint32_t draws, const double* db, uint32_t count, double* out);
  /* Values that have a probability of their own, beside the density: fills at most `most` of them, returns their
   * number. NULL: none. */
  uint32_t (*atoms)(const double* params, double* db, double* probability, uint32_t most);
  /* Mean of single draws in dB, which step() gives as MUSTER_EXPECTED; NULL: 0. */
  double (*mean)(const double* params);
  /* Way of either end in m after which a reading draws anew; NULL: 0, each does. */
  double (*apart)(const double* params);
} muster_law;

/* Sides of a clip. */
enum { MUSTER_ABOVE = 1, MUSTER_BELOW };

/* What a receiver does to levels beyond one of its own. A diagnosis and a fit take such readings for bounds. */
typedef struct muster_clip {
  uint32_t size;
  uint32_t side;      /* MUSTER_ABOVE or MUSTER_BELOW: where it acts */
  const char* level;  /* the real parameter with the level, in dBm */
  uint32_t silent;    /* 1: levels beyond are not reported; 0: they are reported as the level itself */
  const char* choice; /* the flag parameter that says so instead of `silent`: 1 or 0; NULL: none */
} muster_clip;

/* Bursts of loss on the links between two radios, both ways alike, at times that nobody knows. */
typedef struct muster_burst {
  uint32_t size;
  const char *one, *other;             /* the references that name both radios */
  const char *loss, *share, *duration; /* real parameters: in dB; of the time; in s, of one burst */
} muster_burst;

typedef struct muster_plugin {
  uint32_t size;
  uint32_t phase;
  const char* id;      /* "radio.multiwall/1": the revision changes when its results do */
  const char* summary; /* one line, for `muster plugins` */
  const char* manual;  /* some lines for `muster describe`: model, limits, source; or NULL */
  const muster_param* params;
  uint32_t param_count;
  const char* cannot_hold; /* state of another backend that a swap to this one drops, in words; NULL: nothing */
  void* (*create)(const muster_host*);
  void (*destroy)(void* self);
  /* `in` and `out` have one entry a claim, in the order of the claims. */
  int (*step)(void* self, const muster_tick*, const muster_in* in, const muster_out* out);
  const muster_cause* cause; /* NULL: not a cause */
  const muster_draw* draw;   /* NULL: it draws nothing that is correlated, or says nothing of it */
  const muster_law* law;     /* NULL: it draws nothing for single readings, or says nothing of it */
  const muster_clip* clip;   /* NULL: it clips no readings */
  const muster_burst* burst; /* NULL: it has no bursts */
} muster_plugin;

/* The one symbol a plugin exports. Calls `add` once for each descriptor, which must outlive the library. */
typedef int (*muster_add)(void* registry, const muster_plugin*);
__attribute__((visibility("default"))) int muster_register(uint32_t abi, void* registry, muster_add add);

/* Once in each plugin: the section from which the kernel reads the ABI revision before any of the plugin's code runs.
 */
#define MUSTER_DECLARE_ABI \
  __attribute__((section("muster.abi.1"), used)) static const uint32_t muster_abi_revision = MUSTER_ABI;

#ifdef __cplusplus
}
#endif
#endif
