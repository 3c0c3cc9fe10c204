#include "diagnosis/radio/links/room_detection.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>

#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;

constexpr double finest = 0.1;   // m: side of a cell
constexpr double most = 4e5;     // cells
constexpr double overlap = 0.2;  // m by which walls are drawn longer, so that their corners close
constexpr int wall = -1, outside = 0;

// Cells of the plan in its own frame, each with the number of its room.
class Raster {
 public:
  Raster(const std::vector<std::array<double, 4>>& walls, double angle) : c_(std::cos(angle)), s_(std::sin(angle)) {
    for (const auto& w : walls) {
      for (const auto& end : {own(w[0], w[1]), own(w[2], w[3])}) {
        low_ = low_.min(end.array());
        high_ = high_.max(end.array());
      }
    }
    const Eigen::Array2d size = high_ - low_;
    side_ = std::max(finest, std::sqrt(size.prod() / most));
    low_ -= overlap + 2 * side_;
    cells_.setConstant(static_cast<Index>((size.x() + 2 * overlap) / side_) + 5,
                       static_cast<Index>((size.y() + 2 * overlap) / side_) + 5, unknown);
    for (const auto& w : walls) draw(own(w[0], w[1]), own(w[2], w[3]));
    flood(0, 0, outside);
  }

  // Number of the room at a place, a new one at its first visit; else `wall` or `outside`.
  int room_at(double x, double y) {
    const Eigen::Array2d at = (own(x, y).array() - low_) / side_;
    if ((at < 0).any() || at.x() >= static_cast<double>(cells_.rows()) || at.y() >= static_cast<double>(cells_.cols()))
      return outside;
    const auto i = static_cast<Index>(at.x()), j = static_cast<Index>(at.y());
    if (cells_(i, j) == unknown) flood(i, j, ++last_);
    return cells_(i, j);
  }

  // Bounding rectangle of a room, up to the middle of its walls.
  OrientedRectangle bounds(int room, double angle) const {
    Eigen::Array2d low(1e300, 1e300), high = -low;
    for (Index j = 0; j < cells_.cols(); ++j) {
      for (Index i = 0; i < cells_.rows(); ++i) {
        if (cells_(i, j) != room) continue;
        const Eigen::Array2d at(static_cast<double>(i), static_cast<double>(j));
        low = low.min(at - 0.5);
        high = high.max(at + 1.5);
      }
    }
    const Eigen::Array2d middle = low_ + side_ * (low + high) / 2, size = side_ * (high - low);
    return {c_ * middle.x() - s_ * middle.y(), s_ * middle.x() + c_ * middle.y(), size.x(), angle, size.y()};
  }

 private:
  static constexpr int unknown = -2;

  Eigen::Vector2d own(double x, double y) const { return {c_ * x + s_ * y, c_ * y - s_ * x}; }

  void draw(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const double length = (to - from).norm();
    if (length <= 0) return;
    const Eigen::Vector2d along = (to - from) / length;
    for (double way = -overlap; way < length + overlap; way += side_ / 4) {
      const Eigen::Array2d at = ((from + way * along).array() - low_) / side_;
      cells_(static_cast<Index>(at.x()), static_cast<Index>(at.y())) = wall;
    }
  }

  void flood(Index i, Index j, int number) {
    std::vector<std::array<Index, 2>> open{{i, j}};
    cells_(i, j) = number;
    while (!open.empty()) {
      const auto [a, b] = open.back();
      open.pop_back();
      for (const auto& [x, y] : {std::array{a - 1, b}, {a + 1, b}, {a, b - 1}, {a, b + 1}}) {
        if (x < 0 || y < 0 || x >= cells_.rows() || y >= cells_.cols() || cells_(x, y) != unknown) continue;
        cells_(x, y) = number;
        open.push_back({x, y});
      }
    }
  }

  double c_, s_, side_ = finest;
  Eigen::Array2d low_{1e300, 1e300}, high_{-1e300, -1e300};
  Eigen::ArrayXXi cells_;
  int last_ = outside;
};

using WallLine = std::array<double, 4>;  // x0 y0 x1 y1, m

Eigen::Vector2d end_of(const WallLine& wall, int end) {
  return end == 0 ? Eigen::Vector2d(wall[0], wall[1]) : Eigen::Vector2d(wall[2], wall[3]);
}

Eigen::Vector2d way_of(const WallLine& wall) { return (end_of(wall, 1) - end_of(wall, 0)).normalized(); }

// True if a wall across that way ends or passes there: a partition ends at it, and no doorway begins.
bool meets_another(const std::vector<WallLine>& walls, const Eigen::Vector2d& at, const Eigen::Vector2d& along) {
  return std::any_of(walls.begin(), walls.end(), [&](const WallLine& wall) {
    const Eigen::Vector2d from = end_of(wall, 0), to = end_of(wall, 1), way = way_of(wall);
    const double on = std::clamp((at - from).dot(way), 0.0, (to - from).norm());
    return std::abs(way.dot(along)) < thresholds::in_one_line && (from + on * way - at).norm() <= overlap;
  });
}

// Openings that are drawn as a gap between two walls in one line, for which many plans have no door.
std::vector<WallLine> doorways(const std::vector<WallLine>& walls) {
  std::vector<WallLine> result;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (std::size_t j = i + 1; j < walls.size(); ++j) {
      for (const auto& [a, b] : {std::array{0, 0}, {0, 1}, {1, 0}, {1, 1}}) {
        const Eigen::Vector2d from = end_of(walls[i], a), to = end_of(walls[j], b), gap = to - from;
        if (gap.norm() < overlap || gap.norm() > thresholds::widest_doorway) continue;
        const Eigen::Vector2d along = gap.normalized();
        const double goes_on = way_of(walls[i]).dot(along) * (a == 1 ? 1 : -1),
                     comes = way_of(walls[j]).dot(along) * (b == 0 ? 1 : -1);
        if (std::min(goes_on, comes) > thresholds::in_one_line && !meets_another(walls, from, along) &&
            !meets_another(walls, to, along))
          result.push_back({from.x(), from.y(), to.x(), to.y()});
      }
    }
  }
  return result;
}

}  // namespace

bool OrientedRectangle::holds(double east, double north) const {
  const double c = std::cos(angle), s = std::sin(angle), dx = east - x, dy = north - y;
  return std::abs(c * dx + s * dy) <= length / 2 && std::abs(c * dy - s * dx) <= width / 2;
}

std::vector<Room> rooms_of(const std::vector<std::array<double, 4>>& walls, double angle,
                           const std::vector<std::array<double, 2>>& places) {
  if (walls.size() < 3) return {};
  std::vector<WallLine> closed = walls;
  const std::vector<WallLine> gaps = doorways(walls);
  closed.insert(closed.end(), gaps.begin(), gaps.end());
  Raster raster(closed, angle);
  std::map<int, int> visits;
  for (const auto& p : places) {
    if (const int room = raster.room_at(p[0], p[1]); room > outside) ++visits[room];
  }
  std::vector<Room> rooms;
  for (const auto& [room, count] : visits) rooms.push_back({raster.bounds(room, angle), count});
  std::stable_sort(rooms.begin(), rooms.end(), [](const Room& a, const Room& b) { return a.visits > b.visits; });
  return rooms;
}

}  // namespace muster::diagnosis
