// Scans the plan for walls and obstacles: gain at every possible place, before any refinement. Places and the rows that
// they concern are computed once, for any number of scans.
#pragma once

#include <array>

#include "diagnosis/inference/state/candidate.hpp"
#include "diagnosis/radio/links/measurement_geometry.hpp"

namespace muster::diagnosis {

// x y of both ends of the link of each row, m.
using Links = std::vector<std::array<double, 4>>;

// The same for each reading, row by row, in order of time.
struct ReadingLinks {
  Links links;
  std::vector<std::size_t> first;  // first reading of each row, and one past the last
};

struct Swept {
  double gain;
  Eigen::VectorXd theta;
};

// Scans lines 0.25 m apart, along and across the plan's walls and up to 0.3 rad aslant. Stretches that no radio was
// driven across are scored by one link a row. The best are improved by a pattern search over all readings.
class SegmentScan {
 public:
  SegmentScan(const MeasurementGeometry& survey, Links links, ReadingLinks readings);

  // Thetas (0 for the row, x, y, length, angle), the best first.
  std::vector<Eigen::VectorXd> operator()(inference::Tally& tally) const;

 private:
  struct Crossing {
    double at;  // m along the line
    Eigen::Index row;
  };
  // A stretch of a line that no radio was driven across.
  struct Gap {
    double angle, across, from, to, belief;
    std::vector<Crossing> crossings;  // in order along the line
  };

  struct Piece {
    double gain, from, to;  // m along the line
  };

  struct Way;
  void lay_out(const std::vector<Way>& links, const std::vector<Way>& driven, double angle, double across);
  static Piece best_piece(const Gap& gap, double first, inference::Tally& tally);
  Swept climb(const Swept& from, inference::Tally& tally) const;
  template <class Stopped>
  double share(std::size_t row, const Stopped& stopped) const;

  MeasurementGeometry geometry_;
  Links links_;
  ReadingLinks readings_;
  std::vector<Gap> gaps_;
};

// Scans disks of three radii at places 0.4 m apart, clear of driven paths, then a finer grid about the best. Where
// readings are dense, gains fall within 0.1 m and have many local maxima.
class DiskScan {
 public:
  DiskScan(const MeasurementGeometry& survey, Links links);

  // Thetas (0 for the row, x, y, log radius), the best first.
  std::vector<Eigen::VectorXd> operator()(inference::Tally& tally) const;

 private:
  static constexpr std::array radii{0.3, 0.5, 0.8};                             // m
  static constexpr double narrowest = 0.2, widest = 1.2, between_places = 0.4;  // m

  // A link that passes a place: distances along it and aside, both times its length, and its squared length.
  struct Passing {
    Eigen::Index row;
    double along, side, squared;
  };
  struct Place {
    double x, y;
    double widest;  // m, largest radius clear of driven paths
    std::vector<Passing> passing;
  };
  // Links near one place.
  struct Near {
    std::vector<Eigen::Index> links;
    inference::Tally& tally;
    std::vector<Passing> passing;  // found by the last query
  };

  std::vector<Swept> closely_about(const Swept& place, inference::Tally& tally) const;
  Swept climb(Swept from, Near& near) const;
  double gain_at(double x, double y, double radius, Near& near) const;
  void find_passing(double x, double y, double radius, const std::vector<Eigen::Index>& among,
                    std::vector<Passing>& passing) const;
  static double gain(double radius, const std::vector<Passing>& passing, inference::Tally& tally);

  MeasurementGeometry geometry_;
  Links links_;
  std::vector<Eigen::Index> all_;  // indices of all links
  std::vector<Place> places_;
};

}  // namespace muster::diagnosis
