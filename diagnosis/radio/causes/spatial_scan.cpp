#include "diagnosis/radio/causes/spatial_scan.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "diagnosis/radio/causes/place_moves.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double quarter_turn = 1.5707963267948966;
constexpr double between_lines = 0.25, between_starts = 0.4, shortest = 0.8, longest = 6, aside = 0.05;  // m
constexpr double most_lines = 500, most_places = 100'000;  // beyond these a scan of a large area is coarser
constexpr std::size_t most = 400;                          // thetas

std::vector<Swept> the_best(std::vector<Swept> all) {
  std::stable_sort(all.begin(), all.end(), [](const Swept& a, const Swept& b) { return a.gain > b.gain; });
  if (all.size() > most) all.erase(all.begin() + most, all.end());
  return all;
}

std::vector<VectorXd> thetas_of(std::vector<Swept> all) {
  std::vector<VectorXd> result(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) result[k] = std::move(all[k].theta);
  return result;
}

// Negative share of the full loss after a path of this length through a disk: exp(-radii) - 1, tabulated to 0.001.
double lost(double radii) {
  constexpr double parts = 512;
  static const auto table = [] {
    std::array<double, static_cast<std::size_t>(parts) + 1> result{};
    for (std::size_t k = 0; k < result.size(); ++k) result[k] = std::expm1(-2.0 * static_cast<double>(k) / parts);
    return result;
  }();
  return table[static_cast<std::size_t>(std::min(radii * parts / 2 + 0.5, parts + 0.5))];
}

// Links whose line passes within `reach` metres of a place.
std::vector<Index> links_near(const Links& links, double x, double y, double reach) {
  std::vector<Index> near;
  for (std::size_t k = 0; k < links.size(); ++k) {
    const auto& [ax, ay, bx, by] = links[k];
    const double ex = bx - ax, ey = by - ay, side = (x - ax) * ey - (y - ay) * ex;
    if (side * side < reach * reach * (ex * ex + ey * ey)) near.push_back(static_cast<Index>(k));
  }
  return near;
}

// Up to `count` of the best, more than `least` metres apart.
std::vector<Swept> apart(const std::vector<Swept>& best_first, double least, std::size_t count) {
  std::vector<Swept> result;
  for (const Swept& one : best_first) {
    if (result.size() == count) break;
    const bool far = std::all_of(result.begin(), result.end(), [&](const Swept& better) {
      return (better.theta - one.theta).segment<2>(1).norm() > least;
    });
    if (far) result.push_back(one);
  }
  return result;
}

// Pattern search with halving steps along `ways`, until no step gains more than `worth`.
template <class Ways, class Gain, class May>
Swept local_search(Swept from, double worth, const Ways& ways, const Gain& gain, const May& may) {
  for (const double step : {0.2, 0.1, 0.05, 0.025}) {  // m
    for (bool better = true; better;) {
      better = false;
      for (const VectorXd& way : ways(from.theta)) {
        Swept next{0, from.theta + step * way};
        next.gain = gain(next.theta);
        if (next.gain <= from.gain + worth || !may(next.theta)) continue;
        from = std::move(next);
        better = true;
      }
    }
  }
  return from;
}

void check(const inference::Tally& tally, std::size_t rows) {
  if (tally.rows() != static_cast<Index>(rows)) throw std::logic_error("a sweep over other rows");
}

VectorXd segment(double angle, double across, double from, double to) {
  const double c = std::cos(angle), s = std::sin(angle), p = (from + to) / 2;
  VectorXd result(5);
  result << 0, c * p - s * across, s * p + c * across, to - from, angle;
  return result;
}

}  // namespace

// A link or driven path, in the frame of lines of one direction.
struct SegmentScan::Way {
  double p0, q0, p1, q1;  // m, along and across

  Way(const std::array<double, 4>& plan, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    const auto [x0, y0, x1, y1] = plan;
    p0 = c * x0 + s * y0, q0 = c * y0 - s * x0;
    p1 = c * x1 + s * y1, q1 = c * y1 - s * x1;
  }
  bool crosses(double q) const { return (q0 < q) != (q1 < q); }
  double at(double q) const { return p0 + (p1 - p0) * (q - q0) / (q1 - q0); }
};

