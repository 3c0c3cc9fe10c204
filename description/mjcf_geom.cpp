#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "description/mesh.hpp"
#include "description/mjcf.hpp"
#include "description/urdf_inertia.hpp"

namespace muster::description::mjcf {

using Eigen::Vector3d;
using tinyxml2::XMLElement;

namespace {

constexpr double pi = 3.141592653589793, water = 1000;  // [kg/m3] MuJoCo's density

// The frame and half length that fromto gives, along z.
struct Along {
  Eigen::Isometry3d frame;
  double half;
};

std::optional<Along> from_to(const Values& values, const Values::Element& element) {
  const auto ends = values.numbers(element, "fromto", 6);
  if (!ends) return std::nullopt;
  const Vector3d from((*ends)[0], (*ends)[1], (*ends)[2]), to((*ends)[3], (*ends)[4], (*ends)[5]);
  const Vector3d way = to - from;
  if (!(way.norm() > 0)) values.fail(element, "fromto has no length");
  Along result{Eigen::Isometry3d::Identity(), way.norm() / 2};
  result.frame.translation() = (from + to) / 2;
  result.frame.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), way.normalized()).toRotationMatrix();
  return result;
}

// A capsule of density 1: its cylinder and two half spheres, whose centres of mass are 3/8 r beyond it.
Mass filled_capsule(double radius, double half) {
  Mass sum = *filled({Shape{Eigen::Isometry3d::Identity(), Cylinder{radius, 2 * half}}});
  const double mass = 2.0 / 3 * pi * radius * radius * radius, square = radius * radius;
  const double along = 0.4 * mass * square, across = 83.0 / 320 * mass * square;
  for (const double side : {-1.0, 1.0}) {
    const Mass cap{mass, {0, 0, side * (half + 0.375 * radius)}, Vector3d(across, across, along).asDiagonal()};
    sum = sum + cap;
  }
  return sum;
}

Mass filled_ellipsoid(const Vector3d& radii) {
  const Vector3d squares = radii.cwiseProduct(radii);
  const double mass = 4.0 / 3 * pi * radii.prod();
  return {mass, Vector3d::Zero(), (mass / 5 * (Vector3d::Constant(squares.sum()) - squares)).asDiagonal()};
}

class GeomReader {
 public:
  GeomReader(const Source& source, const Values& values, const Values::Element& element)
      : source_(source), values_(values), element_(element) {
    frame_ = values.frame(element);
    if (const auto along = from_to(values, element)) frame_ = along->frame, half_ = along->half;
  }

  // The sizes of a shape, all above 0; one fewer where fromto has the length.
  std::vector<double> sizes(std::size_t count) const {
    const auto given = values_.numbers(element_, "size", 3, half_ > 0 && count == 2 ? 1 : count);
    if (!given) values_.fail(element_, "has no size; expected " + std::to_string(count) + " numbers");
    for (std::size_t i = 0; i < count && i < given->size(); ++i) {
      if (!((*given)[i] > 0)) values_.fail(element_, "size=\"" + *values_.text(element_, "size") + "\" is not above 0");
    }
    return *given;
  }

  void add(const std::variant<Box, Sphere, Cylinder, Mesh>& geometry, double along = 0) {
    made_.shapes.push_back({frame_ * Eigen::Translation3d(0, 0, along), geometry});
  }

  Geom read(const std::string& type, Meshes meshes, const std::map<std::string, const XMLElement*>& assets,
            NotTaken& not_taken) {
    if (type == "sphere") {
      add(Sphere{sizes(1)[0]});
      weigh(*filled({{Eigen::Isometry3d::Identity(), Sphere{sizes(1)[0]}}}));
    } else if (type == "box") {
      const auto half = sizes(3);
      const Box box{2 * Vector3d(half[0], half[1], half[2])};
      add(box);
      weigh(*filled({{Eigen::Isometry3d::Identity(), box}}));
    } else if (type == "cylinder" || type == "capsule") {
      const auto size = sizes(2);
      const double radius = size[0], half = half_ > 0 ? half_ : size[1];
      add(Cylinder{radius, 2 * half});
      if (type == "capsule") add(Sphere{radius}, half), add(Sphere{radius}, -half);
      weigh(type == "capsule" ? filled_capsule(radius, half)
                              : *filled({{Eigen::Isometry3d::Identity(), Cylinder{radius, 2 * half}}}));
    } else if (type == "ellipsoid") {
      const auto radii = sizes(3);
      const Vector3d half(radii[0], radii[1], radii[2]);
      add(Box{2 * half});
      weigh(filled_ellipsoid(half));
      not_taken.insert("the roundness of <geom type=\"ellipsoid\"> (it touches as the box around it)");
    } else if (type == "mesh") {
      add_mesh(meshes, assets);
    } else {
      not_taken.insert("<geom type=\"" + type + "\">");
      made_.mass = Mass{};
    }
    return made_;
  }

 private:
  void add_mesh(Meshes meshes, const std::map<std::string, const XMLElement*>& assets) {
    const std::string name = values_.text(element_, "mesh").value_or("");
    const auto found = assets.find(name);
    if (found == assets.end()) values_.fail(element_, "mesh=\"" + name + "\" is not in <asset>");
    if (meshes == Meshes::skip) return;
    const Values::Element asset{found->second, ""};
    const char* file = found->second->Attribute("file");
    if (!file) values_.fail(asset, "has no file; meshes of vertices are not read");
    const std::string folder = std::filesystem::absolute(source_.file).parent_path().string();
    try {
      add(read_mesh(folder, (std::filesystem::path(values_.mesh_folder()) / file).string(),
                    values_.vector(asset, "scale", Vector3d::Ones())));
    } catch (const std::runtime_error& wrong) {
      values_.fail(asset, std::string("mesh '") + file + "' " + wrong.what());
    }
  }

  // `of_one`: at a density of 1, in the geom's frame.
  void weigh(const Mass& of_one) {
    if (of_one.mass == 0) return;
    const double mass = values_.text(element_, "mass") ? values_.number(element_, "mass", 0)
                                                       : of_one.mass * values_.number(element_, "density", water);
    if (mass < 0) values_.fail(element_, "has a mass below 0");
    const double by = mass / of_one.mass;
    made_.mass = mass > 0 ? in_parent(frame_, {mass, of_one.centre, of_one.inertia * by}) : Mass{};
  }

  const Source& source_;
  const Values& values_;
  const Values::Element& element_;
  Eigen::Isometry3d frame_ = Eigen::Isometry3d::Identity();
  double half_ = 0;  // of fromto; 0 without
  Geom made_;
};

}  // namespace

Geom read_geom(const Source& source, const Values& values, const Values::Element& element, Meshes meshes,
               const std::map<std::string, const XMLElement*>& mesh_assets, NotTaken& not_taken) {
  const bool is_mesh = values.text(element, "mesh").has_value();
  const std::string type = values.text(element, "type").value_or(is_mesh ? "mesh" : "sphere");
  Geom geom = GeomReader(source, values, element).read(type, meshes, mesh_assets, not_taken);
  geom.collides = values.number(element, "contype", 1) != 0 || values.number(element, "conaffinity", 1) != 0;
  if (geom.collides && values.text(element, "friction")) not_taken.insert("friction of <geom> (a drive has its own)");
  return geom;
}

}  // namespace muster::description::mjcf
