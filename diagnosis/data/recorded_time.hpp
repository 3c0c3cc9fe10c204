// Time with long pauses shortened. Grids and smooths over it are as fine as the readings, also for sessions a year
// apart.
#pragma once

#include <vector>

#include "diagnosis/data/span.hpp"

namespace muster::diagnosis {

class RecordedTime {
 public:
  RecordedTime() = default;
  RecordedTime(const Span& span) : knots_{{span.low, 0}, {span.high, span.length()}} {}  // without pauses
  // A pause is a step of more than ten minutes that exceeds the sum of all shorter steps. All pauses together take a
  // tenth of the recorded time. Many such steps of about one length are no pauses but a schedule: a network that is
  // asked every hour is recorded through all of its days.
  explicit RecordedTime(std::vector<double> times);

  bool has_pauses() const { return knots_.size() > 2; }
  double low() const { return knots_.empty() ? 0 : knots_.front().time; }
  double high() const { return knots_.empty() ? 0 : knots_.back().time; }
  double length() const { return knots_.empty() ? 0 : knots_.back().shortened; }  // s, pauses shortened
  // From 0 at the first time to length() at the last.
  double shortened(double time) const;
  // Inverse of shortened(), by the share of length().
  double at(double share) const;

 private:
  struct Knot {
    double time, shortened;  // s
  };
  std::vector<Knot> knots_;  // ends of sessions, linear between
};

}  // namespace muster::diagnosis
