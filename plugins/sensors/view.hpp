// What a pinhole camera sees of facets and the ground: depth, and colour under the sun with its shadow and in fog.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "facets.hpp"
#include "raster.hpp"

namespace muster {

struct Light {
  Eigen::Vector3d sun;   // towards it, of length 1; below the horizon there is none
  double ambient = 0.4;  // share of light that has no direction
  double fog = 0;        // extinction [1/m]: colours fade into the sky's with exp(-fog x distance) (Koschmieder)
  double shadows = 12;   // are cast within this distance of the camera [m]; 0: none
  Colour sky{0.62f, 0.74f, 0.88f}, ground{0.55f, 0.53f, 0.5f};
};

// Facets and their frame in the world.
struct Seen {
  const Facets* facets;
  Eigen::Isometry3d pose;
};

class View {
 public:
  // `angle` [rad]: width of the field of view.
  View(int width, int height, double angle)
      : picture_(width, height), map_(map_size, map_size), focal_(width / 2.0 / std::tan(angle / 2)) {}

  // The camera looks along x of its frame, with y to the left and z up.
  void look(const Eigen::Isometry3d& camera, const std::vector<Seen>& scene, const Light& light) {
    light_ = light;
    eye_ = camera.translation();
    Eigen::Matrix3d axes;  // of the picture: right, down, ahead
    axes.col(0) = -camera.linear().col(1);
    axes.col(1) = -camera.linear().col(2);
    axes.col(2) = camera.linear().col(0);
    to_world_ = axes;
    drawn_.clear();
    picture_.clear(0);
    has_map_ = light.shadows > 0 && light.sun.z() > lowest_sun;
    if (has_map_) begin_map();
    draw_ground();
    for (const Seen& each : scene) draw(each);
  }

  int width() const { return picture_.width(); }
  int height() const { return picture_.height(); }

  // Along the camera's axis [m]; infinite where nothing is.
  double depth(int x, int y) const {
    const std::uint32_t what = picture_.what(x, y);
    return what == Raster::nothing ? std::numeric_limits<double>::infinity() : 1 / drawn_[what].near(x, y);
  }

  Colour colour(int x, int y) const {
    const std::uint32_t what = picture_.what(x, y);
    if (what == Raster::nothing) return light_.sky;
    const Drawn& drawn = drawn_[what];
    const double depth = 1 / drawn.near(x, y);
    double bright = light_.ambient;
    if (drawn.towards > 0 && !(has_map_ && is_in_shadow(x, y, depth, drawn)))
      bright += (1 - light_.ambient) * drawn.towards;
    const double clear = light_.fog > 0 ? std::exp(-light_.fog * depth * ray(x, y).norm()) : 1;
    const auto mixed = [&](float own, float sky) {
      return static_cast<float>(clear * bright * own + (1 - clear) * sky);
    };
    return {mixed(drawn.colour.red, light_.sky.red), mixed(drawn.colour.green, light_.sky.green),
            mixed(drawn.colour.blue, light_.sky.blue)};
  }

 private:
  static constexpr int map_size = 512;        // of the shadows' picture, a side
  static constexpr double lowest_sun = 0.05;  // sine of its elevation: below it everything is in shadow
  struct Drawn {
    Linear near;
    double towards, slope;  // cosine and tangent of the angle between its normal and the way to the sun
    Colour colour;
    std::uint32_t face;  // of the whole scene
  };

  // Its part along the camera's axis is 1.
  Eigen::Vector3d ray(int x, int y) const {
    return to_world_ * Eigen::Vector3d((x - (width() - 1) / 2.0) / focal_, (y - (height() - 1) / 2.0) / focal_, 1);
  }

  // The level z = 0: at height h over it a ray meets it at h over what it sinks, which is linear over the picture.
  void draw_ground() {
    faces_ = 1;
    if (!(eye_.z() > 0)) return;
    const Eigen::Vector3d sinks = -to_world_.row(2).transpose() / eye_.z();
    const double dx = sinks.x() / focal_, dy = sinks.y() / focal_;
    const Linear near{sinks.z() - dx * (width() - 1) / 2.0 - dy * (height() - 1) / 2.0, dx, dy};
    Cover cover{{near, near, near}, near, 0, width(), 0, height()};
    picture_.fill(cover, 0);
    drawn_.push_back(drawn(near, Eigen::Vector3d::UnitZ(), light_.ground, 0));
  }

