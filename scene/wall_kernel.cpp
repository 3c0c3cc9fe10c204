// Built once for each instruction set, as MUSTER_KERNEL. Everything here but the kernel itself is internal.
//
// Seen from a radio p = 0 that lies left of a wall a -> b, the wall is crossed by the link to q just if q lies in the
// wall's shadow: q x a < 0, b x q < 0 and q x a + b x q + a x b < 0, the last being q's own side of the wall. So the
// largest of the three decides, and how far it is from zero says whether to believe it. With coordinates of q below R
// and of a and b below A, exact in a float, the third is off by at most (16 R A + 6 A^2) 2^-24, the others by less: a
// margin of 32 A max(A, R) 2^-24 is safe, fused or not.
#include "scene/wall_kernel.hpp"

#include <experimental/simd>

#define MUSTER_INLINE [[gnu::always_inline]] inline
#define MUSTER_TEXT_OF(name) #name
#define MUSTER_TEXT(name) MUSTER_TEXT_OF(name)

namespace muster::scene {
namespace {

namespace stdx = std::experimental;
using Floats = stdx::native_simd<float>;
using Mask = Floats::mask_type;
using Integers = stdx::rebind_simd_t<int, Floats>;
using Numbers = stdx::fixed_size_simd<int, 8>;
constexpr int lanes = static_cast<int>(Floats::size()), parts = receivers / lanes, halves = 2;
static_assert(block % lanes == 0 && receivers % block == 0 && sizeof(Floats) <= alignof(WallBlock));

constexpr float rounding = 0x1p-19f;  // the margin above
constexpr float huge = 1e30f;

MUSTER_INLINE Floats load(const float* from) { return Floats(from, stdx::vector_aligned); }
MUSTER_INLINE void store(const Floats& values, float* to) { values.copy_to(to, stdx::vector_aligned); }
MUSTER_INLINE unsigned bits(const Mask& mask) { return static_cast<unsigned>(mask.__to_bitset().to_ulong()); }
MUSTER_INLINE Floats min(Floats a, Floats b) { return stdx::min(a, b); }
MUSTER_INLINE Floats max(Floats a, Floats b) { return stdx::max(a, b); }
MUSTER_INLINE float min(float a, float b) { return a < b ? a : b; }
MUSTER_INLINE float max(float a, float b) { return a > b ? a : b; }
MUSTER_INLINE Floats choose(const Mask& mask, Floats yes, const Floats& no) {
  stdx::where(!mask, yes) = no;
  return yes;
}
// -1 where the sign bit is set, 0 elsewhere.
MUSTER_INLINE Integers minus_if_negative(const Floats& a) {
  Integers result;
  static_assert(sizeof result == sizeof a);
  __builtin_memcpy(static_cast<void*>(&result), &a, sizeof a);
  return result >> 31;
}
MUSTER_INLINE Floats magnitude(const Floats& a) { return stdx::abs(a); }
MUSTER_INLINE float magnitude(float a) { return a < 0 ? -a : a; }

// For each byte, the numbers of its set bits in order.
struct Bits {
  std::uint8_t of[256][8] = {};
  constexpr Bits() {
    for (unsigned byte = 0; byte < 256; ++byte) {
      int number = 0;
      for (unsigned bit = 0; bit < 8; ++bit) {
        if ((byte >> bit & 1) != 0) of[byte][number++] = static_cast<std::uint8_t>(bit);
      }
    }
  }
};
constexpr Bits set_bits;

// Appends the numbers of the set bits, counted from `first`, without a branch. Writes up to eight more than it appends.
MUSTER_INLINE int* append(unsigned set, int first, int* to) {
  for (int byte = 0; byte < lanes; byte += 8, set >>= 8) {
    const Numbers numbers(set_bits.of[set & 255], stdx::element_aligned);
    (numbers + (first + byte)).copy_to(to, stdx::element_aligned);
    to += __builtin_popcount(set & 255);
  }
  return to;
}

// The blocks of walls whose boxes, and all boxes around them, pass a test. The list is left in view.one.
template <class Test>
int surviving(const WallTable& table, const WallView& view, const Test& test) {
  int *now = view.one, *next = view.other;
  int number = 1;
  now[0] = 0;
  for (int level = table.levels - 1; level >= 0; --level) {
    int* end = next;
    for (int i = 0; i < number; ++i) {
      const BoxBlock& box = table.boxes[level][now[i]];
      for (int k = 0; k < block; k += lanes) {
        end = append(bits(test(load(box.west + k) - view.x, load(box.east + k) - view.x, load(box.south + k) - view.y,
                               load(box.north + k) - view.y)),
                     now[i] * block + k, end);
      }
    }
    number = static_cast<int>(end - next);
    int* const done = now;
    now = next;
    next = done;
  }
  if (now != view.one) {
    for (int i = 0; i < number; ++i) view.one[i] = now[i];
  }
  return number;
}

void look(const WallTable& table, WallView& view) {
  for (int i = 0; i < table.blocks; ++i) {
    const WallBlock& wall = table.walls[i];
    SeenBlock& seen = view.seen[i];
    unsigned unsure = 0;
    for (int k = 0; k < block; k += lanes) {
      const Floats ax = load(wall.ax + k) - view.x, ay = load(wall.ay + k) - view.y;
      const Floats bx = load(wall.bx + k) - view.x, by = load(wall.by + k) - view.y;
      const Floats area = ax * by - ay * bx;
      const Mask turn = area < 0;
      store(choose(turn, bx, ax), seen.ax + k);
      store(choose(turn, by, ay), seen.ay + k);
      store(choose(turn, ax, bx), seen.bx + k);
      store(choose(turn, ay, by), seen.by + k);
      store(magnitude(area), seen.area + k);
      const Floats reach = max(max(magnitude(ax), magnitude(ay)), max(magnitude(bx), magnitude(by)));
      store(reach, seen.reach + k);
      unsure |= bits(magnitude(area) < reach * reach * rounding) << k;
    }
    view.unsure[i] = static_cast<std::uint16_t>(unsure);
  }
}

// Receivers relative to the radio, and what surrounds them as it sees them.
struct Directions {
  float left_x, left_y, right_x, right_y;
};

struct Shaft {
  Floats x[parts], y[parts];
  float west, east, south, north;  // of the receivers
  float low, high;                 // of the receivers and the radio
  float reach;                     // the largest coordinate
  bool narrow = false;             // all receivers lie between two directions less than a half turn apart:
  Directions all;                  // none is left of the one or right of the other;
  Directions of[halves];           // and so for each half of them
};

// From slopes about a direction; opened by far more than rounding, 1e-5 rad.
MUSTER_INLINE Directions opened(float x, float y, float left, float right) {
  const float up = left + 1e-5f * (1 + left * left), down = right - 1e-5f * (1 + right * right);
  return {x - up * y, y + up * x, x - down * y, y + down * x};
}

MUSTER_INLINE void find_directions(Shaft& shaft) {
  const float x = (shaft.west + shaft.east) / 2, y = (shaft.south + shaft.north) / 2;
  float left[halves], right[halves];
  for (int half = 0; half < halves; ++half) {
    Floats most = -huge, least = huge;
    for (int i = half * parts / halves; i < (half + 1) * parts / halves; ++i) {
      const Floats along = x * shaft.x[i] + y * shaft.y[i], across = x * shaft.y[i] - y * shaft.x[i];
      if (!stdx::all_of(along > 0)) return;
      most = max(most, across / along);
      least = min(least, across / along);
    }
    left[half] = stdx::hmax(most), right[half] = stdx::hmin(least);
    if (left[half] > 1000 || right[half] < -1000) return;
    shaft.of[half] = opened(x, y, left[half], right[half]);
  }
  shaft.narrow = true;
  shaft.all = opened(x, y, max(left[0], left[1]), min(right[0], right[1]));
}

MUSTER_INLINE Shaft shaft_to(const WallView& view, const float* x, const float* y, const float* z) {
  Shaft shaft;
  Floats west = huge, east = -huge, south = huge, north = -huge, low = view.z, high = view.z;
  for (int i = 0; i < parts; ++i) {
    shaft.x[i] = Floats(x + i * lanes, stdx::element_aligned) - view.x;
    shaft.y[i] = Floats(y + i * lanes, stdx::element_aligned) - view.y;
    west = min(west, shaft.x[i]);
    east = max(east, shaft.x[i]);
    south = min(south, shaft.y[i]);
    north = max(north, shaft.y[i]);
    low = min(low, Floats(z + i * lanes, stdx::element_aligned));
    high = max(high, Floats(z + i * lanes, stdx::element_aligned));
  }
  shaft.west = stdx::hmin(west), shaft.east = stdx::hmax(east);
  shaft.south = stdx::hmin(south), shaft.north = stdx::hmax(north);
  shaft.low = stdx::hmin(low), shaft.high = stdx::hmax(high);
  shaft.reach =
      max(max(magnitude(shaft.west), magnitude(shaft.east)), max(magnitude(shaft.south), magnitude(shaft.north)));
  find_directions(shaft);
  return shaft;
}

// Boxes that some link of the shaft may meet.
MUSTER_INLINE Mask meets(const Shaft& shaft, const Floats& west, const Floats& east, const Floats& south,
                         const Floats& north) {
  Mask result = west <= max(shaft.east, 0) && east >= min(shaft.west, 0) && south <= max(shaft.north, 0) &&
                north >= min(shaft.south, 0);
  if (!shaft.narrow) return result;
  const Floats x = (west + east) * 0.5f, y = (south + north) * 0.5f;
  const Floats half_x = (east - west) * 0.5f, half_y = (north - south) * 0.5f;
  const Directions& to = shaft.all;
  const Floats from_left = to.left_x * y - to.left_y * x, from_right = to.right_x * y - to.right_y * x;
  result = result && from_left <= magnitude(to.left_x) * half_y + magnitude(to.left_y) * half_x;
  return result && from_right >= -(magnitude(to.right_x) * half_y + magnitude(to.right_y) * half_x);
}

// Of a wall in its block: how many floats from the first wall's, in either kind of block.
constexpr int stride = static_cast<int>(sizeof(WallBlock) / sizeof(float));

// Lists the walls that links of each half may cross, as offsets, and sets their margins. Moves `end` to their ends.
void list_walls(const WallTable& table, const WallView& view, const Shaft& shaft, int blocks, int** end) {
  const float x = (shaft.west + shaft.east) * 0.5f, y = (shaft.south + shaft.north) * 0.5f;
  const float half_x = (shaft.east - shaft.west) * 0.5f, half_y = (shaft.north - shaft.south) * 0.5f;
  for (int i = 0; i < blocks; ++i) {
    const WallBlock& wall = table.walls[view.one[i]];
    SeenBlock& seen = view.seen[view.one[i]];
    for (int k = 0; k < block; k += lanes) {
      const Floats ax = load(seen.ax + k), ay = load(seen.ay + k), bx = load(seen.bx + k), by = load(seen.by + k);
      const Floats reach = load(seen.reach + k), margin = rounding * reach * max(reach, shaft.reach);
      const Floats base = load(wall.base + k);
      const Mask plain = base <= shaft.low && load(wall.plain_top + k) > shaft.high;
      store(choose(plain, -margin, -huge), seen.surely + k);
      store(margin, seen.perhaps + k);
      // Somebody is on the wall's far side, and heights meet.
      const Floats over_x = ay - by, over_y = bx - ax;
      const Floats nearest =
          x * over_x + y * over_y + load(seen.area + k) - (half_x * magnitude(over_x) + half_y * magnitude(over_y));
      const Mask kept = nearest <= 2 * margin && base <= shaft.high && load(wall.top + k) > shaft.low;
      for (int half = 0; half < halves; ++half) {
        const Directions& to = shaft.of[half];
        Mask between = kept;
        if (shaft.narrow) {
          const Floats left_a = to.left_x * ay - to.left_y * ax, left_b = to.left_x * by - to.left_y * bx;
          const Floats right_a = to.right_x * ay - to.right_y * ax, right_b = to.right_x * by - to.right_y * bx;
          between = kept && min(left_a, left_b) <= 0 && max(right_a, right_b) >= 0;
        }
        end[half] = append(bits(between), view.one[i] * stride + k, end[half]);
      }
    }
  }
}

// Adds the listed walls to the counts of one half of the receivers.
MUSTER_INLINE Doubt* count_half(const WallTable& table, const WallView& view, const Shaft& shaft, int half,
                                const int* list, const int* end, int* counts, Doubt* doubts) {
  constexpr int own = parts / halves;
  const int first = half * receivers / halves;
  Floats x[own], y[own];
  for (int i = 0; i < own; ++i) x[i] = shaft.x[half * own + i], y[i] = shaft.y[half * own + i];
  const int* const materials = table.walls->material;
  const float* const first_seen = view.seen->ax;
  for (; list != end; ++list) {
    const float* const seen = first_seen + *list;  // its columns are a block apart
    const float ax = seen[0], ay = seen[block], bx = seen[2 * block], by = seen[3 * block], area = seen[4 * block];
    const float surely = seen[6 * block], perhaps = seen[7 * block];
    int* const count = counts + materials[*list] * receivers + first;
    Mask doubtful[own], any(false);
    Integers counted[own];
    for (int i = 0; i < own; ++i) {
      const Floats from_a = x[i] * ay - y[i] * ax, from_b = y[i] * bx - x[i] * by;
      const Floats decides = max(max(from_a, from_b), from_a + from_b + area);
      counted[i] = minus_if_negative(decides);
      (Integers(count + i * lanes, stdx::vector_aligned) - counted[i]).copy_to(count + i * lanes, stdx::vector_aligned);
      doubtful[i] = decides > surely && decides < perhaps;
      any = any || doubtful[i];
    }
    if (stdx::none_of(any)) continue;
    *doubts = {*list / stride * block + *list % stride, 0};
    for (int i = 0; i < own; ++i) {
      doubts->lanes |= bits(doubtful[i]) << (first + i * lanes);
      for (int k = 0; k < lanes; ++k) count[i * lanes + k] += doubtful[i][k] ? counted[i][k] : 0;
    }
    ++doubts;
  }
  return doubts;
}

int count(const WallTable& table, const WallView& view, const float* x, const float* y, const float* z, int* counts,
          Doubt* doubts) {
  const Shaft shaft = shaft_to(view, x, y, z);
  const int blocks =
      surviving(table, view, [&](const Floats& west, const Floats& east, const Floats& south, const Floats& north) {
        return meets(shaft, west, east, south, north);
      });
  int* end[halves] = {view.other, view.third};
  list_walls(table, view, shaft, blocks, end);
  for (int i = 0; i < table.materials * receivers; i += lanes) Integers(0).copy_to(counts + i, stdx::vector_aligned);
  const Doubt* const first = doubts;
  doubts = count_half(table, view, shaft, 0, view.other, end[0], counts, doubts);
  doubts = count_half(table, view, shaft, 1, view.third, end[1], counts, doubts);
  return static_cast<int>(doubts - first);
}

// Boxes that reach over the line of the one link to (x, y), and within its own box.
struct Line {
  float x, y;
  Mask meets(const Floats& west, const Floats& east, const Floats& south, const Floats& north) const {
    const Floats middle_x = (west + east) * 0.5f, middle_y = (south + north) * 0.5f;
    const Floats half_x = (east - west) * 0.5f, half_y = (north - south) * 0.5f;
    const Floats spread = magnitude(x) * half_y + magnitude(y) * half_x;
    const Floats rounded = rounding * (magnitude(x) + magnitude(y)) * (magnitude(middle_x) + magnitude(middle_y));
    return west <= max(x, 0) && east >= min(x, 0) && south <= max(y, 0) && north >= min(y, 0) &&
           magnitude(x * middle_y - y * middle_x) <= spread + rounded;
  }
};

int count_one(const WallTable& table, const WallView& view, float to_x, float to_y, float to_z, int* counts,
              Doubt* doubts) {
  const Line line{to_x - view.x, to_y - view.y};
  const float low = min(view.z, to_z), high = max(view.z, to_z), far = max(magnitude(line.x), magnitude(line.y));
  const int blocks =
      surviving(table, view, [&](const Floats& west, const Floats& east, const Floats& south, const Floats& north) {
        return line.meets(west, east, south, north);
      });
  const Doubt* const first = doubts;
  for (int i = 0; i < blocks; ++i) {
    const WallBlock& wall = table.walls[view.one[i]];
    unsigned open = 0;
    for (int k = 0; k < block; k += lanes) {
      const Floats ax = load(wall.ax + k) - view.x, ay = load(wall.ay + k) - view.y;
      const Floats bx = load(wall.bx + k) - view.x, by = load(wall.by + k) - view.y, base = load(wall.base + k);
      const Floats area = ax * by - ay * bx, from_a = line.x * ay - line.y * ax, from_b = line.y * bx - line.x * by;
      const Floats beyond = from_a + from_b + area;
      const Floats reach = max(max(magnitude(ax), magnitude(ay)), max(magnitude(bx), magnitude(by)));
      const Floats margin = rounding * reach * max(reach, far);
      const Floats if_left = max(max(from_a, from_b), beyond), if_right = max(max(-from_a, -from_b), -beyond);
      const Mask plain = base <= low && load(wall.plain_top + k) > high && magnitude(area) >= margin;
      const Floats decides = choose(area >= margin, if_left, choose(area <= -margin, if_right, min(if_left, if_right)));
      const Mask near = decides < margin && base <= high && load(wall.top + k) > low;
      const Mask crossed = near && plain && decides <= -margin;
      for (unsigned set = bits(crossed); set != 0; set &= set - 1) ++counts[wall.material[k + __builtin_ctz(set)]];
      open |= bits(near && !crossed) << k;
    }
    if (open != 0) *doubts++ = {view.one[i] * block, open};
  }
  return static_cast<int>(doubts - first);
}

}  // namespace

extern const WallKernel MUSTER_KERNEL;
const WallKernel MUSTER_KERNEL = {MUSTER_TEXT(MUSTER_KERNEL), look, count, count_one};

}  // namespace muster::scene
