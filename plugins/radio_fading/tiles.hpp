// Places in tiles, and links processed tile by tile: both directions of a pair share one evaluation.
#pragma once

#include <algorithm>
#include <array>
#include <muster/plugin.hpp>
#include <muster/reverse_links.hpp>
#include <vector>

#include "radio_fading/wave_kernel.hpp"

namespace muster {

struct FieldPoint {
  double x, y, z;
};

// Converts places to another unit of length.
inline std::vector<FieldPoint> places(Rows<const Pose> poses, double unit) {
  std::vector<FieldPoint> result;
  result.reserve(poses.size());
  for (const Pose& p : poses) result.push_back({p.x / unit, p.y / unit, p.z / unit});
  return result;
}

// A column of one double a link.
template <class Row>
double* column_of(Rows<Row> rows) {
  static_assert(sizeof(Row) == sizeof(double));
  return reinterpret_cast<double*>(rows.begin());
}

// Tiles of a field, each filled by fill(tile) from its places; the last is padded with its last place.
template <class Tile, class Fill>
std::vector<Tile> tiles(const std::vector<FieldPoint>& places, const Fill& fill) {
  std::vector<Tile> result((places.size() + waves::tile - 1) / waves::tile);
  for (std::size_t i = 0; i < result.size() * waves::tile; ++i) {
    const FieldPoint& place = places[std::min(i, places.size() - 1)];
    waves::PlaceTile& at = result[i / waves::tile].at;
    at.x[i % waves::tile] = place.x, at.y[i % waves::tile] = place.y, at.z[i % waves::tile] = place.z;
  }
  for (Tile& each : result) fill(each);
  return result;
}

// Links of one sender to one tile: their numbers are consecutive, and their places ascend.
struct LinksToTile {
  static constexpr unsigned everywhere = (1u << waves::tile) - 1;

  std::size_t first = 0, number = 0;
  unsigned places = 0;  // a bit for each

  // use(link, place in the tile)
  template <class Use>
  void each(const Use& use) const {
    if (places == everywhere) {
      for (std::size_t i = 0; i < waves::tile; ++i) use(first + i, i);
    } else {
      std::size_t link = first;
      for (unsigned left = places; left != 0; left &= left - 1) use(link++, __builtin_ctz(left));
    }
  }
  // With many links, their values are far apart in memory: prefetched during the computation.
  void prefetch(double* column) const {
    for (std::size_t i = 0; column != nullptr && i < number + 7; i += 8) __builtin_prefetch(column + first + i, 1);
  }
};

// Links of all places of one tile to another tile.
struct LinksBetweenTiles {
  LinksToTile from[waves::tile];
  unsigned senders = 0, receivers = 0;  // a bit for each

  // For each sender, the places linked with it: by its own links, or by those of `back`.
  std::array<unsigned, waves::tile> pairs(const LinksBetweenTiles& back) const {
    std::array<unsigned, waves::tile> result;
    unsigned to_everywhere = 0;
    for (unsigned i = 0; i < waves::tile; ++i) {
      to_everywhere |= unsigned{back.from[i].places == LinksToTile::everywhere} << i;
    }
    for (std::size_t i = 0; i < waves::tile; ++i) result[i] = from[i].places | to_everywhere;
    for (unsigned left = back.senders & ~to_everywhere; left != 0; left &= left - 1) {
      const int other = __builtin_ctz(left);
      back.from[other].each([&](std::size_t, std::size_t i) { result[i] |= 1u << other; });
    }
    return result;
  }
};

// The links of each sender, taken in order. Requires links grouped by ascending sender; in other orders it finds fewer.
class SendersLinks {
 public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  SendersLinks(Rows<const Ends> links, std::size_t endpoints)
      : links_(links), of_(endpoints), next_tile_(endpoints + waves::tile, none) {
    const Ends* at = links.begin();
    for (std::size_t sender = 0; sender < endpoints; ++sender) {
      of_[sender].next = runs_.size();
      while (at != links.end() && at->tx == static_cast<double>(sender)) {
        const std::size_t number = follow_one_another(at, links.end());
        runs_.push_back({static_cast<std::size_t>(at - links.begin()), static_cast<std::size_t>(at->rx), number});
        at += number;
      }
      of_[sender].end = runs_.size();
    }
    for (std::size_t sender = 0; sender < endpoints; ++sender) look_ahead(sender);
  }

  // The least tile of the next links of a tile's places, or none.
  std::uint32_t next(std::size_t tile) const {
    const std::uint32_t* const of_tile = next_tile_.data() + tile * waves::tile;
    return *std::min_element(of_tile, of_tile + waves::tile);
  }

