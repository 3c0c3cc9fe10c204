// A picture of flat facets by a depth buffer. What decides is linear over the picture: edges (Pineda, SIGGRAPH 1988)
// and nearness, both in homogeneous coordinates (Olano and Greer, Graphics Hardware 1997), so that nothing is clipped.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace muster {

// at + dx x + dy y, at the middle of pixel (x, y).
struct Linear {
  double at = 0, dx = 0, dy = 0;
  double operator()(int x, int y) const { return at + dy * y + dx * x; }
};

// The part of a picture where all three edges are not negative, inside a box of pixels.
struct Cover {
  Linear edges[3], near;                         // near: larger is nearer
  int left = 0, right = 0, top = 0, bottom = 0;  // right and bottom are beyond it
};

class Raster {
 public:
  Raster(int width, int height) : width_(width), height_(height) {}

  int width() const { return width_; }
  int height() const { return height_; }

  // Nothing is nearer than `least`.
  void clear(float least) {
    near_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), least);
    what_.assign(near_.size(), nothing);
  }

  void fill(const Cover& cover, std::uint32_t what) {
    for (int y = std::max(cover.top, 0), end = std::min(cover.bottom, height_); y < end; ++y) {
      int from = std::max(cover.left, 0), to = std::min(cover.right, width_);
      for (const Linear& edge : cover.edges) cut(edge, y, from, to);
      if (from < to) fill_row(cover, y, from, to, what);
    }
  }

  static constexpr std::uint32_t nothing = 0xffffffff;
  std::uint32_t what(int x, int y) const { return what_[index(x, y)]; }
  float near(int x, int y) const { return near_[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  // Narrows a row to where the edge is not negative, to the bit as the edge's own value says: of two facets with a
  // common edge, whose values are opposite, no pixel is missed.
  static void cut(const Linear& edge, int y, int& from, int& to) {
    if (from >= to) return;
    if (edge.dx == 0) {
      if (edge(from, y) < 0) to = from;
      return;
    }
    const int low = from, high = to;
    const double zero = std::clamp(-(edge.at + edge.dy * y) / edge.dx, -1e9, 1e9);
    if (edge.dx > 0) {
      from = std::clamp(static_cast<int>(std::ceil(zero)), low, high);
      while (from > low && edge(from - 1, y) >= 0) --from;
      while (from < high && edge(from, y) < 0) ++from;
    } else {
      to = std::clamp(static_cast<int>(std::floor(zero)) + 1, low, high);
      while (to < high && edge(to, y) >= 0) ++to;
      while (to > low && edge(to - 1, y) < 0) --to;
    }
  }

  void fill_row(const Cover& cover, int y, int from, int to, std::uint32_t what) {
    float* near = near_.data() + index(from, y);
    std::uint32_t* whose = what_.data() + index(from, y);
    const float first = static_cast<float>(cover.near(from, y)), step = static_cast<float>(cover.near.dx);
    for (int i = 0; i < to - from; ++i) {
      const float here = first + step * static_cast<float>(i);
      const bool wins = here > near[i];
      near[i] = wins ? here : near[i];
      whose[i] = wins ? what : whose[i];
    }
  }

  int width_, height_;
  std::vector<float> near_;
  std::vector<std::uint32_t> what_;
};

// Where a facet is seen through a pinhole. Corners in the camera's frame: x to the right, y down, z ahead; `focal` in
// pixels, the axis through the middle of the picture. near is 1/z [1/m]. False: not in the picture.
inline bool seen_through_pinhole(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                                 double focal, int width, int height, Cover& cover) {
  const double ahead = 1e-3;  // [m]
  if (a.z() <= 0 && b.z() <= 0 && c.z() <= 0) return false;
  const double x0 = (width - 1) / 2.0, y0 = (height - 1) / 2.0;
  cover.left = 0, cover.right = width, cover.top = 0, cover.bottom = height;
  if (a.z() > ahead && b.z() > ahead && c.z() > ahead) {
    const auto [left, right] = std::minmax({a.x() / a.z(), b.x() / b.z(), c.x() / c.z()});
    const auto [top, bottom] = std::minmax({a.y() / a.z(), b.y() / b.z(), c.y() / c.z()});
    const auto pixel = [](double at) { return static_cast<int>(std::clamp(at, -1e6, 1e6)); };
    cover.left = pixel(std::floor(x0 + focal * left)), cover.right = pixel(std::ceil(x0 + focal * right)) + 1;
    cover.top = pixel(std::floor(y0 + focal * top)), cover.bottom = pixel(std::ceil(y0 + focal * bottom)) + 1;
    if (cover.right <= 0 || cover.left >= width || cover.bottom <= 0 || cover.top >= height) return false;
  }
  const auto over_picture = [&](const Eigen::Vector3d& way, double by) {
    const double dx = by * way.x() / focal, dy = by * way.y() / focal;
    return Linear{by * way.z() - dx * x0 - dy * y0, dx, dy};
  };
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const double volume = normal.dot(a);
  if (volume == 0) return false;  // from its edge
  const double sign = volume > 0 ? 1 : -1;
  cover.edges[0] = over_picture(a.cross(b), sign);
  cover.edges[1] = over_picture(b.cross(c), sign);
  cover.edges[2] = over_picture(c.cross(a), sign);
  cover.near = over_picture(normal, 1 / volume);
  return true;
}

// Where a facet is in a picture taken from above along parallel rays: corners in pixels, z upwards. near is z. False:
// it is turned away, or seen from its edge.
inline bool seen_from_above(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, int width,
                            int height, Cover& cover) {
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  if (normal.z() <= 0) return false;
  const auto [left, right] = std::minmax({a.x(), b.x(), c.x()});
  const auto [top, bottom] = std::minmax({a.y(), b.y(), c.y()});
  if (right < 0 || left > width || bottom < 0 || top > height) return false;
  const auto pixel = [](double at) { return static_cast<int>(std::clamp(at, -1e6, 1e6)); };
  cover.left = pixel(std::floor(left)), cover.right = pixel(std::ceil(right)) + 1;
  cover.top = pixel(std::floor(top)), cover.bottom = pixel(std::ceil(bottom)) + 1;
  const auto edge = [](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const double dx = from.y() - to.y(), dy = to.x() - from.x();
    return Linear{from.x() * to.y() - from.y() * to.x(), dx, dy};
  };
  cover.edges[0] = edge(a, b), cover.edges[1] = edge(b, c), cover.edges[2] = edge(c, a);
  cover.near = {normal.dot(a) / normal.z(), -normal.x() / normal.z(), -normal.y() / normal.z()};
  return true;
}

}  // namespace muster
