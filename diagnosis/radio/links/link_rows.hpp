// Groups readings of radio links to rows of the search, and computes the sites of rows.
#pragma once

#include <limits>

#include "diagnosis/inference/state/layout.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {

struct LinkReadings {
  std::vector<double> t;          // s; empty: readings of a link are in order of time
  std::vector<int> tx, rx;        // radio indices, independent of the order of readings
  Eigen::Matrix3Xd tx_at, rx_at;  // m
  std::vector<double> rx_yaw;     // rad; empty: unknown
  std::vector<double> tx_yaw;     // the same of the transmitter
  std::vector<double> level;      // dB, expected level of a model; empty: unknown
  // Which of the radios' settings (powers, channels, ...) the data were read at, from 0; empty: always the same.
  std::vector<int> setting{};
  // The reading of the other direction at the same moment, or -1; empty: none has one, or the two scatter apart.
  std::vector<noise::Index> twin;
  double twin_variance = 0;  // dB^2, of half the difference of twins

  noise::Index size() const { return static_cast<noise::Index>(tx.size()); }
};

// Limits of a row: largest differences of its readings from its first one.
struct LinkRowLimits {
  double time = thresholds::row_time;    // s
  double turn = thresholds::row_turn;    // rad
  double way = thresholds::row_way;      // m, of either end
  double level = thresholds::row_level;  // dB: levels with and without a wall are not averaged
  // Most readings of a row where none has a time: all those of one place would be one row, whatever scatters them.
  noise::Index untimed = std::numeric_limits<noise::Index>::max();
};

// Rows within these limits, sorted by link, then time. Readings of one setting stand together among those of one link
// that are of no time or not further apart than a row lasts.
noise::Rows link_rows(const LinkReadings& readings, const LinkRowLimits& limits = {});
// Place: the end that moves more. Anchor: the other one, the same for both directions of a pair.
noise::Sites link_sites(const noise::Rows& rows, const LinkReadings& readings);
// The middle reading of each row, of means the first twin.
LinkReadings middles(const noise::Rows& rows, const LinkReadings& readings);

// Limits for a search: rows as short as 4,000 rows allow, down to single readings, since short rows show unmapped walls
// best. Where usual rows would be more than 10,000, rows are up to four times longer. This saves time, and keeps each
// row's fixed number of neighbours from lying too close to show the decorrelation distance.
LinkRowLimits limits_for(const LinkReadings& readings);

// The anchor's radio of each row, or the other one if all rows have the same anchor. Numbered from 0.
std::vector<int> radios_of(const noise::Rows& rows, const noise::Sites& sites, const LinkReadings& readings);

// Layout of link readings for the inference engine.
class LinkLayout : public inference::Layout {
 public:
  // `run`: of each reading, from 0; empty if the data name none. `places_known`: false if the data have only distances,
  // which places then represent. `drawn`: correlation of the world's shadowing, or null.
  LinkLayout(LinkReadings readings, const LinkRowLimits& limits, std::vector<int> run = {}, bool places_known = true,
             std::shared_ptr<const noise::StatedCorrelation> drawn = nullptr)
      : readings_(std::move(readings)),
        limits_(limits),
        run_(std::move(run)),
        places_known_(places_known),
        drawn_(std::move(drawn)) {}

  noise::Index size() const override { return readings_.size(); }
  noise::Rows rows() const override { return link_rows(readings_, limits_); }
  noise::Rows long_rows() const override;
  noise::Sites sites(const noise::Rows& rows) const override;
  std::vector<inference::Grouping> groupings(const noise::Rows& rows, const noise::Sites& sites) const override;
  std::vector<double> times(const noise::Rows& rows) const override;
  std::vector<int> parts_of_time(const noise::Rows& rows) const override;
  std::vector<int> stays(const noise::Rows& rows) const override;
  bool sites_known() const override { return places_known_; }

  const LinkReadings& readings() const { return readings_; }
  const LinkRowLimits& limits() const { return limits_; }

 private:
  LinkReadings readings_;
  LinkRowLimits limits_;
  std::vector<int> run_;
  bool places_known_;
  std::shared_ptr<const noise::StatedCorrelation> drawn_;
};

}  // namespace muster::diagnosis
