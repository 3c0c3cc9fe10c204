// Solids as flat facets, for pictures.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <variant>
#include <vector>

#include "description/robot.hpp"

namespace muster {

struct Colour {
  float red, green, blue;  // 0 to 1
};

struct Facet {
  std::uint32_t corners[3];  // counter-clockwise from outside
  std::uint32_t face;        // facets of one plane have one number
};

// Corners and facets in one frame, all of one colour.
struct Facets {
  std::vector<Eigen::Vector3d> corners;
  std::vector<Facet> facets;
  std::uint32_t faces = 0;
  Colour colour{};
  bool is_sheet = false;  // seen from both sides

  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    facets.push_back({{a, b, c}, faces});
    facets.push_back({{a, c, d}, faces++});
  }
};

namespace detail {

constexpr int round_sides = 24;
constexpr double whole_turn = 6.283185307179586;

inline void append(const description::Box& box, Facets& to) {
  for (int i = 0; i < 8; ++i)
    to.corners.emplace_back(box.size.x() * ((i & 1) - 0.5), box.size.y() * ((i >> 1 & 1) - 0.5),
                            box.size.z() * ((i >> 2 & 1) - 0.5));
  for (const auto& [a, b, c, d] : {std::array{0u, 2u, 3u, 1u}, std::array{4u, 5u, 7u, 6u}, std::array{0u, 1u, 5u, 4u},
                                   std::array{2u, 6u, 7u, 3u}, std::array{0u, 4u, 6u, 2u}, std::array{1u, 3u, 7u, 5u}})
    to.quad(a, b, c, d);
}

// Rings of round_sides corners at heights, with radii, closed at both ends.
inline void append_rings(const std::vector<std::pair<double, double>>& rings, Facets& to) {
  for (const auto& [z, radius] : rings) {
    for (int i = 0; i < round_sides; ++i) {
      const double angle = whole_turn * i / round_sides;
      to.corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  const auto corner = [](std::size_t ring, int side) {
    return static_cast<std::uint32_t>(ring * round_sides + static_cast<std::size_t>(side % round_sides));
  };
  for (std::size_t ring = 0; ring + 1 < rings.size(); ++ring) {
    for (int i = 0; i < round_sides; ++i)
      to.quad(corner(ring, i), corner(ring, i + 1), corner(ring + 1, i + 1), corner(ring + 1, i));
  }
  for (int i = 1; i + 1 < round_sides; ++i) {
    to.facets.push_back({{corner(0, 0), corner(0, i + 1), corner(0, i)}, to.faces});
    to.facets.push_back(
        {{corner(rings.size() - 1, 0), corner(rings.size() - 1, i), corner(rings.size() - 1, i + 1)}, to.faces + 1});
  }
  to.faces += 2;
}

inline void append(const description::Cylinder& cylinder, Facets& to) {
  append_rings({{-cylinder.length / 2, cylinder.radius}, {cylinder.length / 2, cylinder.radius}}, to);
}

inline void append(const description::Sphere& sphere, Facets& to) {
  std::vector<std::pair<double, double>> rings;
  for (int i = 1; i < round_sides / 2; ++i) {
    const double angle = whole_turn * i / round_sides;
    rings.emplace_back(-sphere.radius * std::cos(angle), sphere.radius * std::sin(angle));
  }
  append_rings(rings, to);
}

inline void append(const description::Mesh& mesh, Facets& to) {
  to.corners = mesh.vertices;
  for (const auto& face : mesh.faces) to.facets.push_back({{face[0], face[1], face[2]}, to.faces++});
}

}  // namespace detail

inline Facets facets_of(const description::Shape& shape, const Colour& colour) {
  Facets result;
  std::visit([&](const auto& geometry) { detail::append(geometry, result); }, shape.geometry);
  for (Eigen::Vector3d& corner : result.corners) corner = shape.pose * corner;
  result.colour = colour;
  return result;
}

}  // namespace muster
