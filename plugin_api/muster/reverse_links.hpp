// Pairs of links that run both ways between the same endpoints, so that a reciprocal term is evaluated once a pair.
#pragma once

#include <cstdint>
#include <muster/plugin.hpp>
#include <vector>

namespace muster {

constexpr std::uint32_t no_link = 0xffffffffu;

// For each link, an earlier one that runs the other way, or no_link. Finds all of them where links are grouped by
// sender and receivers ascend, as radio.links lists them; in any other order some may be missed, and none is wrong.
inline std::vector<std::uint32_t> earlier_reverse(Rows<const Ends> links, std::size_t endpoints) {
  std::vector<std::uint32_t> result(links.size(), no_link);
  std::vector<std::uint32_t> next(endpoints, no_link);  // of each sender, the first link whose reverse may still come
  for (std::uint32_t i = 0; i < links.size(); ++i) {
    const auto [from, to] = links[i];
    auto& own = next[static_cast<std::size_t>(from)];
    if (own == no_link) own = i;
    auto& at = next[static_cast<std::size_t>(to)];
    if (at == no_link) continue;
    while (at < i && links[at].tx == to && links[at].rx < from) ++at;
    if (at < i && links[at].tx == to && links[at].rx == from) result[i] = at;
  }
  return result;
}

// True where all links run from `tx` to consecutive receivers from `rx` on. Branch-free, since it holds for most
// senders of a fully connected network.
inline bool run_on(const Ends* links, std::size_t number, double tx, double rx) {
  using Two = double __attribute__((vector_size(2 * sizeof(double)), aligned(alignof(double)), may_alias));
  using Bits = std::int64_t __attribute__((vector_size(2 * sizeof(double))));
  static_assert(sizeof(Two) == sizeof(Ends));
  const auto* const ends = reinterpret_cast<const Two*>(links);
  Two expected = {tx, rx};
  Bits other = {};
  std::size_t i = 0;
  for (; i + 4 <= number; i += 4, expected += Two{0, 4}) {  // one addition on the critical path of four comparisons
    other |= (ends[i] != expected) | (ends[i + 1] != expected + Two{0, 1});
    other |= (ends[i + 2] != expected + Two{0, 2}) | (ends[i + 3] != expected + Two{0, 3});
  }
  for (; i < number; ++i, expected += Two{0, 1}) other |= ends[i] != expected;
  return (other[0] | other[1]) == 0;
}

}  // namespace muster
