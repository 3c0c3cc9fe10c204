#include "description/urdf_inertia.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "description/file_text.hpp"

namespace muster::description {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// A thin plate reaches the triangle inequality, so rounded figures get some slack; CAD programs that round more get
// `widened`.
constexpr double slack = 1e-3, widened = 0.1;

// Inertia against that of the shapes filled evenly, as the ratio of the sums of principal moments. All mass in the
// corners of a box has 3 times, no shape more; but shapes may leave out arms and masts (the Hummingbird's: 6.7). A
// tenth is a mass within a third of the size.
constexpr double most_inertia = 10, least_inertia = 0.1;

// [kg/m3] Mass against the volume of the shapes: osmium, the densest metal, and foam.
constexpr double densest = 22600, lightest = 1;

Mass evenly(const Box& box) {
  const Vector3d square = box.size.cwiseProduct(box.size);
  const double mass = box.size.prod();
  return {mass, Vector3d::Zero(), Matrix3d((mass / 12 * (Vector3d::Constant(square.sum()) - square)).asDiagonal())};
}

constexpr double pi = 3.141592653589793;

Mass evenly(const Sphere& sphere) {
  const double mass = 4.0 / 3 * pi * std::pow(sphere.radius, 3);
  return {mass, Vector3d::Zero(), 0.4 * mass * sphere.radius * sphere.radius * Matrix3d::Identity()};
}

Mass evenly(const Cylinder& cylinder) {
  const double square = cylinder.radius * cylinder.radius, mass = pi * square * cylinder.length;
  const double across = mass * (square / 4 + cylinder.length * cylinder.length / 12);
  return {mass, Vector3d::Zero(), Matrix3d(Vector3d(across, across, mass * square / 2).asDiagonal())};
}

Mass evenly(const Mesh&) { return {}; }

std::string moments(const Vector3d& principal) {
  return print_number(principal[0]) + ", " + print_number(principal[1]) + " and " + print_number(principal[2]) +
         " kg m2";
}

std::string percent(double share) { return print_number(100 * share) + " %"; }

std::string remedy(const std::optional<Mass>& even) {
  if (!even) return "";
  return "; its collision shapes, filled evenly, give " + inertial_text(*even);
}

std::string triple(double a, double b, double c) {
  return print_number(a) + " " + print_number(b) + " " + print_number(c);
}

// Warns of a mass and an inertia that do not fit the shapes.
void compare(const Mass& mass, const Mass& full, const Mass& even, std::vector<std::string>& warnings) {
  const double density = mass.mass / full.mass;  // `full` has 1 kg/m3
  if (density > densest || density < lightest) {
    warnings.push_back("its mass of " + print_number(mass.mass) + " kg gives its collision shapes a density of " +
                       print_number(density) + " kg/m3; expected " + print_number(lightest) + " to " +
                       print_number(densest) + " (osmium)" +
                       (density > densest && density / 1000 < densest ? "; are these grams?" : ""));
  }
  const double ratio = mass.inertia.trace() / even.inertia.trace();
  if (ratio <= most_inertia && ratio >= least_inertia) return;
  const std::string size = ratio > 1 ? print_number(ratio) + " times" : "1/" + print_number(1 / ratio) + " of";
  warnings.push_back("its inertia is " + size + " that of its collision shapes filled evenly with " +
                     print_number(mass.mass) + " kg; expected 1/10 to 10 times; unless it is meant, write " +
                     inertial_text(even));
}

}  // namespace

bool is_oversized(const std::vector<Shape>& shapes) {
  constexpr double largest = 20;  // m
  return std::any_of(shapes.begin(), shapes.end(), [](const Shape& shape) {
    return !std::holds_alternative<Mesh>(shape.geometry) && bounds(shape).sizes().maxCoeff() > largest;
  });
}

std::optional<Mass> filled(const std::vector<Shape>& shapes) {
  Mass sum;
  for (const Shape& shape : shapes) {
    if (std::holds_alternative<Mesh>(shape.geometry)) return {};
    sum = sum + in_parent(shape.pose, std::visit([](const auto& one) { return evenly(one); }, shape.geometry));
  }
  if (!(sum.mass > 0)) return {};
  return sum;
}

std::string inertial_text(const Mass& mass) {
  const Matrix3d& i = mass.inertia;
  const auto clean = [&](double value, double size) { return std::abs(value) < 1e-9 * size ? 0 : value; };
  const auto number = [&](double value) { return print_number(clean(value, i.trace())); };
  const Vector3d c = mass.centre.unaryExpr([](double v) { return std::abs(v) < 1e-9 ? 0.0 : v; });
  return "<inertial><origin xyz=\"" + triple(c.x(), c.y(), c.z()) + "\"/><mass value=\"" + print_number(mass.mass) +
         "\"/><inertia ixx=\"" + number(i(0, 0)) + "\" ixy=\"" + number(i(0, 1)) + "\" ixz=\"" + number(i(0, 2)) +
         "\" iyy=\"" + number(i(1, 1)) + "\" iyz=\"" + number(i(1, 2)) + "\" izz=\"" + number(i(2, 2)) +
         "\"/></inertial>";
}

std::string expected_mass(const std::vector<Shape>& shapes) {
  constexpr double water = 1000;  // kg/m3
  const std::optional<Mass> full = filled(shapes);
  return "expected the mass in kg, above 0" +
         (full ? " (its collision shapes filled with water weigh " + print_number(water * full->mass) + " kg)"
               : std::string()) +
         ", or no <inertial> if the link is a frame without mass";
}

void check_inertia(Mass& mass, const Eigen::Isometry3d& frame, const std::vector<Shape>& shapes,
                   std::vector<std::string>& warnings) {
  const std::optional<Mass> full = filled(shapes);
  std::optional<Mass> even = full;
  if (even) {
    even->inertia *= mass.mass / full->mass;
    even->mass = mass.mass;
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solved(mass.inertia);
  const Vector3d& principal = solved.eigenvalues();
  if (!(principal[0] > 0)) {
    throw std::runtime_error("inertia is not positive definite: its principal moments are " + moments(principal) +
                             ", each of which is above 0 in a body" + remedy(even));
  }
  const double others = principal[0] + principal[1], excess = principal[2] / others - 1;
  if (excess > widened) {
    throw std::runtime_error("inertia breaks the triangle inequality: of its principal moments " + moments(principal) +
                             " the largest is " + percent(excess) +
                             " above the sum of the others; no body has such "
                             "moments" +
                             remedy(even));
  }
  if (excess > slack) {
    const double lack = (principal[2] - others) / 2;
    const Vector3d wider = principal + Vector3d(lack, lack, 0);
    mass.inertia = solved.eigenvectors() * wider.asDiagonal() * solved.eigenvectors().transpose();
    warnings.push_back("inertia breaks the triangle inequality: of its principal moments " + moments(principal) +
                       " the largest is " + percent(excess) +
                       " above the sum of the others; the others are raised by " + print_number(lack) +
                       " kg m2 each; write " + inertial_text(in_parent(frame, mass)));
  }
  // Of a body in millimetres every mass is wrong, and one question is enough: warn_of_body() asks it.
  if (even && !is_oversized(shapes)) compare(mass, *full, *even, warnings);
}

}  // namespace muster::description
