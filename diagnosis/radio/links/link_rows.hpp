// Readings of radio links as rows of a search, and the sites of those rows.
#pragma once

#include "diagnosis/inference/state/layout.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {

struct LinkReadings {
  std::vector<double> t;          // s; empty: readings of a link stand in the order of their time
  std::vector<int> tx, rx;        // radios, by numbers that do not depend on the order of the readings
  Eigen::Matrix3Xd tx_at, rx_at;  // m
  std::vector<double> rx_yaw;     // rad; empty: unknown
  std::vector<double> tx_yaw;     // the same of the transmitter
  std::vector<double> level;      // dB that a model expects; empty: unknown

  noise::Index size() const { return static_cast<noise::Index>(tx.size()); }
};

// A row ends where the next reading lies so far from its first one.
struct LinkRowLimits {
  double time = thresholds::row_time;    // s
  double turn = thresholds::row_turn;    // rad
  double way = thresholds::row_way;      // m, of either end
  double level = thresholds::row_level;  // dB: what a wall does to a link is not averaged with what it is without
};

// Readings by link, then time, in rows that end at these limits.
noise::Rows link_rows(const LinkReadings& readings, const LinkRowLimits& limits = {});
// Place: the end that moves more. Anchor: the other one, the same for both directions of a pair.
noise::Sites link_sites(const noise::Rows& rows, const LinkReadings& readings);
// The reading in the middle of each row.
LinkReadings middles(const noise::Rows& rows, const LinkReadings& readings);

// What suits a search. A wall that no map has shows best in short rows, down to single readings, while each row costs
// time: they are as short as 4,000 rows allow. Of many readings they are longer than usual, up to four times where
// there would be more than 10,000, and not for time's sake alone: each row is conditioned on so many near ones, and
// where these lie dense nothing of them tells how far the field reaches.
LinkRowLimits limits_for(const LinkReadings& readings);

// The radio of each row that moves less; where that is one and the same for all rows, the other one. Numbered from 0.
std::vector<int> radios_of(const noise::Rows& rows, const noise::Sites& sites, const LinkReadings& readings);

// What the engine asks of links.
class LinkLayout : public inference::Layout {
 public:
  // `run`: of each reading, from 0; empty where the data name none. `places_known`: false where the data have distances
  // alone, and places stand for them.
  LinkLayout(LinkReadings readings, const LinkRowLimits& limits, std::vector<int> run = {}, bool places_known = true)
      : readings_(std::move(readings)), limits_(limits), run_(std::move(run)), places_known_(places_known) {}

  noise::Index size() const override { return readings_.size(); }
  noise::Rows rows() const override { return link_rows(readings_, limits_); }
  noise::Rows long_rows() const override;
  noise::Sites sites(const noise::Rows& rows) const override { return link_sites(rows, readings_); }
  std::vector<inference::Grouping> groupings(const noise::Rows& rows, const noise::Sites& sites) const override;
  bool sites_known() const override { return places_known_; }

  const LinkReadings& readings() const { return readings_; }
  const LinkRowLimits& limits() const { return limits_; }

 private:
  LinkReadings readings_;
  LinkRowLimits limits_;
  std::vector<int> run_;
  bool places_known_;
};

}  // namespace muster::diagnosis
