// The meshes of a world file: read, placed on the lattice, and checked to be closed if declared solid.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <description/mesh.hpp>
#include <map>
#include <muster/meshes.hpp>
#include <muster/plugin.hpp>
#include <muster/printed.hpp>
#include <scene/lattice.hpp>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh_scene.hpp"
#include "plugins/mesh_sizes.hpp"
#include "plugins/world_folder.hpp"

namespace muster {

class WorldMeshes {
 public:
  // For constructors: the kernel gives files during setup only. Throws BadInput with the faulty mesh.
  explicit WorldMeshes(const Setup& setup) {
    const muster_host* host = setup.host();
    const std::string folder = world_folder(host);
    for (uint32_t row = 0; row < host->rows(host, "mesh"); ++row) {
      names_.push_back(host->row_name(host, "mesh", row));
      const std::string file = setup.text("mesh/" + names_.back() + "/file");
      try {
        meshes_.push_back(description::read_mesh(folder, file, Eigen::Vector3d::Ones()));
      } catch (const std::runtime_error& wrong) {
        throw BadInput("mesh \"" + names_.back() + "\": the file \"" + file + "\" " + wrong.what());
      }
    }
  }

  // Warns of meshes that are far larger than the places of radios.
  template <class Places>
  void warn_of_sizes(const Step& k, Rows<const MeshShape> shapes, const Places& radios) const {
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      Eigen::AlignedBox3d box;
      for (const auto& vertex : meshes_[i].vertices) box.extend(vertex);
      if (box.isEmpty() || radios.empty()) continue;
      warn_of_size(k, names_[i], box.sizes().maxCoeff(), shapes[i].scale, extent_of(radios), "radios");
    }
  }

  // Throws BadInput for a mesh beyond 1 km, or one that is neither solid nor sheet.
  std::vector<PlacedMesh> placed(Rows<const MeshShape> shapes) const {
    std::vector<PlacedMesh> result;
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      result.push_back({});
      for (const auto& face : meshes_[i].faces) {
        const auto corner = [&](int k) { return at_lattice(i, shapes[i], meshes_[i].vertices[face[k]]); };
        result.back().triangles.push_back({corner(0), corner(1), corner(2)});
      }
      if (shapes[i].sheet == 0) check_closed(i, result.back());
    }
    return result;
  }

 private:
  static std::string digits(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, 4).ptr};
  }

  Vector at_lattice(std::size_t mesh, const MeshShape& shape, const Eigen::Vector3d& vertex) const {
    const double c = std::cos(shape.yaw) * shape.scale, s = std::sin(shape.yaw) * shape.scale;
    const double x = shape.x + c * vertex.x() - s * vertex.y(), y = shape.y + s * vertex.x() + c * vertex.y();
    const double z = shape.z + shape.scale * vertex.z();
    if (!scene::within_extent(x) || !scene::within_extent(y) || !scene::within_extent(z))
      throw BadInput("mesh \"" + names_[mesh] +
                     "\" reaches beyond 1 km; is its file in millimetres? expected scale=\"" +
                     digits(shape.scale / 1000) + '"');
    return {scene::snap(x), scene::snap(y), scene::snap(z)};
  }

  // Closed: every link between places outside then crosses it an even number of times.
  void check_closed(std::size_t mesh, const PlacedMesh& placed) const {
    using Corner = std::tuple<std::int64_t, std::int64_t, std::int64_t>;
    std::map<std::pair<Corner, Corner>, int> edges;
    const auto add = [&](const Vector& u, const Vector& v) {
      const Corner one{u.x, u.y, u.z}, other{v.x, v.y, v.z};
      if (one != other) ++edges[std::minmax(one, other)];
    };
    for (const Triangle& t : placed.triangles) add(t.a, t.b), add(t.b, t.c), add(t.c, t.a);
    for (const auto& [edge, faces] : edges) {
      if (faces % 2 == 0) continue;
      throw BadInput("mesh \"" + names_[mesh] + "\" is not closed: the edge from " + text(edge.first) + " to " +
                     text(edge.second) + " has " + std::to_string(faces) + (faces == 1 ? " triangle" : " triangles") +
                     "; expected a closed surface, or kind=\"sheet\"");
    }
  }

  static std::string text(const std::tuple<std::int64_t, std::int64_t, std::int64_t>& corner) {
    const auto metres = [](std::int64_t steps) { return printed(static_cast<double>(steps) / scene::steps_per_metre); };
    return metres(std::get<0>(corner)) + ' ' + metres(std::get<1>(corner)) + ' ' + metres(std::get<2>(corner));
  }

  std::vector<std::string> names_;
  std::vector<description::Mesh> meshes_;
};

}  // namespace muster
