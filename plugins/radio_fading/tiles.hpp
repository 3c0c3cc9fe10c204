// Places in tiles, and links between them taken tile by tile: both ways of a pair share one evaluation.
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

// In another unit of length.
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

// Tiles of a field, each filled by fill(tile) from its places; what is left of the last repeats its last place.
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

// Links of one sender to one tile, by their numbers.
struct LinksToTile {
  const Ends* ends = nullptr;
  std::size_t first = 0, number = 0;
  double first_place = 0;
  bool whole = false;  // to every place in turn

  // use(link, place in the tile)
  template <class Use>
  void each(const Use& use) const {
    for (std::size_t i = 0; whole && i < waves::tile; ++i) use(first + i, i);
    for (std::size_t i = 0; !whole && i < number; ++i) {
      use(first + i, static_cast<std::size_t>(ends[i].rx - first_place));
    }
  }
  // A bit for each place.
  unsigned places() const {
    unsigned result = whole ? (1u << waves::tile) - 1 : 0;
    for (std::size_t i = 0; !whole && i < number; ++i) {
      result |= 1u << static_cast<std::size_t>(ends[i].rx - first_place);
    }
    return result;
  }
  // Where there are many links, their values lie far apart: they are fetched while they are worked out.
  void prefetch(double* column) const {
    for (std::size_t i = 0; column != nullptr && i < number + 7; i += 8) __builtin_prefetch(column + first + i, 1);
  }
};

// The links of each sender, taken in order. Finds them where they are grouped by ascending sender.
class SendersLinks {
 public:
  static constexpr std::size_t none = ~std::size_t{0};

  SendersLinks(Rows<const Ends> links, std::size_t endpoints) : links_(links), next_(endpoints) {
    const Ends* first = links.begin();
    for (std::size_t sender = 0; sender < endpoints; ++sender) {
      next_[sender] = first;
      for (std::ptrdiff_t step = 1; step > 0;) {  // most senders have few links, or as many as the last
        const bool within = step <= links.end() - first && first[step - 1].tx <= static_cast<double>(sender);
        if (within) first += step;
        step = within ? 2 * step : step / 2;
      }
    }
  }

  // The tile that the sender's next link goes to, if it has one.
  std::size_t tile(std::size_t sender) const {
    const Ends* const next = next_[sender];
    return next != links_.end() && next->tx == static_cast<double>(sender)
               ? static_cast<std::size_t>(next->rx) / waves::tile
               : none;
  }

  // Takes the sender's links as long as they go to this tile.
  LinksToTile take(std::size_t sender, std::size_t tile) {
    const double from = static_cast<double>(sender), first = static_cast<double>(tile * waves::tile);
    const Ends *const start = next_[sender], *next = start;
    const bool whole = links_.end() - start >= waves::tile && run_on(start, waves::tile, from, first);
    if (whole) next += waves::tile;
    while (next != links_.end() && next->tx == from && next->rx >= first && next->rx < first + waves::tile) ++next;
    const auto number = static_cast<std::size_t>(next - start);
    next_[sender] = next;
    taken_ += number;
    return {start, static_cast<std::size_t>(start - links_.begin()), number, first, whole && number == waves::tile};
  }

  bool all_taken() const { return taken_ == links_.size(); }

 private:
  const Rows<const Ends> links_;
  std::vector<const Ends*> next_;
  std::size_t taken_ = 0;
};

// Fills columns of one value a link, those that are not null: evaluate(tile, place, other tile, wanted, values) gives
// each column's values[column][0 .. tile), from a place of the one tile to the wanted ones of the other. Where links
// are grouped by sender and receivers ascend, as radio.links lists them, each pair is evaluated once; in any other
// order, perhaps once for each of its links.
template <std::size_t columns, class Evaluate>
void by_tiles(Rows<const Ends> links, std::size_t endpoints, const std::array<double*, columns>& out,
              const Evaluate& evaluate) {
  constexpr std::size_t tile = waves::tile;
  double values[tile][columns][tile];
  SendersLinks by_sender(links, endpoints);
  const auto senders = [&](std::size_t of) { return std::min(tile, endpoints - of * tile); };
  for (std::size_t one = 0; one * tile < endpoints; ++one) {
    for (;;) {
      std::size_t other = SendersLinks::none;
      for (std::size_t i = 0; i < senders(one); ++i) other = std::min(other, by_sender.tile(one * tile + i));
      if (other == SendersLinks::none) break;
      LinksToTile there[tile], back[tile];
      unsigned wanted[tile] = {};
      for (std::size_t i = 0; i < senders(one); ++i) {
        there[i] = by_sender.take(one * tile + i, other);
        wanted[i] = there[i].places();
        for (double* column : out) there[i].prefetch(column);
      }
      for (std::size_t i = 0; other > one && i < senders(other); ++i) {
        back[i] = by_sender.take(other * tile + i, one);
        const unsigned places = back[i].places();
        for (std::size_t place = 0; place < tile; ++place) wanted[place] |= (places >> place & 1) << i;
        for (double* column : out) back[i].prefetch(column);
      }
      for (std::size_t i = 0; i < tile; ++i) {
        if (wanted[i] != 0) evaluate(one, static_cast<int>(i), other, wanted[i], values[i]);
      }
      for (std::size_t c = 0; c < columns; ++c) {
        for (std::size_t i = 0; out[c] != nullptr && i < tile; ++i) {
          there[i].each([&](std::size_t link, std::size_t place) { out[c][link] = values[i][c][place]; });
          back[i].each([&](std::size_t link, std::size_t place) { out[c][link] = values[place][c][i]; });
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