SegmentScan::SegmentScan(const MeasurementGeometry& survey, Links links, ReadingLinks readings)
    : geometry_(survey), links_(std::move(links)), readings_(std::move(readings)) {
  for (const double turn : {0.0, quarter_turn}) {
    for (const double slant : {-0.3, -0.15, 0.0, 0.15, 0.3}) {
      const double angle = survey.plan_angle + turn + slant;
      std::vector<Way> turned, driven;
      for (const auto& link : links_) turned.emplace_back(link, angle);
      for (const auto& way : survey.ways) driven.emplace_back(way, angle);
      double low = 1e300, high = -1e300;
      for (const Way& w : turned) {
        low = std::min({low, w.q0, w.q1});
        high = std::max({high, w.q0, w.q1});
      }
      const double step = std::max(between_lines, (high - low) / most_lines);
      for (double q = low + step / 2; q < high; q += step) lay_out(turned, driven, angle, q);
    }
  }
}

// Adds the gaps of one line.
void SegmentScan::lay_out(const std::vector<Way>& links, const std::vector<Way>& driven, double angle, double across) {
  std::vector<Crossing> crossings;
  for (std::size_t k = 0; k < links.size(); ++k) {
    if (links[k].crosses(across)) crossings.push_back({links[k].at(across), static_cast<Index>(k)});
  }
  if (crossings.empty()) return;
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& a, const Crossing& b) { return std::pair(a.at, a.row) < std::pair(b.at, b.row); });
  std::vector<double> barred{crossings.front().at - 1};
  for (const Way& w : driven) {
    if (w.crosses(across)) barred.push_back(w.at(across));
  }
  barred.push_back(crossings.back().at + 1);
  std::sort(barred.begin(), barred.end());
  for (std::size_t k = 0; k + 1 < barred.size(); ++k) {
    if (!(barred[k + 1] - barred[k] > shortest + 2 * aside)) continue;
    const double from = barred[k] + aside, to = barred[k + 1] - aside;
    const auto before = [](const Crossing& c, double at) { return c.at < at; };
    const auto first = std::lower_bound(crossings.begin(), crossings.end(), from, before);
    const auto last = std::lower_bound(first, crossings.end(), to, before);
    if (first == last) continue;
    const double belief = 2 * belief_in_segment(geometry_, segment(angle, across, from, to));
    gaps_.push_back({angle, across, from, to, belief, {first, last}});
  }
}

// Best piece of each gap over every other start; starts in between only for large gains. Then a pattern search from the
// best.
std::vector<VectorXd> SegmentScan::operator()(inference::Tally& tally) const {
  constexpr std::size_t climbs = 8;
  check(tally, links_.size());
  std::vector<Piece> best;
  for (const Gap& gap : gaps_) best.push_back(best_piece(gap, gap.from, tally));
  double most = 0;
  for (const Piece& piece : best) most = std::max(most, piece.gain);
  std::vector<Swept> found;
  for (std::size_t k = 0; k < gaps_.size(); ++k) {
    if (best[k].gain <= 0) continue;
    if (best[k].gain >= thresholds::segment_worth * most) {
      const Piece between = best_piece(gaps_[k], gaps_[k].from + between_starts, tally);
      if (between.gain > best[k].gain) best[k] = between;
    }
    found.push_back({best[k].gain, segment(gaps_[k].angle, gaps_[k].across, best[k].from, best[k].to)});
  }
  found = the_best(std::move(found));
  std::vector<Swept> tops;
  for (const Swept& start : apart(found, between_lines, climbs)) tops.push_back(climb(start, tally));
  found.insert(found.end(), tops.begin(), tops.end());
  return thetas_of(the_best(std::move(found)));
}

// Scores pieces from every other start to each crossing, up to the gap's end.
SegmentScan::Piece SegmentScan::best_piece(const Gap& gap, double first, inference::Tally& tally) {
  Piece best{0, 0, 0};
  for (double start = first; start < gap.to - shortest; start += 2 * between_starts) {
    const double end = std::min(gap.to, start + longest);
    tally.clear();
    auto next = std::lower_bound(gap.crossings.begin(), gap.crossings.end(), start,
                                 [](const Crossing& c, double at) { return c.at < at; });
    for (; next != gap.crossings.end() && next->at < end; ++next) {
      tally.add(next->row, -1);
      const auto after = next + 1;
      const double until = after == gap.crossings.end() ? end : std::min(end, after->at);
      if (until - start < shortest) continue;
      const double gain = tally.gain() + gap.belief;
      // The piece ends between this link, which it blocks, and the next, which passes.
      if (gain > best.gain) best = {gain, start, std::max((next->at + until) / 2, start + shortest)};
    }
  }
  return best;
}

