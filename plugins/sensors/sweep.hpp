// A scan under way: its rays so far, as bytes of doubles between two ticks.
#pragma once

#include <Eigen/Geometry>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace muster {

// Each robot's scans under way, and its pose at the last tick. `of`: 1 + the robot's row; a robot that joins as a copy
// of another begins anew.
struct Sweeps {
  static constexpr const char* columns = "of x[m] y[m] z[m] qw qx qy qz scans{}";
  static constexpr unsigned scans_column = 8;
  double of, x, y, z, qw, qx, qy, qz, scans;
};

// One of them. Its start, its number, and where odometry had the robot then; `is_on` is 0 between scans.
struct Sweep {
  double is_on = 0, t = 0, id = 0, x = 0, y = 0, yaw = 0;
  std::vector<double> ranges;
};

inline std::string bytes_of(const std::vector<Sweep>& sweeps) {
  std::string result;
  const auto put = [&](double value) { result.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (const Sweep& one : sweeps) {
    for (const double value : {one.is_on, one.t, one.id, one.x, one.y, one.yaw}) put(value);
    put(static_cast<double>(one.ranges.size()));
    for (const double range : one.ranges) put(range);
  }
  return result;
}

// As many as a robot has sensors; those that the bytes lack are off. Throws std::runtime_error where they end within
// one.
inline std::vector<Sweep> sweeps_of(std::string_view bytes, std::size_t sensors) {
  std::vector<Sweep> result(sensors);
  std::size_t at = 0;
  const auto get = [&] {
    double value = 0;
    if (at + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof value);
    at += sizeof value;
    return value;
  };
  for (Sweep& one : result) {
    if (at >= bytes.size()) break;
    for (double* value : {&one.is_on, &one.t, &one.id, &one.x, &one.y, &one.yaw}) *value = get();
    const double rays = get();
    const std::size_t left = at < bytes.size() ? (bytes.size() - at) / sizeof(double) : 0;
    if (!(rays >= 0 && rays <= static_cast<double>(left)))
      throw std::runtime_error("the state of a scan under way ends too early");
    one.ranges.resize(static_cast<std::size_t>(rays));
    for (double& range : one.ranges) range = get();
  }
  return result;
}

// A pose between two, at a share of the way from one to the other.
inline Eigen::Isometry3d between(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to, double share) {
  const Eigen::Quaterniond first(from.linear()), last(to.linear());
  const Eigen::Vector3d place = from.translation() + share * (to.translation() - from.translation());
  return Eigen::Translation3d(place) * first.slerp(share, last);
}

}  // namespace muster
