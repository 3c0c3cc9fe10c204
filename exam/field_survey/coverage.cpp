#include "exam/field_survey/coverage.hpp"

#include <algorithm>
#include <queue>

namespace muster::exam::survey {
namespace {

double away_from(const Panel& panel, Point p) {
  const double dx = panel.to.x - panel.from.x, dy = panel.to.y - panel.from.y;
  const double u = std::clamp(((p.x - panel.from.x) * dx + (p.y - panel.from.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(panel.from.x + u * dx - p.x, panel.from.y + u * dy - p.y);
}

class Lattice {
 public:
  Lattice(const std::vector<Panel>& panels, Point far, double pitch, double clearance)
      : pitch_(pitch), columns_(static_cast<int>(far.x / pitch)), lines_(static_cast<int>(far.y / pitch)) {
    free_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(lines_), 1);
    for (std::size_t i = 0; i < free_.size(); ++i)
      for (const Panel& panel : panels)
        if (away_from(panel, centre(static_cast<int>(i))) < clearance) free_[i] = 0;
  }

  Point centre(int place) const {
    const int column = place % columns_, row = place / columns_;
    return {(column + 0.5) * pitch_, (row + 0.5) * pitch_};
  }

  int nearest(Point p) const {
    int best = -1;
    double least = 1e300;
    for (int i = 0; i < static_cast<int>(free_.size()); ++i) {
      const Point c = centre(i);
      const double d = std::hypot(c.x - p.x, c.y - p.y);
      if (free_[static_cast<std::size_t>(i)] && d < least) {
        least = d;
        best = i;
      }
    }
    return best;
  }

  // Places from the next one on to the nearest one not in `seen`; empty if all are.
  std::vector<int> leg(int from, const std::vector<char>& seen) const {
    std::vector<int> before(free_.size(), -1), way;
    std::queue<int> open;
    open.push(from);
    before[static_cast<std::size_t>(from)] = from;
    while (!open.empty()) {
      const int here = open.front();
      open.pop();
      if (!seen[static_cast<std::size_t>(here)]) {
        for (int p = here; p != from; p = before[static_cast<std::size_t>(p)]) way.push_back(p);
        std::reverse(way.begin(), way.end());
        return way;
      }
      for (const int next : beside(here))
        if (free_[static_cast<std::size_t>(next)] && before[static_cast<std::size_t>(next)] < 0) {
          before[static_cast<std::size_t>(next)] = here;
          open.push(next);
        }
    }
    return {};
  }

  std::size_t size() const { return free_.size(); }

 private:
  std::vector<int> beside(int place) const {
    std::vector<int> result;
    if (place % columns_ > 0) result.push_back(place - 1);
    if (place % columns_ + 1 < columns_) result.push_back(place + 1);
    if (place >= columns_) result.push_back(place - columns_);
    if (place / columns_ + 1 < lines_) result.push_back(place + columns_);
    return result;
  }

  double pitch_;
  int columns_, lines_;
  std::vector<char> free_;
};

}  // namespace

std::vector<Pose> covering_drive(const std::vector<Panel>& panels, Point far, Point start, double pitch,
                                 double clearance, int count) {
  const Lattice lattice(panels, far, pitch, clearance);
  std::vector<char> seen(lattice.size(), 0);
  std::vector<int> places{lattice.nearest(start)};
  seen[static_cast<std::size_t>(places[0])] = 1;
  for (std::vector<int> leg; !(leg = lattice.leg(places.back(), seen)).empty();)
    for (const int place : leg) {
      places.push_back(place);
      seen[static_cast<std::size_t>(place)] = 1;
    }
  std::vector<Pose> drive;
  const double legs = static_cast<double>(places.size()) - 1;
  for (int i = 0; i < count; ++i) {
    const double along = legs * i / count;
    const auto k = static_cast<std::size_t>(along);
    const Point a = lattice.centre(places[k]), b = lattice.centre(places[k + 1]);
    const double share = along - static_cast<double>(k);
    drive.push_back(
        {{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), start.z}, std::atan2(b.y - a.y, b.x - a.x)});
  }
  return drive;
}

}  // namespace muster::exam::survey
