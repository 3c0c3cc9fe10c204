// Sites with several rows: one anchor, and one place within 2 cm. Rows of a site may share a part of their errors that
// no other row has. So may those of one stream there: a direction, an instrument.
#pragma once

#include <array>

#include "diagnosis/inference/noise/rows.hpp"

namespace muster::noise {

// The same for rows of one group, place and anchor.
using SiteKey = std::array<long, 7>;
SiteKey site_key(const Sites& sites, Index row);

enum class Relation { apart = 0, site, stream };

class RecurringSites {
 public:
  explicit RecurringSites(const Sites& sites);

  Relation of(Index a, Index b) const {
    if (site_[at(a)] != site_[at(b)]) return Relation::apart;
    return stream_[at(a)] == stream_[at(b)] ? Relation::stream : Relation::site;
  }
  // Rows of the same site, itself among them, in their order.
  const std::vector<Index>& rows_with(Index row) const { return rows_[at(site_[at(row)])]; }
  const std::vector<std::vector<Index>>& sites() const { return rows_; }  // the rows of each, in their order
  // Share of rows whose site has others, of those that share a field.
  double share() const;
  Index streams() const { return streams_; }  // of rows that share a field, each counted at each of its sites
  bool several_streams() const { return several_streams_; }  // at some site

 private:
  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }

  std::vector<Index> site_;
  std::vector<int> stream_;
  std::vector<std::vector<Index>> rows_;  // of each site
  std::size_t sharing_ = 0;
  Index streams_ = 0;
  bool several_streams_ = false;
};

}  // namespace muster::noise