// Maxima are narrow where readings are dense: on a line 5 cm aside, a wall's gain fell from 65 to 34.
Swept SegmentScan::climb(const Swept& from, inference::Tally& tally) const {
  constexpr double reach = 1;  // m, beyond the start
  const double x = from.theta[1], y = from.theta[2], farthest = from.theta[3] / 2 + reach;
  const std::vector<Index> near = links_near(links_, x, y, farthest);
  const auto ways = [&](const VectorXd& theta) {
    const Eigen::MatrixXd moves = moves_of_segment(geometry_, theta) / move_of_segment;
    std::vector<VectorXd> both;
    for (const auto& move : moves.colwise()) both.insert(both.end(), {move, -move});
    return both;
  };
  const auto gain = [&](const VectorXd& t) {
    if (t[3] < shortest || t[3] > longest || std::hypot(t[1] - x, t[2] - y) + t[3] / 2 > farthest) return 0.0;
    const double c = std::cos(t[4]), s = std::sin(t[4]), across = c * t[2] - s * t[1], along = c * t[1] + s * t[2];
    const auto stopped = [&](const std::array<double, 4>& ends) {
      const auto [x0, y0, x1, y1] = ends;
      const double q0 = c * y0 - s * x0 - across, q1 = c * y1 - s * x1 - across;
      if ((q0 < 0) == (q1 < 0)) return false;
      const double p0 = c * x0 + s * y0, p1 = c * x1 + s * y1;
      return std::abs(p0 + (p1 - p0) * q0 / (q0 - q1) - along) < t[3] / 2;
    };
    tally.clear();
    for (const Index row : near) {
      const double stops = share(static_cast<std::size_t>(row), stopped);
      if (stops > 0) tally.add(row, -stops);
    }
    return tally.gain() + 2 * belief_in_segment(geometry_, t);
  };
  const auto may = [&](const VectorXd& t) { return driven_across(geometry_, t[1], t[2], t[3], t[4]) == 0; };
  // Shares of rows change with every centimetre: small gains are left to the refinement that follows.
  const double here = gain(from.theta), worth = std::max(0.3, here / 300);
  return local_search({here, from.theta}, worth, ways, gain, may);
}

// Share of a row's readings that are blocked; 0 or 1 if its first and last readings agree.
template <class Stopped>
double SegmentScan::share(std::size_t row, const Stopped& stopped) const {
  const std::size_t first = readings_.first[row], past = readings_.first[row + 1];
  const bool begins = stopped(readings_.links[first]), ends = stopped(readings_.links[past - 1]);
  if (begins == ends) return begins ? 1 : 0;
  int count = 1;
  for (std::size_t k = first + 1; k + 1 < past; ++k) count += stopped(readings_.links[k]) ? 1 : 0;
  return count / static_cast<double>(past - first);
}

DiskScan::DiskScan(const MeasurementGeometry& survey, Links links)
    : geometry_(survey), links_(std::move(links)), all_(links_.size()) {
  std::iota(all_.begin(), all_.end(), 0);
  const double area = survey.east.length() * survey.north.length();
  const double step = std::max(between_places, std::sqrt(area / most_places));
  for (double x = survey.east.low; x < survey.east.high; x += step) {
    for (double y = survey.north.low; y < survey.north.high; y += step) {
      std::size_t fit = 0;
      while (fit < radii.size() && !driven_through(survey, x, y, radii[fit])) ++fit;
      if (fit == 0) continue;
      places_.push_back({x, y, radii[fit - 1], {}});
      find_passing(x, y, radii[fit - 1], all_, places_.back().passing);
    }
  }
}

std::vector<VectorXd> DiskScan::operator()(inference::Tally& tally) const {
  check(tally, links_.size());
  std::vector<Swept> found;
  for (const Place& place : places_) {
    for (const double radius : radii) {
      if (radius > place.widest) break;
      VectorXd theta(4);
      theta << 0, place.x, place.y, std::log(radius);
      found.push_back({gain(radius, place.passing, tally), std::move(theta)});
    }
  }
  found = the_best(std::move(found));
  constexpr std::size_t looked_about = 3;  // places
  std::vector<Swept> tops;
  for (const Swept& place : apart(found, 1.5 * between_places, looked_about)) {
    if (place.gain < thresholds::disk_worth * found[0].gain) break;
    for (Swept& top : closely_about(place, tally)) tops.push_back(std::move(top));
  }
  found.insert(found.end(), tops.begin(), tops.end());
  return thetas_of(the_best(std::move(found)));
}

