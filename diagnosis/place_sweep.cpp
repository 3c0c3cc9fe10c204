#include "diagnosis/place_sweep.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/cause_axes.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double quarter_turn = 1.5707963267948966;
constexpr double between_lines = 0.25, between_starts = 0.4, shortest = 0.8, longest = 6, aside = 0.05;  // m
constexpr std::size_t most = 400;                                                                        // thetas

struct Swept {
  double gain;
  VectorXd theta;
};

std::vector<VectorXd> best_of(std::vector<Swept> all) {
  std::stable_sort(all.begin(), all.end(), [](const Swept& a, const Swept& b) { return a.gain > b.gain; });
  if (all.size() > most) all.resize(most);
  std::vector<VectorXd> result;
  for (Swept& one : all) result.push_back(std::move(one.theta));
  return result;
}

// A way in the frame of the lines.
struct Way {
  double p0, q0, p1, q1;  // m, along and across

  bool crosses(double q) const { return (q0 < q) != (q1 < q); }
  double at(double q) const { return p0 + (p1 - p0) * (q - q0) / (q1 - q0); }
};

// All segments in one direction.
class Lines {
 public:
  Lines(const Survey& survey, const LinkEnds& ends, search::Tally& tally, double angle)
      : survey_(survey), tally_(tally), angle_(angle), c_(std::cos(angle)), s_(std::sin(angle)) {
    for (Index row = 0; row < tally.rows(); ++row) {
      const auto& [a, b] = ends[static_cast<std::size_t>(tally.reading(row))];
      links_.push_back(turned(a.x, a.y, b.x, b.y));
    }
    for (const auto& w : survey.ways) driven_.push_back(turned(w[0], w[1], w[2], w[3]));
  }

  void sweep(std::vector<Swept>& out) {
    double low = 1e300, high = -1e300;
    for (const Way& w : links_) {
      low = std::min({low, w.q0, w.q1});
      high = std::max({high, w.q0, w.q1});
    }
    for (double q = low + between_lines / 2; q < high; q += between_lines) sweep_line(q, out);
  }

 private:
  struct Crossing {
    double at;
    Index row;
  };

  Way turned(double x0, double y0, double x1, double y1) const {
    return {c_ * x0 + s_ * y0, c_ * y0 - s_ * x0, c_ * x1 + s_ * y1, c_ * y1 - s_ * x1};
  }

  void sweep_line(double q, std::vector<Swept>& out) {
    std::vector<Crossing> crossings;
    for (std::size_t k = 0; k < links_.size(); ++k) {
      if (links_[k].crosses(q)) crossings.push_back({links_[k].at(q), static_cast<Index>(k)});
    }
    if (crossings.empty()) return;
    std::sort(crossings.begin(), crossings.end(),
              [](const Crossing& a, const Crossing& b) { return std::pair(a.at, a.row) < std::pair(b.at, b.row); });
    std::vector<double> barred{crossings.front().at - 1};
    for (const Way& w : driven_) {
      if (w.crosses(q)) barred.push_back(w.at(q));
    }
    barred.push_back(crossings.back().at + 1);
    std::sort(barred.begin(), barred.end());
    for (std::size_t k = 0; k + 1 < barred.size(); ++k) {
      if (barred[k + 1] - barred[k] > shortest + 2 * aside)
        sweep_gap(q, barred[k] + aside, barred[k + 1] - aside, crossings, out);
    }
  }

  // From every start in a gap between ways on to its end; the best piece of the gap.
  void sweep_gap(double q, double from, double to, const std::vector<Crossing>& crossings, std::vector<Swept>& out) {
    Swept best{0, {}};
    const double belief = 2 * belief_in_segment(survey_, theta(q, from, to));
    for (double start = from; start < to - shortest; start += between_starts) {
      const double end = std::min(to, start + longest);
      tally_.clear();
      auto next = std::lower_bound(crossings.begin(), crossings.end(), start,
                                   [](const Crossing& c, double at) { return c.at < at; });
      for (; next != crossings.end() && next->at < end; ++next) {
        tally_.add(next->row, -1);
        const auto after = next + 1;
        const double until = after == crossings.end() ? end : std::min(end, after->at);
        if (until - start < shortest) continue;
        const double gain = tally_.gain() + belief;
        // It ends between this link, which it stops, and the next, which passes.
        if (gain > best.gain) best = {gain, theta(q, start, std::max((next->at + until) / 2, start + shortest))};
      }
    }
    if (best.gain > 0) out.push_back(std::move(best));
  }

  VectorXd theta(double q, double from, double to) const {
    VectorXd result(5);
    const double p = (from + to) / 2;
    result << 0, c_ * p - s_ * q, s_ * p + c_ * q, to - from, angle_;
    return result;
  }

  const Survey& survey_;
  search::Tally& tally_;
  double angle_, c_, s_;
  std::vector<Way> links_, driven_;
};

}  // namespace

std::vector<VectorXd> swept_segments(const Survey& survey, const LinkEnds& ends, search::Tally& tally) {
  std::vector<Swept> found;
  for (const double turn : {0.0, quarter_turn}) {
    for (const double slant : {-0.3, -0.15, 0.0, 0.15, 0.3})
      Lines(survey, ends, tally, survey.plan_angle + turn + slant).sweep(found);
  }
  return best_of(std::move(found));
}

std::vector<VectorXd> swept_disks(const Survey& survey, const LinkEnds& ends, search::Tally& tally) {
  constexpr double between_places = 0.4;
  constexpr std::array radii{0.3, 0.5, 0.8};
  std::vector<std::array<double, 4>> links;
  for (Index row = 0; row < tally.rows(); ++row) {
    const auto& [a, b] = ends[static_cast<std::size_t>(tally.reading(row))];
    links.push_back({a.x, a.y, b.x - a.x, b.y - a.y});
  }
  std::vector<Swept> found;
  const auto gain = [&](double x, double y, double radius) {
    tally.clear();
    for (std::size_t k = 0; k < links.size(); ++k) {
      const auto& [ax, ay, ex, ey] = links[k];
      const double squared = ex * ex + ey * ey;
      if (squared <= 0) continue;
      const double along = ((x - ax) * ex + (y - ay) * ey), side = ((x - ax) * ey - (y - ay) * ex);
      if (side * side >= radius * radius * squared) continue;
      const double length = std::sqrt(squared), half = std::sqrt(radius * radius - side * side / squared);
      const double way = std::min(along / length + half, length) - std::max(along / length - half, 0.0);
      if (way > 0) tally.add(static_cast<Index>(k), std::expm1(-way / radius));
    }
    return tally.gain();
  };
  for (double x = survey.east.low; x < survey.east.high; x += between_places) {
    for (double y = survey.north.low; y < survey.north.high; y += between_places) {
      for (const double radius : radii) {
        if (driven_through(survey, x, y, radius)) continue;
        VectorXd theta(4);
        theta << 0, x, y, std::log(radius);
        found.push_back({gain(x, y, radius), theta});
      }
    }
  }
  return best_of(std::move(found));
}

}  // namespace muster::diagnosis
