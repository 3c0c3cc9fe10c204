// Finds the link on which one radio hears another.
#pragma once

#include <algorithm>
#include <cstdint>
#include <muster/plugin.hpp>
#include <utility>
#include <vector>

namespace muster {

class LinkIndex {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  LinkIndex(Rows<const Ends> links, Rows<const Endpoint> endpoints) {
    entries_.reserve(links.size());
    const Endpoint* const at = endpoints.begin();  // ends are checked row numbers
    const auto radio = [&](double end) { return static_cast<std::size_t>(at[static_cast<std::size_t>(end)].radio); };
    for (const Ends& link : links) entries_.emplace_back(key(radio(link.tx), radio(link.rx)), entries_.size());
    // Links of living radios are listed in order already.
    if (!std::is_sorted(entries_.begin(), entries_.end())) std::sort(entries_.begin(), entries_.end());
  }

  // The link from the first radio to the second, or none. If several readings name the pair, the last.
  std::size_t find(std::size_t from, std::size_t to) const {
    const std::pair<std::uint64_t, std::size_t> last{key(from, to), none};
    const auto after = std::upper_bound(entries_.begin(), entries_.end(), last);
    return after != entries_.begin() && (after - 1)->first == last.first ? (after - 1)->second : none;
  }

 private:
  static std::uint64_t key(std::size_t from, std::size_t to) { return std::uint64_t{from} << 32 | to; }

  std::vector<std::pair<std::uint64_t, std::size_t>> entries_;
};

}  // namespace muster