  // Takes the next links of a tile's places, as far as they go to the other one.
  LinksBetweenTiles take(std::size_t tile, std::size_t other) {
    LinksBetweenTiles result;
    for (std::size_t i = tile * waves::tile; i < std::min(of_.size(), (tile + 1) * waves::tile); ++i) {
      if (next_tile_[i] != other) continue;
      const LinksToTile taken = take_from(of_[i], other);
      look_ahead(i);
      result.from[i % waves::tile] = taken;
      result.senders |= unsigned{taken.number != 0} << i % waves::tile;
      result.receivers |= taken.places;
      taken_ += taken.number;
    }
    return result;
  }

  bool all_taken() const { return taken_ == links_.size(); }

 private:
  // Links of one sender to consecutive receivers.
  struct Run {
    std::size_t first, to, number;
  };
  struct Runs {
    std::size_t next, end;
  };

  static std::size_t follow_one_another(const Ends* first, const Ends* end) {
    constexpr std::size_t some = waves::tile;
    const double tx = first->tx, rx = first->rx;
    std::size_t number = 1;
    const auto left = [&] { return static_cast<std::size_t>(end - first) - number; };
    const auto goes_on = [&](std::size_t by) {
      return left() >= by && run_on(first + number, by, tx, rx + static_cast<double>(number));
    };
    while (goes_on(some)) number += some;
    while (goes_on(1)) ++number;
    return number;
  }

  void look_ahead(std::size_t sender) {
    const auto [next, end] = of_[sender];
    next_tile_[sender] = next == end ? none : static_cast<std::uint32_t>(runs_[next].to / waves::tile);
  }

  LinksToTile take_from(Runs& of, std::size_t tile) {
    LinksToTile result;
    for (; of.next != of.end; ++of.next) {
      Run& run = runs_[of.next];
      const std::size_t place = run.to % waves::tile, number = std::min(run.number, waves::tile - place);
      if (run.to / waves::tile != tile || result.places >> place != 0) break;
      if (result.number == 0) result.first = run.first;
      result.number += number;
      result.places |= ((1u << number) - 1) << place;
      if (number == run.number) continue;
      run.first += number, run.to += number, run.number -= number;
      break;
    }
    return result;
  }

  const Rows<const Ends> links_;
  std::vector<Run> runs_;
  std::vector<Runs> of_;                  // each sender
  std::vector<std::uint32_t> next_tile_;  // of each sender's next links; padded by none to whole tiles
  std::size_t taken_ = 0;
};

// Fills columns of one value a link, those that are not null: evaluate(tile, place, other tile, wanted, values) gives
// each column's values[column][0 .. tile), from a place of the one tile to the wanted ones of the other. Where links
// are grouped by sender and receivers ascend, as radio.links lists them, each pair is evaluated once; in any other
// order, at most once for each of its links.
template <std::size_t columns, class Evaluate>
void by_tiles(Rows<const Ends> links, std::size_t endpoints, const std::array<double*, columns>& out,
              const Evaluate& evaluate) {
  constexpr std::size_t tile = waves::tile;
  double values[tile][columns][tile];
  SendersLinks by_sender(links, endpoints);
  for (std::size_t one = 0; one * tile < endpoints; ++one) {
    for (std::uint32_t other; (other = by_sender.next(one)) != SendersLinks::none;) {
      const LinksBetweenTiles there = by_sender.take(one, other);
      const LinksBetweenTiles back = other > one ? by_sender.take(other, one) : LinksBetweenTiles{};
      for (double* column : out) {
        for (std::size_t i = 0; i < tile; ++i) there.from[i].prefetch(column), back.from[i].prefetch(column);
      }
      // A place to a whole tile is one evaluation, so the tile with fewer places goes first.
      const bool turned =
          __builtin_popcount(back.senders | there.receivers) < __builtin_popcount(there.senders | back.receivers);
      const LinksBetweenTiles &along = turned ? back : there, &across = turned ? there : back;
      const auto wanted = along.pairs(across);
      for (std::size_t i = 0; i < tile; ++i) {
        if (wanted[i] == 0) continue;
        evaluate(turned ? other : one, static_cast<int>(i), turned ? one : other, wanted[i], values[i]);
      }
      for (std::size_t c = 0; c < columns; ++c) {
        for (std::size_t i = 0; out[c] != nullptr && i < tile; ++i) {
          along.from[i].each([&](std::size_t link, std::size_t place) { out[c][link] = values[i][c][place]; });
          across.from[i].each([&](std::size_t link, std::size_t place) { out[c][link] = values[place][c][i]; });
        }
      }
    }
  }
  for (std::size_t i = 0; !by_sender.all_taken() && i < links.size(); ++i) {
    const auto from = static_cast<std::size_t>(links[i].tx), to = static_cast<std::size_t>(links[i].rx);
    evaluate(from / tile, static_cast<int>(from % tile), to / tile, 1u << to % tile, values[0]);
    for (std::size_t c = 0; c < columns; ++c) {
      if (out[c] != nullptr) out[c][i] = values[0][c][to % tile];
    }
  }
}

}  // namespace muster
