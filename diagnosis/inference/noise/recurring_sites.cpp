#include "diagnosis/inference/noise/recurring_sites.hpp"

#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "diagnosis/inference/thresholds.hpp"

namespace muster::noise {

SiteKey site_key(const Sites& sites, Index row) {
  SiteKey key{sites.group[static_cast<std::size_t>(row)]};
  for (Index axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<std::size_t>(axis);
    key[at + 1] = std::lround(sites.place(axis, row) / inference::thresholds::same_site);
    key[at + 4] = std::lround(sites.anchor(axis, row) / inference::thresholds::same_site);
  }
  return key;
}

RecurringSites::RecurringSites(const Sites& sites) : stream_(sites.stream) {
  stream_.resize(at(sites.size()), 0);
  std::map<SiteKey, Index> number;
  std::set<std::pair<Index, int>> streams;
  for (Index i = 0; i < sites.size(); ++i) {
    if (sites.is_alone(i)) {
      site_.push_back(static_cast<Index>(rows_.size()));
      rows_.push_back({i});
      continue;
    }
    ++sharing_;
    const auto [entry, is_new] = number.try_emplace(site_key(sites, i), static_cast<Index>(rows_.size()));
    if (is_new) rows_.emplace_back();
    auto& rows = rows_[at(entry->second)];
    several_streams_ = several_streams_ || (!rows.empty() && stream_[at(rows.front())] != stream_[at(i)]);
    rows.push_back(i);
    site_.push_back(entry->second);
    streams.emplace(entry->second, stream_[at(i)]);
  }
  streams_ = static_cast<Index>(streams.size());
}

double RecurringSites::share() const {
  std::size_t recurring = 0;
  for (const auto& rows : rows_) recurring += rows.size() > 1 ? rows.size() : 0;
  return static_cast<double>(recurring) / static_cast<double>(sharing_);
}

}  // namespace muster::noise