// Local maxima, by pattern searches from the best of a fine grid.
std::vector<Swept> DiskScan::closely_about(const Swept& place, inference::Tally& tally) const {
  constexpr double between = 0.125, at_most = 0.5;  // m
  constexpr std::array close_radii{0.22, 0.28, 0.36, 0.46, 0.58, 0.74, 0.94};
  constexpr std::size_t climbs = 4;
  const double x = place.theta[1], y = place.theta[2];
  Near near{links_near(links_, x, y, widest + 1), tally, {}};
  std::vector<Swept> grid;
  for (double east = -at_most; east <= at_most; east += between) {
    for (double north = -at_most; north <= at_most; north += between) {
      find_passing(x + east, y + north, close_radii.back(), near.links, near.passing);
      for (const double radius : close_radii) {
        if (driven_through(geometry_, x + east, y + north, radius)) break;
        VectorXd theta(4);
        theta << 0, x + east, y + north, std::log(radius);
        grid.push_back({gain(radius, near.passing, tally), std::move(theta)});
      }
    }
  }
  std::vector<Swept> result;
  for (Swept& start : apart(the_best(std::move(grid)), 1.5 * between, climbs)) result.push_back(climb(start, near));
  return result;
}

double DiskScan::gain_at(double x, double y, double radius, Near& near) const {
  find_passing(x, y, radius, near.links, near.passing);
  return gain(radius, near.passing, near.tally);
}

// Steps: sideways, wider, and sideways with one edge of the shadow kept in place.
Swept DiskScan::climb(Swept from, Near& near) const {
  constexpr double sixteenth = 0.39269908169872414;  // of a turn, rad
  const double x = from.theta[1], y = from.theta[2];
  std::vector<VectorXd> ways;
  const auto add = [&](double east, double north, double wider) {
    ways.push_back(Eigen::Vector4d(0, east, north, wider));
  };
  for (int k = 0; k < 16; k += 2) {
    const double c = std::cos(k * sixteenth), s = std::sin(k * sixteenth);
    if (k % 4 == 0) add(c, s, 0);
    for (const double wider : {0.5, -0.5}) add(c / 2, s / 2, wider);
  }
  for (const double wider : {1.0, -1.0}) add(0, 0, wider);
  const auto gain = [&](const VectorXd& t) {
    if (t[3] < narrowest || t[3] > widest || std::hypot(t[1] - x, t[2] - y) > between_places) return 0.0;
    return gain_at(t[1], t[2], t[3], near);
  };
  const auto may = [&](const VectorXd& t) { return !driven_through(geometry_, t[1], t[2], t[3]); };
  from.theta[3] = std::exp(from.theta[3]);  // the radius itself
  from = local_search(
      std::move(from), 0, [&](const VectorXd&) -> const auto& { return ways; }, gain, may);
  from.theta[3] = std::log(from.theta[3]);
  return from;
}

// Links through the disk.
void DiskScan::find_passing(double x, double y, double radius, const std::vector<Index>& among,
                            std::vector<Passing>& passing) const {
  passing.clear();
  for (const Index k : among) {
    const auto& [ax, ay, bx, by] = links_[static_cast<std::size_t>(k)];
    const double ex = bx - ax, ey = by - ay, squared = ex * ex + ey * ey;
    if (squared <= 0) continue;
    const double along = (x - ax) * ex + (y - ay) * ey, side = (x - ax) * ey - (y - ay) * ex;
    const double beyond = along > squared ? along - squared : std::min(along, 0.0);  // its ends, by its length
    if (side * side < radius * radius * squared && beyond * beyond < radius * radius * squared)
      passing.push_back({k, along, side, squared});
  }
}

double DiskScan::gain(double radius, const std::vector<Passing>& passing, inference::Tally& tally) {
  tally.clear();
  for (const auto& [row, along, side, squared] : passing) {
    if (side * side >= radius * radius * squared) continue;
    const double length = std::sqrt(squared), half = std::sqrt(radius * radius - side * side / squared);
    const double way = std::min(along / length + half, length) - std::max(along / length - half, 0.0);
    if (way > 0) tally.add(row, lost(way / radius));
  }
  return tally.gain();
}

}  // namespace muster::diagnosis
