#include "diagnosis/place_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "diagnosis/cause_axes.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double quarter_turn = 1.5707963267948966;
constexpr double between_lines = 0.25, between_starts = 0.4, shortest = 0.8, longest = 6, aside = 0.05;  // m
constexpr std::size_t most = 400;                                                                        // thetas

std::vector<Swept> the_best(std::vector<Swept> all) {
  std::stable_sort(all.begin(), all.end(), [](const Swept& a, const Swept& b) { return a.gain > b.gain; });
  if (all.size() > most) all.erase(all.begin() + most, all.end());
  return all;
}

std::vector<VectorXd> thetas_of(std::vector<Swept> all) {
  std::vector<VectorXd> result;
  for (Swept& one : all) result.push_back(std::move(one.theta));
  return result;
}

void check(const search::Tally& tally, std::size_t rows) {
  if (tally.rows() != static_cast<Index>(rows)) throw std::logic_error("a sweep over other rows");
}

VectorXd segment(double angle, double across, double from, double to) {
  const double c = std::cos(angle), s = std::sin(angle), p = (from + to) / 2;
  VectorXd result(5);
  result << 0, c * p - s * across, s * p + c * across, to - from, angle;
  return result;
}

}  // namespace

// In the frame of lines in one direction.
struct SegmentSweep::Way {
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

SegmentSweep::SegmentSweep(const Survey& survey, const Links& links) : rows_(links.size()) {
  for (const double turn : {0.0, quarter_turn}) {
    for (const double slant : {-0.3, -0.15, 0.0, 0.15, 0.3}) {
      const double angle = survey.plan_angle + turn + slant;
      std::vector<Way> turned, driven;
      for (const auto& link : links) turned.emplace_back(link, angle);
      for (const auto& way : survey.ways) driven.emplace_back(way, angle);
      double low = 1e300, high = -1e300;
      for (const Way& w : turned) {
        low = std::min({low, w.q0, w.q1});
        high = std::max({high, w.q0, w.q1});
      }
      for (double q = low + between_lines / 2; q < high; q += between_lines) lay_out(survey, turned, driven, angle, q);
    }
  }
}

// One line.
void SegmentSweep::lay_out(const Survey& survey, const std::vector<Way>& links, const std::vector<Way>& driven,
                           double angle, double across) {
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
    const double belief = 2 * belief_in_segment(survey, segment(angle, across, from, to));
    gaps_.push_back({angle, across, from, to, belief, {first, last}});
  }
}

// From every start in a gap on to its end; the best piece of each gap.
std::vector<VectorXd> SegmentSweep::operator()(search::Tally& tally) const {
  check(tally, rows_);
  std::vector<Swept> found;
  for (const Gap& gap : gaps_) {
    double best = 0, best_from = 0, best_to = 0;
    for (double start = gap.from; start < gap.to - shortest; start += between_starts) {
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
        if (gain <= best) continue;
        best = gain;
        best_from = start;
        // It ends between this link, which it stops, and the next, which passes.
        best_to = std::max((next->at + until) / 2, start + shortest);
      }
    }
    if (best > 0) found.push_back({best, segment(gap.angle, gap.across, best_from, best_to)});
  }
  return thetas_of(the_best(std::move(found)));
}

DiskSweep::DiskSweep(const Survey& survey, Links links)
    : survey_(survey), links_(std::move(links)), all_(links_.size()) {
  std::iota(all_.begin(), all_.end(), 0);
  for (double x = survey.east.low; x < survey.east.high; x += between_places) {
    for (double y = survey.north.low; y < survey.north.high; y += between_places) {
      std::size_t fit = 0;
      while (fit < radii.size() && !driven_through(survey, x, y, radii[fit])) ++fit;
      if (fit > 0) places_.push_back({x, y, radii[fit - 1]});
    }
  }
}

std::vector<VectorXd> DiskSweep::operator()(search::Tally& tally) const {
  check(tally, links_.size());
  std::vector<Swept> found;
  std::vector<Passing> passing;
  for (const Place& place : places_) {
    find_passing(place, all_, passing);
    for (const double radius : radii) {
      if (radius > place.widest) break;
      VectorXd theta(4);
      theta << 0, place.x, place.y, std::log(radius);
      found.push_back({gain(radius, passing, tally), std::move(theta)});
    }
  }
  found = the_best(std::move(found));
  std::vector<Swept> tops;
  for (std::size_t k = 0; k < found.size() && tops.size() < climbed; ++k) {
    const bool apart = std::all_of(
        found.begin(), found.begin() + static_cast<std::ptrdiff_t>(k),
        [&](const Swept& one) { return (one.theta - found[k].theta).segment<2>(1).norm() > 1.5 * between_places; });
    if (apart) tops.push_back(climb(found[k], tally));
  }
  found.insert(found.end(), tops.begin(), tops.end());
  return thetas_of(the_best(std::move(found)));
}

// By steps that halve.
Swept DiskSweep::climb(Swept from, search::Tally& tally) const {
  const VectorXd start = from.theta;
  std::vector<Passing> passing;
  find_passing({start[1], start[2], widest + between_places}, all_, passing);
  std::vector<Index> near;
  for (const Passing& one : passing) near.push_back(one.row);
  for (const double step : {0.2, 0.1, 0.05}) {  // m, and of the logarithm of the radius
    for (bool better = true; better;) {
      better = false;
      for (Index k = 1; k < 4; ++k) {
        for (const double by : {-step, step}) {
          VectorXd theta = from.theta;
          theta[k] += by;
          const double radius = std::exp(theta[3]);
          if (radius < narrowest || radius > widest) continue;
          if ((theta - start).segment<2>(1).norm() > between_places) continue;
          find_passing({theta[1], theta[2], radius}, near, passing);
          const double reached = gain(radius, passing, tally);
          if (reached <= from.gain || driven_through(survey_, theta[1], theta[2], radius)) continue;
          from = {reached, std::move(theta)};
          better = true;
        }
      }
    }
  }
  return from;
}

// Those of the links that go through the widest disk about the place.
void DiskSweep::find_passing(const Place& place, const std::vector<Index>& among, std::vector<Passing>& passing) const {
  passing.clear();
  for (const Index k : among) {
    const auto& [ax, ay, bx, by] = links_[static_cast<std::size_t>(k)];
    const double ex = bx - ax, ey = by - ay, squared = ex * ex + ey * ey;
    if (squared <= 0) continue;
    const double along = ((place.x - ax) * ex + (place.y - ay) * ey),
                 side = ((place.x - ax) * ey - (place.y - ay) * ex);
    if (side * side < place.widest * place.widest * squared) passing.push_back({k, along, side, squared});
  }
}

double DiskSweep::gain(double radius, const std::vector<Passing>& passing, search::Tally& tally) {
  tally.clear();
  for (const auto& [row, along, side, squared] : passing) {
    if (side * side >= radius * radius * squared) continue;
    const double length = std::sqrt(squared), half = std::sqrt(radius * radius - side * side / squared);
    const double way = std::min(along / length + half, length) - std::max(along / length - half, 0.0);
    if (way > 0) tally.add(row, std::expm1(-way / radius));
  }
  return tally.gain();
}

}  // namespace muster::diagnosis