  // `normal` towards the camera, of length 1.
  Drawn drawn(const Linear& near, const Eigen::Vector3d& normal, const Colour& colour, std::uint32_t face) const {
    const double towards = light_.sun.z() > lowest_sun ? normal.dot(light_.sun) : 0;
    return {near, towards, towards > 0 ? std::sqrt(std::max(0.0, 1 - towards * towards)) / towards : 0, colour, face};
  }

  void draw(const Seen& each) {
    const Facets& facets = *each.facets;
    const Eigen::Matrix3d to_picture = to_world_.transpose();
    world_.clear(), camera_.clear(), sun_.clear();
    for (const Eigen::Vector3d& corner : facets.corners) {
      world_.push_back(each.pose * corner);
      camera_.push_back(to_picture * (world_.back() - eye_));
      if (has_map_) sun_.push_back(to_map_ * (world_.back() - middle_) + map_middle());
    }
    for (const Facet& facet : facets.facets) {
      const auto [a, b, c] = facet.corners;
      Cover cover;
      if (has_map_ && (seen_from_above(sun_[a], sun_[b], sun_[c], map_size, map_size, cover) ||
                       (facets.is_sheet && seen_from_above(sun_[a], sun_[c], sun_[b], map_size, map_size, cover))))
        map_.fill(cover, faces_ + facet.face);
      const Eigen::Vector3d normal = (world_[b] - world_[a]).cross(world_[c] - world_[a]);
      const double away = normal.dot(world_[a] - eye_);
      if (away >= 0 && !facets.is_sheet) continue;  // its back
      if (!seen_through_pinhole(camera_[a], camera_[b], camera_[c], focal_, width(), height(), cover)) continue;
      picture_.fill(cover, static_cast<std::uint32_t>(drawn_.size()));
      drawn_.push_back(
          drawn(cover.near, (away >= 0 ? -normal : normal).normalized(), facets.colour, faces_ + facet.face));
    }
    faces_ += facets.faces;
  }

  // The sun's picture: around a place ahead of the camera.
  void begin_map() {
    const Eigen::Vector3d ahead = to_world_.col(2);
    middle_ = eye_ + 0.5 * light_.shadows * Eigen::Vector3d(ahead.x(), ahead.y(), 0);
    const Eigen::Vector3d right = light_.sun.unitOrthogonal(), up = light_.sun.cross(right);
    const double pixels = map_size / (1.5 * light_.shadows);  // a metre
    to_map_.row(0) = pixels * right;
    to_map_.row(1) = pixels * up;
    to_map_.row(2) = light_.sun;
    texel_ = 1 / pixels;
    map_.clear(-1e9f);
    eye_in_map_ = to_map_ * (eye_ - middle_) + map_middle() + Eigen::Vector3d(0.5, 0.5, 0);  // to be cut, not rounded
    const Eigen::Matrix3d turned = to_map_ * to_world_;
    ray_dx_ = turned.col(0) / focal_, ray_dy_ = turned.col(1) / focal_;
    ray_at_ = turned.col(2) - ray_dx_ * ((width() - 1) / 2.0) - ray_dy_ * ((height() - 1) / 2.0);
  }
  static Eigen::Vector3d map_middle() { return {map_size / 2.0, map_size / 2.0, 0}; }

  bool is_in_shadow(int x, int y, double depth, const Drawn& drawn) const {
    const Eigen::Vector3d in_map = eye_in_map_ + depth * (ray_at_ + ray_dx_ * x + ray_dy_ * y);
    if (!(in_map.x() >= 0 && in_map.y() >= 0 && in_map.x() < map_size && in_map.y() < map_size)) return false;
    const int u = static_cast<int>(in_map.x()), v = static_cast<int>(in_map.y());
    const std::uint32_t caster = map_.what(u, v);
    if (caster == Raster::nothing || caster == drawn.face) return false;
    return map_.near(u, v) > in_map.z() + texel_ * (1 + drawn.slope);
  }

  Raster picture_, map_;
  double focal_;
  Light light_{};
  Eigen::Vector3d eye_ = Eigen::Vector3d::Zero(), middle_ = eye_;
  Eigen::Matrix3d to_world_ = Eigen::Matrix3d::Identity(), to_map_ = to_world_;
  Eigen::Vector3d eye_in_map_ = eye_, ray_at_ = eye_, ray_dx_ = eye_, ray_dy_ = eye_;  // rays of pixels in the map
  double texel_ = 0;                                                                   // [m]
  bool has_map_ = false;
  std::uint32_t faces_ = 0;
  std::vector<Drawn> drawn_;
  std::vector<Eigen::Vector3d> world_, camera_, sun_;
};

}  // namespace muster
