// Walls and things wherever in the plan they could stand: what each would gain, before any is refined. Which places
// there are and which rows they concern is worked out once, for any number of sweeps.
#pragma once

#include <array>

#include "diagnosis/inference/state/candidate.hpp"
#include "diagnosis/radio/links/measurement_geometry.hpp"

namespace muster::diagnosis {

// Of each row of a search, x y of either end of its link, m.
using Links = std::vector<std::array<double, 4>>;

// Of each reading the same, row by row, in the order of their ways.
struct ReadingLinks {
  Links links;
  std::vector<std::size_t> first;  // of each row; one past the last row too
};

struct Swept {
  double gain;
  Eigen::VectorXd theta;
};

// On lines along the plan and a little aslant, a quarter of a metre apart, all pieces that no radio was driven across,
// by one link a row; then by all readings from the best of these to wherever more is gained.
class SegmentScan {
 public:
  SegmentScan(const MeasurementGeometry& survey, Links links, ReadingLinks readings);

  // Thetas (no row, x, y, length, angle), the best first.
  std::vector<Eigen::VectorXd> operator()(inference::Tally& tally) const;

 private:
  struct Crossing {
    double at;  // m along the line
    Eigen::Index row;
  };
  // A piece of a line in which no radio was driven across.
  struct Gap {
    double angle, across, from, to, belief;
    std::vector<Crossing> crossings;  // in their order along the line
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

// A few radii about places 0.4 m apart, clear of all ways; then closely about the best of these, since where readings
// lie dense a thing shows little a tenth of a metre aside, and has many tops.
class DiskScan {
 public:
  DiskScan(const MeasurementGeometry& survey, Links links);

  // Thetas (no row, x, y, log radius), the best first.
  std::vector<Eigen::VectorXd> operator()(inference::Tally& tally) const;

 private:
  static constexpr std::array radii{0.3, 0.5, 0.8};                             // m
  static constexpr double narrowest = 0.2, widest = 1.2, between_places = 0.4;  // m

  // A link that passes by a place: how far along it, times its length; how far aside, the same; its length squared.
  struct Passing {
    Eigen::Index row;
    double along, side, squared;
  };
  struct Place {
    double x, y;
    double widest;  // m: a disk that is clear
    std::vector<Passing> passing;
  };
  // The links about one place.
  struct Near {
    std::vector<Eigen::Index> links;
    inference::Tally& tally;
    std::vector<Passing> passing;  // by what was asked for last
  };

  std::vector<Swept> closely_about(const Swept& place, inference::Tally& tally) const;
  Swept climb(Swept from, Near& near) const;
  double gain_at(double x, double y, double radius, Near& near) const;
  void find_passing(double x, double y, double radius, const std::vector<Eigen::Index>& among,
                    std::vector<Passing>& passing) const;
  static double gain(double radius, const std::vector<Passing>& passing, inference::Tally& tally);

  MeasurementGeometry geometry_;
  Links links_;
  std::vector<Eigen::Index> all_;  // of the links
  std::vector<Place> places_;
};

}  // namespace muster::diagnosis
