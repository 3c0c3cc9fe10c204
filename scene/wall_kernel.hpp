// Which walls lie between a radio and many others, several lanes at a time: the part that is built for each instruction
// set. All kernels give the same counts, since what rounding could decide is left to the caller, as a doubt.
//
// Only plain data cross this border: a function that both sides compile could be linked in its newest form everywhere.
#pragma once

#include <cstdint>

namespace muster::scene {

constexpr int block = 16;      // walls, or boxes, that share a box
constexpr int receivers = 32;  // that are taken at once

// From so many blocks of walls on, receivers are taken as they lie around the radio, not as they lie together, and each
// half of them meets walls of its own: fewer walls stand between.
constexpr int widest_scene = 64;

// Numbers are whole lattice steps below 2^23, which a float holds exactly; so it does their differences.

// Neighbouring walls; those that only fill a block are met by no height.
struct alignas(64) WallBlock {
  float ax[block], ay[block], bx[block], by[block];  // a -> b runs southward
  float base[block], top[block];
  float plain_top[block];  // where doors leave holes, below all: never plain
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

// The walls of a block as one radio sees them: relative to it, a -> b turned so that the radio lies to their left.
struct alignas(64) SeenBlock {
  float ax[block], ay[block], bx[block], by[block];
  float area[block];    // a x b, twice that of the triangle with the radio
  float reach[block];   // the largest coordinate
  float margin[block];  // scratch: of rounding, for the receivers in hand
  float unused[block];
};
static_assert(sizeof(SeenBlock) == sizeof(WallBlock), "one offset serves both");

struct WallView {
  float x, y, z;
  SeenBlock* seen;
  std::uint16_t* unsure;  // of each block, the walls of which it must be worked out exactly which side is left
  int* lists[4];          // scratch: boxes or walls, each of 16 x blocks + 16
};

// Two, less than a half turn apart; or zero: then nothing is left of the one or right of the other.
struct Directions {
  float left_x, left_y, right_x, right_y;
};

// The way from a view's radio to 32 receivers: where they are, relative to it, and what surrounds them.
struct alignas(64) Shaft {
  float x[receivers], y[receivers];
  float west, east, south, north;  // of the receivers
  float low, high;                 // of the receivers and the radio
  float reach;                     // the largest coordinate
  Directions all;                  // between which all receivers lie
};

// Lanes in which rounding leaves open whether the wall is crossed, or height or a door may decide.
struct Doubt {
  int wall;
  unsigned lanes;
};

struct WallKernel {
  const char* name;
  // Fills what a view sees from its x and y, but for the scratch.
  void (*look)(const WallTable&, WallView&);
  // Fills the shaft from the view's radio to 32 receivers.
  void (*aim)(const WallView&, const float* x, const float* y, const float* z, Shaft& shaft);
  // The walls in a shaft of the view: fills counts[material x 32 + receiver], aligned as blocks are, and returns the
  // number of doubts, at most two a wall.
  int (*count)(const WallTable&, const WallView&, const Shaft&, int* counts, Doubt* doubts);
  // The same for one link, added to counts[material], from the view's radio, without having looked. Each doubt is of a
  // block of walls: `wall` is its first, and lanes are walls.
  int (*count_one)(const WallTable&, const WallView&, float x, float y, float z, int* counts, Doubt* doubts);
};

// Those that this machine can run, the widest last. There is always one.
struct WallKernels {
  const WallKernel* all[3];
  int number = 0;
};
const WallKernels& wall_kernels();

}  // namespace muster::scene
