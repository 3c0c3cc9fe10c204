#include "diagnosis/radio/causes/place_moves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using std::numbers::pi;

using Ways = std::vector<std::array<double, 4>>;

// m, of a driven path.
double longest_piece(const MeasurementGeometry& s) { return thresholds::longest_step * s.scale; }

// First path that starts at most `reach` west of x; paths are sorted by x.
Ways::const_iterator from_west_of(const Ways& ways, double x, double reach) {
  return std::partition_point(ways.begin(), ways.end(), [&](const auto& w) { return w[0] - x < -reach; });
}

}  // namespace

MeasurementGeometry in_own_unit(MeasurementGeometry s) {
  for (Span* span : {&s.east, &s.north}) span->low /= s.scale, span->high /= s.scale;
  for (auto& way : s.ways) {
    for (double& at : way) at /= s.scale;
  }
  for (auto& place : s.standing) {
    for (double& at : place) at /= s.scale;
  }
  s.scale = 1;
  return s;
}

Eigen::VectorXd in_unit(PlaceShape place, Eigen::VectorXd theta, double scale) {
  theta.segment(1, place == PlaceShape::segment ? 3 : 2) /= scale;
  if (place == PlaceShape::point && theta.size() > 3) theta[3] -= std::log(scale);
  return theta;
}

int driven_across(const MeasurementGeometry& s, double x, double y, double length, double angle) {
  const double reach = length / 2 + longest_piece(s);
  const double ex = length / 2 * std::cos(angle), ey = length / 2 * std::sin(angle);
  const auto side = [](double ax, double ay, double bx, double by, double px, double py) {
    return (bx - ax) * (py - ay) - (by - ay) * (px - ax) > 0;
  };
  int count = 0;
  for (auto at = from_west_of(s.ways, x, reach); at != s.ways.end() && at->front() - x <= reach; ++at) {
    const auto& w = *at;
    if (std::abs(w[1] - y) > reach) continue;
    count += side(x - ex, y - ey, x + ex, y + ey, w[0], w[1]) != side(x - ex, y - ey, x + ex, y + ey, w[2], w[3]) &&
             side(w[0], w[1], w[2], w[3], x - ex, y - ey) != side(w[0], w[1], w[2], w[3], x + ex, y + ey);
  }
  return count;
}

bool driven_through(const MeasurementGeometry& s, double x, double y, double radius) {
  const double reach = radius + longest_piece(s);
  for (auto at = from_west_of(s.ways, x, reach); at != s.ways.end() && at->front() - x <= reach; ++at) {
    const Eigen::Vector2d from(at->front() - x, (*at)[1] - y), way((*at)[2] - at->front(), (*at)[3] - (*at)[1]);
    if (std::abs(from.y()) > reach) continue;
    // Between the ends of a longer piece a robot may have driven round the disk.
    const bool is_straight = way.squaredNorm() < 2 * radius * radius;
    const double nearest = is_straight ? std::clamp(-from.dot(way) / std::max(way.squaredNorm(), 1e-12), 0.0, 1.0) : 0;
    if ((from + nearest * way).squaredNorm() < 0.49 * radius * radius) return true;
  }
  return false;
}

double belief_in_segment(const MeasurementGeometry& s, const Eigen::VectorXd& t) {
  const double off = std::remainder(t[4] - s.plan_angle, pi / 2) / thresholds::wall_slant;
  return -off * off / 2;
}

