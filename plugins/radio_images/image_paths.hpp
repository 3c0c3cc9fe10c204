// Reflected paths between two radios by the image method: walls reflect once or twice. Each wall is a mirror at its
// centre plane; the path by it is the straight line to the radio's image behind it (McKown and Hamilton, Ray tracing as
// a design tool for radio networks, IEEE Network 5(6), 1991).
#pragma once

#include <algorithm>
#include <cmath>
#include <scene/walls.hpp>
#include <vector>

namespace muster {

// Fresnel's reflection of an upright field by an upright dielectric wall: the field is in the wall's plane. `cosine` of
// the angle to the wall's normal. From (1 - sqrt(e)) / (1 + sqrt(e)) head on to -1 along the wall.
inline double fresnel_upright(double cosine, double permittivity) {
  const double inside = std::sqrt(permittivity - 1 + cosine * cosine);
  return (cosine - inside) / (cosine + inside);
}

struct ImagePath {
  int mirrors = 0;
  double length = 0;      // m
  double reflection = 1;  // product of the mirrors' reflection coefficients, negative where they invert the wave
  double walls = 0;       // dB, lost in the walls and floors crossed, without the mirrors
};

class ImagePaths {
 public:
  // `losses` in dB, by material. Throws std::runtime_error for a wall, a door or a floor that the scene refuses.
  ImagePaths(std::vector<scene::Wall> walls, std::vector<scene::Door> doors, const std::vector<scene::Floor>& floors,
             std::vector<double> losses)
      : walls_(std::move(walls)),
        doors_(std::move(doors)),
        losses_(std::move(losses)),
        scene_(walls_, doors_, static_cast<int>(losses_.size()), floors) {}

  // Loss of the walls and floors on the straight line between two points, in dB, without the walls `but` and
  // `also_but`.
  double loss(const scene::Point& p, const scene::Point& q, int but = -1, int also_but = -1) {
    scene_.crossings(p, q, crossings_);
    double sum = 0;
    for (const scene::Crossing& each : crossings_) {
      if (each.floor >= 0 || (each.wall != but && each.wall != also_but))
        sum += losses_[static_cast<std::size_t>(each.material)];
    }
    return sum;
  }

  // Calls report(ImagePath) for each path from p to q by one mirror or, if `bounces` is 2, by two.
  template <class Report>
  void visit(const scene::Point& p, const scene::Point& q, int bounces, double permittivity, const Report& report) {
    for (int first = 0; first < static_cast<int>(walls_.size()); ++first) {
      const scene::Point image = mirrored(p, walls_[first]);
      visit_single(p, q, first, image, permittivity, report);
      for (int second = 0; bounces > 1 && second < static_cast<int>(walls_.size()); ++second) {
        if (second != first) visit_double(p, q, first, image, second, permittivity, report);
      }
    }
  }

 private:
  struct Hit {
    scene::Point at;
    double cosine = 0;  // of the angle to the wall's normal, in space
  };

  static double length(const scene::Point& a, const scene::Point& b) {
    return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
  }

  static scene::Point mirrored(const scene::Point& p, const scene::Wall& wall) {
    const double x = wall.x1 - wall.x0, y = wall.y1 - wall.y0;
    const double twice = 2 * ((p.x - wall.x0) * y - (p.y - wall.y0) * x) / (x * x + y * y);
    return {p.x - twice * y, p.y + twice * x, p.z};
  }

  template <class Report>
  void visit_single(const scene::Point& p, const scene::Point& q, int mirror, const scene::Point& image,
                    double permittivity, const Report& report) {
    Hit hit;
    if (!meets(image, q, mirror, hit)) return;
    report(ImagePath{1, length(image, q), fresnel_upright(hit.cosine, permittivity),
                     loss(p, hit.at, mirror) + loss(hit.at, q, mirror)});
  }

  template <class Report>
  void visit_double(const scene::Point& p, const scene::Point& q, int first, const scene::Point& image, int second,
                    double permittivity, const Report& report) {
    const scene::Point twice = mirrored(image, walls_[second]);
    Hit at_second, at_first;
    if (!meets(twice, q, second, at_second) || !meets(image, at_second.at, first, at_first)) return;
    report(ImagePath{
        2, length(twice, q),
        fresnel_upright(at_first.cosine, permittivity) * fresnel_upright(at_second.cosine, permittivity),
        loss(p, at_first.at, first) + loss(at_first.at, at_second.at, first, second) + loss(at_second.at, q, second)});
  }

  // True if the line from an image to a point passes the mirror at a solid place; strictly between both.
  bool meets(const scene::Point& image, const scene::Point& to, int mirror, Hit& hit) const {
    const scene::Wall& wall = walls_[static_cast<std::size_t>(mirror)];
    const double x = wall.x1 - wall.x0, y = wall.y1 - wall.y0, size = std::hypot(x, y);
    const auto aside = [&](const scene::Point& at) { return ((at.x - wall.x0) * y - (at.y - wall.y0) * x) / size; };
    const double behind = aside(image), before = aside(to);
    if (behind * before >= 0) return false;
    const double part = behind / (behind - before);
    hit.at = {image.x + part * (to.x - image.x), image.y + part * (to.y - image.y), image.z + part * (to.z - image.z)};
    hit.cosine = std::abs(before - behind) / length(image, to);
    return stands(mirror, ((hit.at.x - wall.x0) * x + (hit.at.y - wall.y0) * y) / size, size, hit.at.z);
  }

  // True for wall, or a closed door, at a place along a wall and a height.
  bool stands(int mirror, double along, double size, double z) const {
    const scene::Wall& wall = walls_[static_cast<std::size_t>(mirror)];
    if (along < 0 || along >= size || z < wall.base || z >= wall.base + wall.height) return false;
    return std::none_of(doors_.begin(), doors_.end(), [&](const scene::Door& door) {
      return door.wall == mirror && door.open && along >= door.at && along < door.at + door.width &&
             z < wall.base + door.height;
    });
  }

  std::vector<scene::Wall> walls_;
  std::vector<scene::Door> doors_;
  std::vector<double> losses_;
  scene::Scene scene_;
  std::vector<scene::Crossing> crossings_;
};

}  // namespace muster
