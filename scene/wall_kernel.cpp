// Built once for each instruction set, as MUSTER_KERNEL. Everything here but the kernel itself is internal.
//
// Seen from a radio p = 0 left of a wall a -> b, the link to q crosses the wall exactly if q is in the wall's shadow: q
// x a < 0, b x q < 0 and q x a + b x q + a x b < 0, the last being q's own side of the wall. So the largest of the
// three decides, if it is farther from zero than its rounding error. With coordinates of q below R and of a and b below
// A, exact in a float, the third is off by at most (16 R A + 6 A^2) 2^-24, the others by less: a margin of 32 A max(A,
// R) 2^-24 is safe, fused or not.
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
constexpr int lanes = static_cast<int>(Floats::size());
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
MUSTER_INLINE float magnitude(float a) { return __builtin_fabsf(a); }

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

// Lists the blocks of walls whose boxes, and all boxes around them, pass a test. The result is in view.lists[0].
template <class Test>
MUSTER_INLINE int surviving(const WallTable& table, const WallView& view, const Test test) {
  const Floats x = view.x, y = view.y;
  int *now = view.lists[0], *next = view.lists[1];
  int number = 1;
  now[0] = 0;
  for (int level = table.levels - 1; level >= 0; --level) {
    int* end = next;
    for (int i = 0; i < number; ++i) {
      const BoxBlock& box = table.boxes[level][now[i]];
      for (int k = 0; k < block; k += lanes) {
        end = append(bits(test(load(box.west + k) - x, load(box.east + k) - x, load(box.south + k) - y,
                               load(box.north + k) - y)),
                     now[i] * block + k, end);
      }
    }
    number = static_cast<int>(end - next);
    int* const done = now;
    now = next;
    next = done;
  }
  if (now != view.lists[0]) {
    for (int i = 0; i < number; ++i) view.lists[0][i] = now[i];
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

// Two directions that enclose the receivers [first, last), opened by far more than rounding, 1e-5 rad.
MUSTER_INLINE Directions directions(const Shaft& shaft, int first, int last) {
  const float x = (shaft.west + shaft.east) / 2, y = (shaft.south + shaft.north) / 2;
  Floats most = -huge, least = huge, nearest = huge;
  for (int i = first; i < last; i += lanes) {
    const Floats to_x = load(shaft.x + i), to_y = load(shaft.y + i);
    const Floats along = x * to_x + y * to_y, slope = (x * to_y - y * to_x) / along;
    nearest = min(nearest, along);
    most = max(most, slope);
    least = min(least, slope);
  }
  float left = stdx::hmax(most), right = stdx::hmin(least);
  if (!(stdx::all_of(nearest > 0) && left < 1000 && right > -1000)) return {0, 0, 0, 0};
  left += 1e-5f * (1 + left * left), right -= 1e-5f * (1 + right * right);
  return {x - left * y, y + left * x, x - right * y, y + right * x};
}

void aim(const WallView& view, const float* x, const float* y, const float* z, Shaft& shaft) {
  Floats west = huge, east = -huge, south = huge, north = -huge, low = view.z, high = view.z;
  for (int i = 0; i < receivers; i += lanes) {
    const Floats to_x = Floats(x + i, stdx::element_aligned) - view.x;
    const Floats to_y = Floats(y + i, stdx::element_aligned) - view.y;
    const Floats to_z(z + i, stdx::element_aligned);
    store(to_x, shaft.x + i);
    store(to_y, shaft.y + i);
    west = min(west, to_x), east = max(east, to_x);
    south = min(south, to_y), north = max(north, to_y);
    low = min(low, to_z), high = max(high, to_z);
  }
  shaft.west = stdx::hmin(west), shaft.east = stdx::hmax(east);
  shaft.south = stdx::hmin(south), shaft.north = stdx::hmax(north);
  shaft.low = stdx::hmin(low), shaft.high = stdx::hmax(high);
  shaft.reach =
      max(max(magnitude(shaft.west), magnitude(shaft.east)), max(magnitude(shaft.south), magnitude(shaft.north)));
  shaft.all = directions(shaft, 0, receivers);
}

// Test for boxes that some link of a shaft may meet.
struct BoxesInShaft {
  Floats west, east, south, north, left_x, left_y, right_x, right_y;

  MUSTER_INLINE explicit BoxesInShaft(const Shaft& shaft)
      : west(min(shaft.west, 0)),
        east(max(shaft.east, 0)),
        south(min(shaft.south, 0)),
        north(max(shaft.north, 0)),
        left_x(shaft.all.left_x),
        left_y(shaft.all.left_y),
        right_x(shaft.all.right_x),
        right_y(shaft.all.right_y) {}

  MUSTER_INLINE Mask operator()(const Floats& from_x, const Floats& to_x, const Floats& from_y,
                                const Floats& to_y) const {
    const Floats x = (from_x + to_x) * 0.5f, y = (from_y + to_y) * 0.5f;
    const Floats half_x = (to_x - from_x) * 0.5f, half_y = (to_y - from_y) * 0.5f;
    const Floats from_left = left_x * y - left_y * x, from_right = right_x * y - right_y * x;
    return from_x <= east && to_x >= west && from_y <= north && to_y >= south &&
           from_left <= magnitude(left_x) * half_y + magnitude(left_y) * half_x &&
           from_right >= -(magnitude(right_x) * half_y + magnitude(right_y) * half_x);
  }
};

// Offset between consecutive blocks, in floats, in either kind of block.
constexpr int stride = static_cast<int>(sizeof(WallBlock) / sizeof(float));

// Test for walls that are at least in part between two directions.
struct Between {
  Floats left_x, left_y, right_x, right_y;

  MUSTER_INLINE explicit Between(const Directions& to)
      : left_x(to.left_x), left_y(to.left_y), right_x(to.right_x), right_y(to.right_y) {}

  MUSTER_INLINE Mask operator()(const Floats& ax, const Floats& ay, const Floats& bx, const Floats& by) const {
    const Floats left_a = left_x * ay - left_y * ax, left_b = left_x * by - left_y * bx;
    const Floats right_a = right_x * ay - right_y * ax, right_b = right_x * by - right_y * bx;
    return min(left_a, left_b) <= 0 && max(right_a, right_b) >= 0;
  }
};

// The walls that links of a shaft may cross, as offsets.
template <int parts>
struct Listed {
  int* end[parts];  // of view.lists[1] and the following: walls that links of each part may cross
  int* open_end;    // of view.lists[3]: walls whose doors or heights may decide
};

template <int parts>
MUSTER_INLINE Listed<parts> list_walls(const WallTable& table, const WallView& view, const Shaft& shaft,
                                       const Between (&between)[parts]) {
  const int blocks = surviving(table, view, BoxesInShaft(shaft));
  const Floats x = (shaft.west + shaft.east) * 0.5f, y = (shaft.south + shaft.north) * 0.5f;
  const Floats half_x = (shaft.east - shaft.west) * 0.5f, half_y = (shaft.north - shaft.south) * 0.5f;
  const Floats low = shaft.low, high = shaft.high, far = shaft.reach;
  Listed<parts> listed;
  for (int part = 0; part < parts; ++part) listed.end[part] = view.lists[1 + part];
  listed.open_end = view.lists[3];
  for (int i = 0; i < blocks; ++i) {
    const int number = view.lists[0][i];
    const WallBlock& wall = table.walls[number];
    SeenBlock& seen = view.seen[number];
    for (int k = 0; k < block; k += lanes) {
      const Floats ax = load(seen.ax + k), ay = load(seen.ay + k), bx = load(seen.bx + k), by = load(seen.by + k);
      const Floats reach = load(seen.reach + k), margin = rounding * reach * max(reach, far);
      store(margin, seen.margin + k);
      const Floats base = load(wall.base + k);
      // A receiver is on the wall's far side, and heights overlap.
      const Floats over_x = ay - by, over_y = bx - ax;
      const Floats nearest =
          x * over_x + y * over_y + load(seen.area + k) - (half_x * magnitude(over_x) + half_y * magnitude(over_y));
      const Mask met = nearest <= 2 * margin && base <= high && load(wall.top + k) > low;
      const Mask plain = base <= low && load(wall.plain_top + k) > high;
      const int first = number * stride + k;
      Mask kept(false);
      for (int part = 0; part < parts; ++part) {
        const Mask crossed = met && between[part](ax, ay, bx, by);
        listed.end[part] = append(bits(crossed && plain), first, listed.end[part]);
        kept = kept || crossed;
      }
      const unsigned open = bits(kept && !plain);
      if (open != 0) listed.open_end = append(open, first, listed.open_end);
    }
  }
  return listed;
}

MUSTER_INLINE void add(const Integers& number, int* to) {
  (Integers(to, stdx::vector_aligned) + number).copy_to(to, stdx::vector_aligned);
}

// One wall, relative to a radio.
struct Wall {
  Floats ax, ay, bx, by, area, margin;

  MUSTER_INLINE explicit Wall(const float* seen)  // its columns are a block apart
      : ax(seen[0]),
        ay(seen[block]),
        bx(seen[2 * block]),
        by(seen[3 * block]),
        area(seen[4 * block]),
        margin(seen[6 * block]) {}
  // Below zero where the link to a receiver crosses the wall.
  MUSTER_INLINE Floats decides(const Floats& x, const Floats& y) const {
    const Floats from_a = x * ay - y * ax, from_b = y * bx - x * by;
    return max(max(from_a, from_b), from_a + from_b + area);
  }
};

// Counts a wall for the receivers [first, last). Returns the lanes within the rounding margin, which are not counted.
template <int first, int last>
MUSTER_INLINE unsigned count_wall(const Wall& wall, const Shaft& shaft, int* counts) {
  constexpr int number = (last - first) / lanes;
  Floats decides[number], nearest = huge;
  for (int i = 0; i < number; ++i) {
    const int from = first + i * lanes;
    decides[i] = wall.decides(load(shaft.x + from), load(shaft.y + from));
    add(-minus_if_negative(decides[i]), counts + from);
    nearest = min(magnitude(decides[i]), nearest);
  }
  if (__builtin_expect(stdx::none_of(nearest < wall.margin), true)) return 0;
  unsigned doubtful = 0;
  for (int i = 0; i < number; ++i) {
    const Mask near = magnitude(decides[i]) < wall.margin;
    add(minus_if_negative(choose(near, decides[i], 0)), counts + first + i * lanes);
    doubtful |= bits(near) << (first + i * lanes);
  }
  return doubtful;
}

// Lanes for which the wall may be crossed.
MUSTER_INLINE unsigned may_cross(const Wall& wall, const Shaft& shaft) {
  unsigned result = 0;
  for (int i = 0; i < receivers; i += lanes) {
    result |= bits(wall.decides(load(shaft.x + i), load(shaft.y + i)) < wall.margin) << i;
  }
  return result;
}

// Accumulates the walls of a shaft into counts and doubts.
struct Counting {
  const WallTable& table;
  const WallView& view;
  const Shaft& shaft;
  int* counts;
  Doubt* doubts;

  MUSTER_INLINE Wall wall(int offset) const { return Wall(view.seen->ax + offset); }
  MUSTER_INLINE void doubt(int offset, unsigned for_whom) {
    *doubts = {offset / stride * block + offset % stride, for_whom};
    ++doubts;
  }
  template <int first, int last>
  MUSTER_INLINE void add_walls(const int* offset, const int* end) {
    for (; offset != end; ++offset) {
      int* const of_material = counts + table.walls->material[*offset] * receivers;
      const unsigned doubtful = count_wall<first, last>(wall(*offset), shaft, of_material);
      if (doubtful != 0) doubt(*offset, doubtful);
    }
  }
  MUSTER_INLINE void doubt_walls(const int* offset, const int* end) {
    for (; offset != end; ++offset) {
      if (const unsigned for_whom = may_cross(wall(*offset), shaft); for_whom != 0) doubt(*offset, for_whom);
    }
  }
};

int count(const WallTable& table, const WallView& view, const Shaft& shaft, int* counts, Doubt* doubts) {
  for (int i = 0; i < table.materials * receivers; i += lanes) Integers(0).copy_to(counts + i, stdx::vector_aligned);
  Counting counting{table, view, shaft, counts, doubts};
  if (table.blocks <= widest_scene) {
    const auto listed = list_walls<1>(table, view, shaft, {Between(shaft.all)});
    counting.add_walls<0, receivers>(view.lists[1], listed.end[0]);
    counting.doubt_walls(view.lists[3], listed.open_end);
  } else {
    constexpr int half = receivers / 2;
    const Between one(directions(shaft, 0, half)), other(directions(shaft, half, receivers));
    const auto listed = list_walls<2>(table, view, shaft, {one, other});
    counting.add_walls<0, half>(view.lists[1], listed.end[0]);
    counting.add_walls<half, receivers>(view.lists[2], listed.end[1]);
    counting.doubt_walls(view.lists[3], listed.open_end);
  }
  return static_cast<int>(counting.doubts - doubts);
}

// Test for boxes that meet the line to (x, y) and its bounding box.
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
      surviving(table, view, [=](const Floats& west, const Floats& east, const Floats& south, const Floats& north) {
        return line.meets(west, east, south, north);
      });
  const Doubt* const first = doubts;
  for (int i = 0; i < blocks; ++i) {
    const WallBlock& wall = table.walls[view.lists[0][i]];
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
    if (open != 0) *doubts++ = {view.lists[0][i] * block, open};
  }
  return static_cast<int>(doubts - first);
}

}  // namespace

extern const WallKernel MUSTER_KERNEL;
const WallKernel MUSTER_KERNEL = {MUSTER_TEXT(MUSTER_KERNEL), look, aim, count, count_one};

}  // namespace muster::scene