Eigen::MatrixXd moves_of_segment(const MeasurementGeometry& s, const Eigen::VectorXd& t) {
  constexpr double way = move_of_segment, turn = 0.15, away = 0.25;  // m, rad, share of the distance
  const Eigen::Vector2d along(std::cos(t[4]), std::sin(t[4])), across(-along.y(), along.x());
  const Eigen::Index shapes = t.size() - 5, others = shapes + (s.standing.empty() ? 0 : 1);
  Eigen::MatrixXd moves = Eigen::MatrixXd::Zero(t.size(), 6 + others);
  for (Eigen::Index k = 0; k < shapes; ++k) moves(5 + k, 6 + k) = way;
  moves.col(0).segment<2>(1) = way * along;
  moves.col(1).segment<2>(1) = way * across;
  for (const Eigen::Index end : {2, 3}) {
    const double side = end == 2 ? 1 : -1;
    moves.col(end).segment<2>(1) = side * way / 2 * along;
    moves(3, end) = way;
    moves.col(end + 2).segment<2>(1) = side * turn * t[3] / 2 * across;
    moves(4, end + 2) = turn;
  }
  if (s.standing.empty()) return moves;
  const auto far = [&](const std::array<double, 2>& p) { return std::hypot(t[1] - p[0], t[2] - p[1]); };
  const auto radio = *std::min_element(s.standing.begin(), s.standing.end(),
                                       [&](const auto& a, const auto& b) { return far(a) < far(b); });
  moves.rightCols(1).middleRows(1, 3) = away * Eigen::Vector3d(t[1] - radio[0], t[2] - radio[1], t[3]);
  return moves;
}

Eigen::MatrixXd moves_of_disk(const MeasurementGeometry& s, const Eigen::VectorXd& t) {
  constexpr double way = 0.3, away = 0.25;  // m; share of the distance, and of the radius
  constexpr std::size_t most = 2;           // radios
  std::vector<Eigen::Vector2d> from;
  for (const auto& p : s.standing) from.emplace_back(t[1] - p[0], t[2] - p[1]);
  std::stable_sort(from.begin(), from.end(),
                   [](const auto& a, const auto& b) { return a.squaredNorm() < b.squaredNorm(); });
  if (from.size() > most) from.resize(most);
  Eigen::MatrixXd moves = Eigen::MatrixXd::Zero(4, 3 + 3 * static_cast<Eigen::Index>(from.size()));
  moves.bottomLeftCorner<3, 3>() = way * Eigen::Matrix3d::Identity();
  Eigen::Index k = 3;
  for (const Eigen::Vector2d& radio : from) {
    const Eigen::Vector2d across = Eigen::Vector2d(-radio.y(), radio.x()).normalized();
    for (const double side : {1.0, -1.0}) {
      moves.col(k).segment<2>(1) = side * way / 2 * across;
      moves(3, k++) = way / 2 / std::exp(t[3]);
    }
    moves.col(k).segment<2>(1) = away * radio;
    moves(3, k++) = away;
  }
  return moves;
}

std::vector<Eigen::VectorXd> spans(const std::vector<inference::Piece>& pieces, const std::string& id) {
  std::vector<Eigen::VectorXd> result;
  std::vector<std::array<Eigen::Vector2d, 2>> ends;
  for (const inference::Piece& p : pieces) {
    const Eigen::Vector2d middle = p.theta.segment<2>(1);
    const Eigen::Vector2d half =
        p.id == id ? Eigen::Vector2d(p.theta[3] / 2 * std::cos(p.theta[4]), p.theta[3] / 2 * std::sin(p.theta[4]))
                   : Eigen::Vector2d(0, 0);
    ends.push_back({middle - half, middle + half});
  }
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      Eigen::Vector2d from = ends[i][0], to = ends[i][0];
      for (const auto& a : {ends[i][0], ends[i][1], ends[j][0], ends[j][1]}) {
        for (const auto& b : {ends[i][0], ends[i][1], ends[j][0], ends[j][1]}) {
          if ((b - a).norm() > (to - from).norm()) from = a, to = b;
        }
      }
      const Eigen::Vector2d way = to - from, middle = (from + to) / 2;
      result.push_back(Eigen::VectorXd(5));
      result.back() << 0, middle, way.norm(), std::atan2(way.y(), way.x());
    }
  }
  return result;
}

}  // namespace muster::diagnosis
