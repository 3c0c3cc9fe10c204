// Correlation of the errors of two links, of three kinds.
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "diagnosis/covariance.hpp"

namespace muster::diagnosis {
namespace {

constexpr double distances[] = {0.35, 0.7, 1.4, 2.8, 5.6};  // m; doubled from the furniture's scale to the room's
constexpr int pieces = 8;                                   // of a way

// Links that begin and end at nearly the same places are shadowed alike, in either direction. The sum over both
// directions keeps the matrix positive.
double by_place(const LinkPlace& p, const LinkPlace& q, double d) {
  const double straight = (p.a - q.a).norm() + (p.b - q.b).norm();
  const double turned = (p.a - q.b).norm() + (p.b - q.a).norm();
  return std::exp(-straight / d) + std::exp(-turned / d);
}

// Links that run side by side are shadowed alike: the double line integral of a field with correlation exp(-r/d), over
// the roots of both lengths (Agrawal and Patwari, IEEE Trans. Wireless Comm. 8(8), 2009).
double by_way(const LinkPlace& p, const LinkPlace& q, double d) {
  const Eigen::Vector3d u = p.b - p.a, v = q.b - q.a;
  const double du = u.norm() / pieces, dv = v.norm() / pieces;
  if (du == 0 || dv == 0) return 0;
  const double soft = std::pow((du + dv) / 6, 2);  // a piece is no point
  double sum = 0;
  for (int i = 0; i < pieces; ++i) {
    for (int j = 0; j < pieces; ++j) {
      const Eigen::Vector3d between = p.a + u * ((i + 0.5) / pieces) - q.a - v * ((j + 0.5) / pieces);
      sum += std::exp(-std::sqrt(between.squaredNorm() + soft) / d);
    }
  }
  return sum * std::sqrt(du * dv) / (2 * d * pieces);
}

// Offsets that readings with the same radio share.
double by_radio(const LinkPlace& p, const LinkPlace& q, double) {
  return (p.radio_a == q.radio_a) + (p.radio_b == q.radio_b);
}

using Correlation = double (*)(const LinkPlace&, const LinkPlace&, double);

// Mean over pairs of readings of two clusters; in one cluster over pairs of different readings, so that what a reading
// shares with itself alone counts as white.
double between(const std::vector<LinkPlace>& p, const std::vector<LinkPlace>& q, double d, Correlation correlation) {
  const bool same = &p == &q;
  const std::size_t most = same ? 4 : 2;
  double sum = 0;
  int pairs = 0;
  for (std::size_t i = 0; i < std::min(most, p.size()); ++i) {
    for (std::size_t j = 0; j < std::min(most, q.size()); ++j) {
      if (same && i == j && p.size() > 1) continue;
      sum += correlation(p[i], q[j], d);
      ++pairs;
    }
  }
  return sum / pairs;
}

// Means over a few examples need not be a covariance to the last digit; as much white as makes them one is added.
void make_positive(Eigen::MatrixXd& shape) {
  const double unit = shape.diagonal().mean();
  for (double white = 1e-6; Eigen::LLT<Eigen::MatrixXd>(shape).info() != Eigen::Success && white < 1; white *= 4)
    shape.diagonal().array() += white * unit;
}

Eigen::MatrixXd shape(const Clusters& clusters, double d, Correlation correlation) {
  const auto n = static_cast<Eigen::Index>(clusters.count());
  Eigen::MatrixXd result(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      result(i, j) = result(j, i) = between(clusters.examples[static_cast<std::size_t>(i)],
                                            clusters.examples[static_cast<std::size_t>(j)], d, correlation);
    }
  }
  make_positive(result);
  return result;
}

bool many_pairs(const Clusters& clusters) {
  std::set<std::pair<int, int>> pairs;
  for (const auto& examples : clusters.examples) pairs.emplace(examples[0].radio_a, examples[0].radio_b);
  return pairs.size() >= 4;
}

}  // namespace

std::vector<Kernels> kernels_of(const Clusters& clusters) {
  std::vector<Kernels> result;
  const bool has_radios = many_pairs(clusters);
  for (const double d : distances) {
    Kernels kernels{d, {shape(clusters, d, by_place), shape(clusters, d, by_way)}};
    if (has_radios) kernels.shapes.push_back(shape(clusters, d, by_radio));
    result.push_back(std::move(kernels));
  }
  return result;
}

}  // namespace muster::diagnosis
