#include "seen_obstacles.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>

namespace muster {

using roadmap::Point;

SeenObstacles::SeenObstacles(std::string_view bytes) {
  for (; bytes.size() >= sizeof(Spot); bytes.remove_prefix(sizeof(Spot))) {
    Spot spot;
    std::memcpy(&spot, bytes.data(), sizeof spot);
    seen_.emplace(std::pair{std::floor(spot.x / cell), std::floor(spot.y / cell)}, spot);
  }
}

std::string SeenObstacles::bytes() const {
  std::string result;
  for (const auto& [at, spot] : seen_) result.append(reinterpret_cast<const char*>(&spot), sizeof spot);
  return result;
}

bool SeenObstacles::see(const Point& echo, double time) {
  const auto [at, is_new] =
      seen_.emplace(std::pair{std::floor(echo.x / cell), std::floor(echo.y / cell)}, Spot{echo.x, echo.y, time});
  at->second.t = time;
  return is_new;
}

void SeenObstacles::forget(double time, double forget) {
  for (auto at = seen_.begin(); at != seen_.end();) at = time - at->second.t > forget ? seen_.erase(at) : std::next(at);
}

bool SeenObstacles::is_free(const Point& from, const Point& to, const Point& start, double radius) const {
  constexpr double rounding = 1e-9;  // [m]
  return std::all_of(seen_.begin(), seen_.end(), [&](const auto& each) {
    const Point echo{each.second.x, each.second.y};
    const double away = distance(echo, from, to);
    return away >= radius || away >= distance(echo, start) - rounding;
  });
}

std::vector<Point> echoes_of(const Scan& scan, std::string_view ranges, double reach) {
  constexpr double above_ground = 0.02;  // [m]
  std::vector<Point> result;
  if (is_null(scan.x) || is_null(scan.y) || is_null(scan.yaw)) return result;
  const Eigen::Isometry3d at =
      Eigen::Translation3d(scan.at_x, scan.at_y, scan.at_z) * Eigen::Quaterniond(scan.qw, scan.qx, scan.qy, scan.qz);
  const double c = std::cos(scan.yaw), s = std::sin(scan.yaw);
  for (std::size_t i = 0; i < ranges.size() / sizeof(double); ++i) {
    double range;
    std::memcpy(&range, ranges.data() + i * sizeof range, sizeof range);
    if (!(range >= 0 && range <= reach)) continue;
    const double angle = scan.min_angle + static_cast<double>(i) * scan.step;
    const Eigen::Vector3d place = at * (range * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
    if (place.z() < above_ground) continue;
    result.push_back({scan.x + c * place.x() - s * place.y(), scan.y + s * place.x() + c * place.y()});
  }
  return result;
}

}  // namespace muster
