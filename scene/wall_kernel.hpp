// Counts the walls between a radio and many others, several lanes at a time: the part built for each instruction set.
// All kernels give the same counts: cases within rounding error are returned to the caller as doubts.
//
// Only plain data cross this border: the linker could replace a function that both sides compile by its newest form.
#pragma once

#include <cstdint>

namespace muster::scene {

constexpr int block = 16;      // walls, or boxes, in one box
constexpr int receivers = 32;  // processed at once

// Number of blocks from which receivers are sorted by direction around the radio instead of by proximity, and each half
// of them has its own list of walls: fewer walls are tested.
constexpr int widest_scene = 64;

// Numbers are whole lattice steps below 2^23, exact in a float, as are their differences.

// Neighbouring walls; padding has no height that a link meets.
struct alignas(64) WallBlock {
  float ax[block], ay[block], bx[block], by[block];  // a -> b runs southward
  float base[block], top[block];
  float plain_top[block];  // below all heights where doors leave holes: never plain
  int material[block];
};

// Boxes around blocks of walls, or around blocks of boxes.
struct alignas(64) BoxBlock {
  float west[block], east[block], south[block], north[block];
};

struct WallTable {
  static constexpr int most_levels = 8;
  int blocks = 0, materials = 0, levels = 0;
  const WallBlock* walls = nullptr;
  const BoxBlock* boxes[most_levels] = {};  // one box a block of walls; a block of boxes; and so on up to one block
};

// The walls of a block relative to one radio, with a -> b turned so that the radio is on their left.
struct alignas(64) SeenBlock {
  float ax[block], ay[block], bx[block], by[block];
  float area[block];    // a x b, twice that of the triangle with the radio
  float reach[block];   // the largest coordinate
  float margin[block];  // scratch: rounding margin for the present receivers
  float unused[block];
};
static_assert(sizeof(SeenBlock) == sizeof(WallBlock), "one offset serves both");

struct WallView {
  float x, y, z;
  SeenBlock* seen;
  std::uint16_t* unsure;  // of each block, the walls whose left side must be determined exactly
  int* lists[4];          // scratch: boxes or walls, each of 16 x blocks + 16
};

// Two, less than a half turn apart. Zero: unbounded, every point is between them.
struct Directions {
  float left_x, left_y, right_x, right_y;
};

// The way from a view's radio to 32 receivers: their relative positions and bounds.
struct alignas(64) Shaft {
  float x[receivers], y[receivers];
  float west, east, south, north;  // of the receivers
  float low, high;                 // of the receivers and the radio
  float reach;                     // the largest coordinate
  Directions all;                  // between which all receivers lie
};

// Lanes in which the crossing of a wall is within rounding error, or height or a door may decide.
struct Doubt {
  int wall;
  unsigned lanes;
};

struct WallKernel {
  const char* name;
  // Fills a view, except its scratch, from its x and y.
  void (*look)(const WallTable&, WallView&);
  // Fills the shaft from the view's radio to 32 receivers.
  void (*aim)(const WallView&, const float* x, const float* y, const float* z, Shaft& shaft);
  // Counts the walls in a shaft of the view: fills counts[material x 32 + receiver], aligned as blocks are, and returns
  // the number of doubts, at most two a wall.
  int (*count)(const WallTable&, const WallView&, const Shaft&, int* counts, Doubt* doubts);
  // The same for one link, added to counts[material], from the view's radio, without look(). Each doubt is of a block
  // of walls: `wall` is its first, and lanes are walls.
  int (*count_one)(const WallTable&, const WallView&, float x, float y, float z, int* counts, Doubt* doubts);
};

// The kernels that this machine can run, the widest last. There is at least one.
struct WallKernels {
  const WallKernel* all[3];
  int number = 0;
};
const WallKernels& wall_kernels();

}  // namespace muster::scene
