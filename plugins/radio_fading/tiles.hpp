// Places in tiles, and links between them taken tile by tile: both ways of a pair share one evaluation.
#pragma once

#include <algorithm>
#include <cstdint>
#include <muster/plugin.hpp>
#include <vector>

#include "radio_fading/wave_kernel.hpp"

namespace muster {

struct Place {
  double x, y, z;
};

// In another unit of length.
inline std::vector<Place> places(Rows<const Pose> poses, double unit) {
  std::vector<Place> result;
  result.reserve(poses.size());
  for (const Pose& p : poses) result.push_back({p.x / unit, p.y / unit, p.z / unit});
  return result;
}

// Tiles of a field, each filled by fill(tile) from its places; what is left of the last repeats its last place.
template <class Tile, class Fill>
std::vector<Tile> tiles(const std::vector<Place>& places, const Fill& fill) {
  std::vector<Tile> result((places.size() + waves::tile - 1) / waves::tile);
  for (std::size_t i = 0; i < result.size() * waves::tile; ++i) {
    const Place& place = places[std::min(i, places.size() - 1)];
    waves::PlaceTile& at = result[i / waves::tile].at;
    at.x[i % waves::tile] = place.x, at.y[i % waves::tile] = place.y, at.z[i % waves::tile] = place.z;
  }
  for (Tile& each : result) fill(each);
  return result;
}

// The links of each sender, taken in order. Finds them where they are grouped by ascending sender.
class SendersLinks {
 public:
  static constexpr std::size_t none = ~std::size_t{0};
  struct Some {
    const Ends *begin = nullptr, *end = nullptr;
  };

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
  Some take(std::size_t sender, std::size_t tile) {
    const double from = static_cast<double>(sender), first = static_cast<double>(tile * waves::tile);
    const Ends *const start = next_[sender], *next = start;
    while (next != links_.end() && next->tx == from && next->rx >= first && next->rx < first + waves::tile) ++next;
    next_[sender] = next;
    taken_ += static_cast<std::size_t>(next - start);
    return {start, next};
  }

  bool all_taken() const { return taken_ == links_.size(); }

 private:
  const Rows<const Ends> links_;
  std::vector<const Ends*> next_;
  std::size_t taken_ = 0;
};

// What links between two tiles need: evaluate(tile, place, other tile, wanted) is called for places of the first, then
// put(link, place, other place) for each link, whichever way it runs. Where links are grouped by sender and receivers
// ascend, as radio.links lists them, each pair is evaluated once; in any other order, perhaps once for each of its
// links.
template <class Evaluate, class Put>
void by_tiles(Rows<const Ends> links, std::size_t endpoints, const Evaluate& evaluate, const Put& put) {
  constexpr std::size_t tile = waves::tile;
  SendersLinks by_sender(links, endpoints);
  const auto senders = [&](std::size_t of) { return std::min(tile, endpoints - of * tile); };
  // For each link of some: use(link, place of its receiver in the tile).
  const auto each = [&](const SendersLinks::Some& some, std::size_t of, const auto& use) {
    for (const Ends* link = some.begin; link != some.end; ++link) {
      use(static_cast<std::size_t>(link - links.begin()), static_cast<std::size_t>(link->rx) - of * tile);
    }
  };
  for (std::size_t one = 0; one * tile < endpoints; ++one) {
    for (;;) {
      std::size_t other = SendersLinks::none;
      for (std::size_t i = 0; i < senders(one); ++i) other = std::min(other, by_sender.tile(one * tile + i));
      if (other == SendersLinks::none) break;
      SendersLinks::Some there[tile], back[tile];
      unsigned wanted[tile] = {};
      for (std::size_t i = 0; i < senders(one); ++i) {
        there[i] = by_sender.take(one * tile + i, other);
        each(there[i], other, [&](std::size_t, std::size_t place) { wanted[i] |= 1u << place; });
      }
      for (std::size_t i = 0; other > one && i < senders(other); ++i) {
        back[i] = by_sender.take(other * tile + i, one);
        each(back[i], one, [&](std::size_t, std::size_t place) { wanted[place] |= 1u << i; });
      }
      for (std::size_t i = 0; i < tile; ++i) {
        if (wanted[i] != 0) evaluate(one, static_cast<int>(i), other, wanted[i]);
      }
      for (std::size_t i = 0; i < tile; ++i) {
        each(there[i], other, [&](std::size_t link, std::size_t place) { put(link, i, place); });
        each(back[i], one, [&](std::size_t link, std::size_t place) { put(link, place, i); });
      }
    }
  }
  if (by_sender.all_taken()) return;
  for (std::size_t link = 0; link < links.size(); ++link) {
    const auto from = static_cast<std::size_t>(links[link].tx), to = static_cast<std::size_t>(links[link].rx);
    evaluate(from / tile, static_cast<int>(from % tile), to / tile, 1u << to % tile);
    put(link, from % tile, to % tile);
  }
}

}  // namespace muster
